// The modes of the view: the scene as it is, its materials in a studio, and its shapes in clay.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import {cameraOf, dragPicture, pixelAt, scene, shownBytes, showsBytes, showsOther, withPage}
  from './page.mjs';
import {rendered, text, type, whole} from './studio.mjs';

const box = [0.7, 0.5];
const isGrey = ([red, green, blue]) => red === green && green === blue;
const modeOf = (page) => page.evaluate(() => studio.viewState.options.mode);

withPage('modes show materials and shapes, and the picture comes back', async ({page, folder}) => {
  const first = await shownBytes(page);
  const mode = page.getByLabel('Mode', {exact: true});
  assert.equal(await mode.inputValue(), 'rendered');
  await rendered(page, () => mode.selectOption('material'));
  assert.notEqual(await shownBytes(page), first);
  assert.ok(!isGrey(await pixelAt(page, ...box)));
  await rendered(page, () => mode.selectOption('clay'));
  assert.ok(isGrey(await pixelAt(page, ...box)));
  const clay = await shownBytes(page);

  // Shapes that are typed are shown in clay, and colours make no difference.
  await rendered(page, () => type(page, 'rgb(0.8, 0.1, 0.1)', 'rgb(0.1, 0.1, 0.8)'));
  assert.equal(await shownBytes(page), clay);
  await rendered(page, () => type(page, 'radius -> 0.7', 'radius -> 0.5'));
  assert.notEqual(await shownBytes(page), clay);
  await page.evaluate(() => studio.editor.view.focus());
  for (let i = 0; i < 2; ++i) await page.keyboard.press('Control+z');
  await showsBytes(page, clay);
  assert.equal(await text(page), scene);

  // A camera that is turned is shown so in each mode, and kept.
  await rendered(page, () => dragPicture(page, 60, 0));
  const turned = await cameraOf(page);
  const turnedClay = await shownBytes(page);
  assert.notEqual(turnedClay, clay);
  await rendered(page, () => mode.selectOption('rendered'));
  assert.deepEqual(await cameraOf(page), turned);
  await page.locator('.live canvas').focus();
  await rendered(page, () => page.keyboard.press('Home'));
  assert.equal(await shownBytes(page), first);
  assert.equal(readFileSync(join(folder, 'a.crt'), 'utf8'), scene);
});

withPage('M goes through the modes, and the browser keeps the last', async ({page}) => {
  const canvas = page.locator('.live canvas');
  await canvas.focus();
  const seen = [];
  for (let i = 0; i < 3; ++i) {
    await rendered(page, () => page.keyboard.press('m'));
    seen.push(await modeOf(page));
  }
  assert.deepEqual(seen, ['material', 'clay', 'rendered']);
  assert.equal(await page.getByLabel('Mode', {exact: true}).inputValue(), 'rendered');
  // Where one types, M is a letter.
  await page.evaluate(() => studio.editor.view.focus());
  await page.keyboard.type('m');
  assert.equal(await modeOf(page), 'rendered');
  await page.keyboard.press('Control+z');
  await whole(page);

  await page.getByLabel('Mode', {exact: true}).focus();
  await rendered(page, () => page.keyboard.press('ArrowDown'));
  const material = await shownBytes(page);
  await page.reload();
  await whole(page);
  assert.equal(await page.getByLabel('Mode', {exact: true}).inputValue(), 'material');
  assert.equal(await shownBytes(page), material);
  await page.evaluate(() => localStorage.setItem('crt-studio:mode', 'wireframe'));
  await page.reload();
  await whole(page);
  assert.equal(await modeOf(page), 'rendered');
});

withPage('the file is the picture whatever mode is shown, which can be compared with it',
         async ({page}) => {
  const fileOf = async () => {
    const [download] = await Promise.all([
      page.waitForEvent('download'), page.getByRole('button', {name: 'PNG'}).click()]);
    return readFileSync(await download.path());
  };
  const file = await fileOf();
  const first = await pixelAt(page, ...box);
  await page.getByRole('button', {name: 'Compare'}).click();
  const kept = page.locator('.live canvas.kept');
  await kept.waitFor();
  await rendered(page, () => page.getByLabel('Mode', {exact: true}).selectOption('clay'));
  assert.deepEqual(await fileOf(), file);
  const ofKept = await page.evaluate(([u, v]) => {
    const canvas = document.querySelector('.live canvas.kept');
    const [x, y] = [Math.floor(u * canvas.width), Math.floor(v * canvas.height)];
    return [...canvas.getContext('2d').getImageData(x, y, 1, 1).data];
  }, box);
  assert.deepEqual(ofKept, first);
  assert.ok(isGrey(await pixelAt(page, ...box)));
});

withPage('the exposure is shown at once, also while one renders, and is of the view alone',
         async ({page, folder}) => {
  const first = await shownBytes(page);
  const states = () => page.evaluate(() => {
    window.states = 0;
    const set = studio.queue.set.bind(studio.queue);
    studio.queue.set = (state) => { window.states += 1; set(state); };
  });
  await states();
  const [before] = await pixelAt(page, ...box);
  const slider = page.getByLabel('Exposure', {exact: true});
  await slider.fill('-2');
  await showsOther(page, first);
  const [after] = await pixelAt(page, ...box);
  // Light of a quarter, in what a display shows.
  assert.ok(Math.abs(after - before * 0.25 ** (1 / 2.2)) <= 1, `${before} ${after}`);
  assert.equal(await page.getByLabel('Exposure in stops').inputValue(), '-2');
  const dark = await shownBytes(page);
  await page.getByLabel('Tone map').selectOption('filmic');
  await showsOther(page, dark);
  await page.getByLabel('Tone map').selectOption('');
  await showsBytes(page, dark);
  assert.equal(await page.evaluate(() => window.states), 0, 'nothing was rendered for it');

  // It stays while one renders, and takes effect then, too.
  await rendered(page, () => type(page, 'rgb(0.8, 0.1, 0.1)', 'rgb(0.1, 0.8, 0.1)'));
  const [, green] = await pixelAt(page, ...box);
  assert.ok(Math.abs(green - after) <= 1, `${green} ${after}`);
  await page.evaluate((content) => studio.editor.replace(content),
    scene.replace('supersampling -> 2', 'timebudget -> 1.5 maxsamples -> 65536'));
  await page.waitForFunction(() => studio.view.lastKind === 'progress');
  await slider.dblclick();
  await page.waitForFunction(([u, v, old]) => {
    const {canvas} = studio.view;
    const [x, y] = [Math.floor(u * canvas.width), Math.floor(v * canvas.height)];
    return Math.abs(canvas.getContext('2d').getImageData(x, y, 1, 1).data[0] - old) < 8 &&
      studio.view.lastKind === 'progress';
  }, [...box, before]);
  await whole(page);
  await rendered(page, () => page.evaluate((content) => studio.editor.replace(content), scene));
  assert.equal(await shownBytes(page), first);
  assert.equal(readFileSync(join(folder, 'a.crt'), 'utf8'), scene);
});

withPage('noise is smoothed away in the view alone, which says so, and the browser keeps that',
         async ({page, folder}) => {
  const noisy = scene.replace('supersampling -> 2', 'targeterror -> 0.03 maxsamples -> 32 lights ' +
    '-> [PointLight { origin -> vec3(2, 3, -2) color -> rgb(1, 1, 1) radius -> 1 }]');
  await rendered(page, () => page.evaluate((content) => studio.editor.replace(content), noisy));
  const fileOf = async () => {
    const [download] = await Promise.all([
      page.waitForEvent('download'), page.getByRole('button', {name: 'PNG'}).click()]);
    return readFileSync(await download.path());
  };
  const mark = page.locator('.live .mark');
  const denoise = page.getByLabel('Denoise', {exact: true});
  const statistics = () => page.evaluate(() => studio.statistics.element.textContent);
  const first = await shownBytes(page);
  const file = await fileOf();
  assert.equal(await denoise.isChecked(), false);
  assert.equal(await mark.isVisible(), false);
  assert.match(await statistics(), /95 of 100 pixels within[0-9.]+ steps/);
  await rendered(page, () => denoise.check());
  const smooth = await shownBytes(page);
  assert.notEqual(smooth, first);
  assert.equal(await mark.textContent(), 'Denoised');
  assert.ok(await mark.isVisible());
  assert.match(await statistics(), /95 of 100 pixels withinnot known/);
  assert.equal(await page.evaluate(() => studio.trade.element.hidden), true);
  assert.deepEqual(await fileOf(), file);

  // Both are known now.
  await page.evaluate(() => {
    window.states = 0;
    const set = studio.queue.set.bind(studio.queue);
    studio.queue.set = (state) => { window.states += 1; set(state); };
  });
  await denoise.uncheck();
  await showsBytes(page, first);
  assert.equal(await mark.isVisible(), false);
  assert.match(await statistics(), /95 of 100 pixels within[0-9.]+ steps/);
  await denoise.check();
  await showsBytes(page, smooth);
  assert.ok(await mark.isVisible());
  assert.equal(await page.evaluate(() => window.states), 0, 'nothing was rendered for it');
  assert.equal(readFileSync(join(folder, 'a.crt'), 'utf8'), scene);

  await page.reload();
  await whole(page);
  assert.ok(await denoise.isChecked());
  assert.equal(await shownBytes(page), smooth);
  assert.ok(await mark.isVisible());
  await rendered(page, () => page.getByLabel('Channel').selectOption('depth'));
  assert.equal(await mark.isVisible(), false);
});
