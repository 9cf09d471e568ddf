// What the view shows beside the picture: channels, what is hidden, sections, time, comparisons.
import assert from 'node:assert/strict';
import {readFileSync, utimesSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {test} from 'node:test';
import {browser, cameraOf, clickPicture, dragPicture, pixelAt, scene, shownBytes, showsBytes,
        withPage} from './page.mjs';
import {folderWith, keptTexts, openPage, rendered, startServer, text, type, whole}
  from './studio.mjs';

const ball = [0.29, 0.5];
const box = [0.7, 0.5];
const nothing = [0.02, 0.02];

withPage('each channel is shown, and the picture comes back', async ({page}) => {
  const first = await shownBytes(page);
  const select = page.getByLabel('Channel');
  const channels = await select.locator('option')
    .evaluateAll((options) => options.map(({value}) => value));
  assert.equal(channels.length, 8);
  for (const channel of channels.slice(1)) {
    await rendered(page, () => select.selectOption(channel));
    assert.notDeepEqual(await shownBytes(page), first, channel);
  }
  await rendered(page, () => select.selectOption('id'));
  const ids = [];
  for (const place of [ball, box, nothing]) ids.push(String(await pixelAt(page, ...place)));
  assert.equal(new Set(ids).size, 3);
  await rendered(page, () => select.selectOption('color'));
  assert.deepEqual(await shownBytes(page), first);
});

withPage('an eye hides an entity in the view, also while one types', async ({page, folder}) => {
  const first = await shownBytes(page);
  const background = await pixelAt(page, ...nothing);
  const row = page.locator('.tree .row.kind-name', {hasText: 'ball'});
  await row.hover();
  await rendered(page, () => row.locator('.eye').click());
  assert.deepEqual(await pixelAt(page, ...ball), background);
  assert.notDeepEqual(await pixelAt(page, ...box), background);
  assert.equal(await text(page), scene);
  // What is hidden stays so where the text before it grows, and in what is hidden.
  await rendered(page, () => type(page, 'ball = Sphere', '-- a ball\nball = Sphere'));
  const end = (await text(page)).indexOf('    ball\n') + 8;
  await rendered(page, () => page.evaluate((place) => studio.editor.view.dispatch({
    changes: {from: place, insert: ' <translate vec3(0, 0.1, 0)>'}}),
  end));
  await page.waitForFunction(() => studio.viewState.options.hidden[0][1] -
    studio.viewState.options.hidden[0][0] > 20);
  await rendered(page, () => page.evaluate(() => studio.viewState.set({})));
  assert.deepEqual(await pixelAt(page, ...ball), background);
  await rendered(page, () => page.getByRole('button', {name: 'Show all'}).click());
  assert.notDeepEqual(await pixelAt(page, ...ball), background);
  assert.equal(await page.getByRole('button', {name: 'Show all'}).isVisible(), false);
  assert.equal(readFileSync(join(folder, 'a.crt'), 'utf8'), scene);
  await page.evaluate(() => studio.editor.view.focus());
  for (let i = 0; i < 2; ++i) await page.keyboard.press('Control+z');
  await whole(page);
  await page.waitForFunction((all) => studio.editor.text === all, scene);
  await rendered(page, () => page.evaluate(() => studio.connection.send({
    type: 'render', action: 'restart'})));
  assert.deepEqual(await shownBytes(page), first);
});

withPage('a section is moved by its slider and flipped', async ({page}) => {
  const first = await shownBytes(page);
  const background = await pixelAt(page, ...nothing);
  await rendered(page, () => page.getByLabel('Section across').selectOption('0'));
  const slider = page.getByLabel('Place of the section', {exact: true});
  assert.ok(Math.abs(Number(await slider.getAttribute('min')) + 1.7) < 1e-6);
  assert.equal(Number(await slider.getAttribute('max')), 1.5);
  assert.deepEqual(await pixelAt(page, ...box), background);
  assert.notDeepEqual(await pixelAt(page, ...ball), background);
  await rendered(page, () => page.getByLabel('Flip').check());
  assert.notDeepEqual(await pixelAt(page, ...box), background);
  assert.deepEqual(await pixelAt(page, ...ball), background);
  await rendered(page, () => slider.fill('-1.7'));
  assert.deepEqual(await shownBytes(page), first);
  // What lies on the camera's side is taken away at first.
  await rendered(page, () => page.getByLabel('Section across').selectOption('2'));
  assert.equal(await page.getByLabel('Flip').isChecked(), true);
  const [red, green] = await pixelAt(page, ...ball);
  assert.ok(red > 1.3 * green, 'where it is cut, it is orange');
  await rendered(page, () => page.getByLabel('Section across').selectOption(''));
  assert.deepEqual(await shownBytes(page), first);
});

withPage('boxes are drawn where the entities are', async ({page}) => {
  const plain = 'camera -> Camera {';
  const roll = `${plain} roll -> 20`;
  const cameras = {
    'a pinhole camera': [plain, ''], 'a rolled one': [roll, ''],
    'an orthographic one': [`${roll} focaldistance -> 4`, 'projection -> "orthographic"'],
    'a spherical one': [roll, 'projection -> "spherical"'],
    'a panorama': [`${roll} fov -> 180`, 'projection -> "spherical"'],
    'a cylindrical one': [`${roll} fov -> 120`, 'projection -> "cylindrical"']};
  await page.getByLabel('Bounds').setChecked(true);
  for (const [name, [camera, projection]] of Object.entries(cameras)) {
    if (name !== 'a pinhole camera') await rendered(page, () => page.evaluate((text) =>
      studio.editor.replace(text), scene.replace(plain, `${projection} ${camera}`)));
    await page.waitForFunction(() => studio.view.overlay.wires.getAttribute('d').length > 100);
    // A pixel and the point that it shows are the same place, whatever the library projects.
    const {width, height} = await page.evaluate(() => studio.scene);
    let hits = 0;
    for (let x = width / 20; x < width; x += width / 20) {
      for (let y = height / 10; y < height; y += height / 10) {
        const found = await page.evaluate(async ([u, v]) => {
          const pick = await studio.connection.ask({type: 'pick', x: u, y: v});
          return pick && studio.view.overlay.placeOf(pick.position);
        }, [x, y]);
        if (!found) continue;
        ++hits;
        assert.ok(Math.hypot(found[0] - x, found[1] - y) < 0.01, `${name}: ${found}, ${x} ${y}`);
      }
    }
    assert.ok(hits > 1, name);
  }
});

withPage('edges are bent where the picture is, and end at its seam', async ({page}) => {
  await page.getByLabel('Bounds').setChecked(true);
  await rendered(page, () => page.evaluate((text) => studio.editor.replace(text),
    scene.replace('width -> 320 height -> 240', 'width -> 480 height -> 240')
      .replace('camera -> Camera {', 'projection -> "spherical" camera -> Camera { fov -> 180')
      .replace('Scene {', 'Scene {\n' +
        'Box { cornerA -> vec3(-1, 0.5, -8) cornerB -> vec3(1, 1.5, -6) }')));
  await page.waitForFunction(() => studio.view.overlay.boxes.length === 3);
  const lines = (await page.evaluate(() => studio.view.overlay.wires.getAttribute('d')))
    .slice(1).split('M').map((line) => line.split('L').map((place) => place.split(' ').map(Number)));
  // The picture goes all around, and the new box is behind the camera: four edges cross the seam.
  assert.equal(lines.length, 3 * 12 + 4);
  for (const line of lines) {
    for (let i = 1; i < line.length; ++i) {
      const [[x0, y0], [x1, y1]] = [line[i - 1], line[i]];
      assert.ok(Math.hypot(x1 - x0, y1 - y0) < 10, `${line}`);
    }
  }
  // An edge that is straight in space is not so in the picture.
  const bends = lines.map((line) => {
    const [[x0, y0], [x1, y1]] = [line[0], line.at(-1)];
    const [x, y] = line[line.length >> 1];
    return Math.abs((x - x0) * (y1 - y0) - (y - y0) * (x1 - x0)) / Math.hypot(x1 - x0, y1 - y0);
  });
  assert.ok(Math.max(...bends.filter(Number.isFinite)) > 1, String(bends));
});

withPage('the boxes of what is cut away are drawn, and not the plane of a section',
         async ({page}) => {
  const drawn = () => page.evaluate(() => studio.view.overlay.ghosts.getAttribute('d'));
  const edges = async () => ((await drawn()).match(/M/g) ?? []).length;
  await page.getByLabel('Cutters').setChecked(true);
  await rendered(page, () => type(page, '    ball\n',
    '    (ball - Box { cornerA -> vec3(-2, 0, -1) cornerB -> vec3(-1, 1, 0) })\n'));
  await page.waitForFunction(() => studio.view.overlay.ghosts.getAttribute('d') !== '');
  assert.equal(await edges(), 12);
  await rendered(page, () => page.getByLabel('Section across').selectOption('0'));
  await page.waitForFunction(() => studio.view.overlay.cutters.length === 1);
  assert.equal(await edges(), 12);
  await page.getByLabel('Cutters').setChecked(false);
  await page.waitForFunction(() => studio.view.overlay.ghosts.getAttribute('d') === '');
});

withPage('a region is dragged with Ctrl, refined alone, and given up by Escape', async ({page}) => {
  const first = await shownBytes(page);
  const area = await page.locator('.live canvas').boundingBox();
  const at = (x, y) => [area.x + x * area.width, area.y + y * area.height];
  await page.keyboard.down('Control');
  await page.mouse.move(...at(0.1, 0.2));
  await page.mouse.down();
  await page.mouse.move(...at(0.3, 0.6), {steps: 5});
  await rendered(page, () => page.mouse.up());
  await page.keyboard.up('Control');
  const {region} = await page.evaluate(() => studio.viewState.options);
  assert.ok(Math.abs(region.x - 32) <= 1 && Math.abs(region.y - 48) <= 1, JSON.stringify(region));
  assert.equal(await page.locator('.overlay .region').getAttribute('visibility'), 'visible');
  // What was there already is as it was, and a turned camera refines nothing else.
  assert.deepEqual(await shownBytes(page), first);
  assert.equal(await page.evaluate(() => studio.camera), null);
  await page.locator('.live canvas').focus();
  await rendered(page, () => page.keyboard.press('Escape'));
  assert.equal(await page.evaluate(() => studio.viewState.options.region), null);
  assert.deepEqual(await shownBytes(page), first);
});

withPage('time has a slider where the script reads t, and plays', async ({page}) => {
  assert.equal(await page.getByLabel('Frame t', {exact: true}).isVisible(), false);
  await rendered(page, () => type(page, 'vec3(-1, 0, 0)', 'vec3(t / 50 - 1, 0, 0)'));
  const slider = page.getByLabel('Frame t', {exact: true});
  await slider.waitFor();
  const start = await shownBytes(page);
  await rendered(page, () => slider.fill('50'));
  assert.notDeepEqual(await shownBytes(page), start);
  await page.getByRole('button', {name: 'Play'}).click();
  await page.waitForFunction(() => studio.viewState.options.t >= 53);
  await page.getByRole('button', {name: 'Pause'}).click();
  await slider.fill('0');
  // A frame that was under way may still be shown before.
  await showsBytes(page, start);
  assert.equal(await slider.getAttribute('max'), '100');
  await rendered(page, () => type(page, 'Settings {', 'Settings { frames -> 48 '));
  assert.equal(await slider.getAttribute('max'), '47');
});

withPage('a kept picture is compared with later ones', async ({page}) => {
  await page.getByRole('button', {name: 'Compare'}).click();
  const kept = page.locator('.live canvas.kept');
  await kept.waitFor();
  await rendered(page, () => type(page, '0.7', '0.2'));
  assert.match(await kept.getAttribute('style'), /inset\(0px 50% 0px 0px\)/);
  await page.getByLabel('Line between').fill('80');
  assert.match(await kept.getAttribute('style'), /inset\(0px 20% 0px 0px\)/);
  await page.getByRole('button', {name: 'End', exact: true}).click();
  assert.equal(await kept.count(), 0);
});

withPage('numbers have sliders, texts lists, and materials balls', async ({page}) => {
  await page.locator('.tree .row', {hasText: 'Material'}).click();
  const image = page.locator('.sheet .ball');
  await image.waitFor();
  const before = await image.getAttribute('src');
  await page.locator('.property', {hasText: 'reflectivity'}).locator('button.default').click();
  await page.getByLabel('reflectivity as a slider').fill('0.4');
  assert.match(await text(page), /reflectivity -> 0\.4/);
  await page.waitForFunction((old) => studio.sheet.ball.src !== old, before);
  await page.locator('.tree .row', {hasText: 'Box'}).click();
  await image.waitFor();
  await page.locator('.tree .row', {hasText: 'Camera'}).click();
  await image.waitFor({state: 'hidden'});
  await page.locator('.property', {hasText: 'apertureshape'}).locator('button.default').click();
  await page.getByLabel('apertureshape', {exact: true}).selectOption('hexagon');
  assert.match(await text(page), /apertureshape -> "hexagon"/);
  const corners = await page.locator('.spots polygon').first().getAttribute('points');
  assert.equal(corners.split(' ').length, 6);
});

withPage('all that there is to choose from is right', async ({page}) => {
  // Each text of a list and each end of a slider is taken by the language.
  const {objects} = await page.evaluate(() => ({objects: [...studio.sheet.objects.values()]}));
  const {ranges} = await page.evaluate(() => studio.sheet.constructor.known);
  const choices = Object.fromEntries(objects.flatMap((object) => object.attributes
    .filter((attribute) => attribute.choices)
    .map((attribute) => [`${object.name}.${attribute.name}`, attribute.choices])));
  assert.ok(Object.keys(choices).length >= 8);
  const attributeOf = (path) => {
    const [object, name] = path.split('.');
    return objects.find((o) => o.name === object)?.attributes.find((a) => a.name === name);
  };
  for (const path of Object.keys(ranges))
    assert.match(attributeOf(path)?.type ?? 'none', /^(Float( or Pattern)?|Integer)$/, path);
  for (const [path, texts] of Object.entries(choices)) {
    assert.equal(attributeOf(path)?.type, 'String', path);
    if (path !== 'ImageMap.mapping' && path !== 'Background.projection')
      assert.ok(texts.includes(attributeOf(path).default.slice(1, -1)), path);
  }
  const lines = (object) => Object.entries(choices)
    .filter(([path]) => path.startsWith(`${object}.`))
    .flatMap(([path, texts]) => texts.map((value) => `${path.split('.')[1]} -> "${value}"`));
  const scripts = [
    ...lines('Settings').map((line) => `Settings { ${line} }\nScene { }\n`),
    ...lines('Camera').map((line) => 'Settings { camera -> Camera { position -> vec3(0, 0, -1) ' +
      `pointing -> vec3(0, 0, 0) ${line} } }\nScene { }\n`)];
  for (const script of scripts) {
    await page.evaluate((content) => {
      studio.timing.diagnostics = 0;
      studio.editor.replace(content);
    }, script);
    await page.waitForFunction(() => studio.timing.diagnostics > 0);
    assert.equal(await page.locator('#status').textContent(), '', script);
  }
});

withPage('the queue says how near pictures were to the last one, and how busy the machine is',
         async ({page}) => {
  await page.locator('.dv-tab', {hasText: 'Queue'}).click();
  assert.equal(await page.locator('.trade').isVisible(), false);
  await rendered(page, () =>
    type(page, 'supersampling -> 2', 'timebudget -> 1.5 maxsamples -> 65536'));
  await whole(page);
  await page.locator('.trade', {hasText: /steps of 8 bits[\d.]+ after/}).waitFor();
  const {measures, estimate} = await page.evaluate(() => studio.trade);
  const differences = measures.map(({difference}) => difference);
  assert.ok(differences.length > 1 && differences.every((value) => value > 0));
  assert.ok(differences.at(-1) < differences[0], String(differences));
  // The times are those of tracing, which the budget bounds.
  assert.ok(measures.every(({seconds}) => seconds > 0 && seconds < 1.8), JSON.stringify(measures));
  // What the render knows of its error is what is said of it.
  assert.ok(estimate.of95 > 0 && estimate.of95 < 255, JSON.stringify(estimate));
  await page.locator('.trade', {hasText: /own error, as it knows: 95 of 100 pixels within/}).waitFor();

  // The answer is that of `crt trade`: from when on all was so near, or that nobody can tell.
  const steps = page.getByLabel('Steps of 8 bits');
  const answer = () => page.locator('.trade output').textContent();
  await steps.fill('255');
  assert.equal(await answer(), `--timebudget ${Number(measures[0].seconds.toPrecision(2))}`);
  const wanted = Math.max(estimate.rms, differences[1]) * 1.001;
  const first = measures.find((_, i) =>
    measures.slice(i).every(({difference}) => difference <= wanted));
  await steps.fill(String(wanted));
  assert.equal(await answer(), `--timebudget ${Number(first.seconds.toPrecision(2))}`);
  await steps.fill(String(estimate.rms / 2));
  assert.equal(await answer(), 'the last picture is not certain enough to tell');

  await page.evaluate(() => studio.editor.view.focus());
  await rendered(page, () => page.keyboard.press('Control+z'));
  await page.locator('.trade').waitFor({state: 'hidden'});
  await page.locator('.queue .machine', {hasText: 'GiB'}).waitFor();
});

withPage('a turned camera stays while that of the script moves in time, until Home',
         async ({page}) => {
  await rendered(page, () => type(page, 'vec3(0, 0, -4)', 'vec3(t / 50, 0, -4)'));
  const slider = page.getByLabel('Frame t', {exact: true});
  await rendered(page, () => slider.fill('10'));
  assert.equal((await cameraOf(page)).position[0], 0.2);
  await rendered(page, () => dragPicture(page, 60, 0));
  const turned = await cameraOf(page);
  await rendered(page, () => slider.fill('20'));
  assert.deepEqual((await cameraOf(page)).position, turned.position);
  assert.equal(await page.evaluate(() => studio.scene.isOverridden), true);
  await page.locator('.live canvas').focus();
  await rendered(page, () => page.keyboard.press('Home'));
  assert.equal((await cameraOf(page)).position[0], 0.4);
});

withPage('a click says where it was', async ({page}) => {
  await clickPicture(page, ...ball);
  await page.locator('.controls output', {hasText: 'away, at'}).waitFor();
});

test('what was typed in another browser is offered after a crash', async () => {
  const {folder, remove} = folderWith({'a.crt': scene});
  const first = await startServer(folder, 'a.crt');
  const page = await openPage(browser(), first.url);
  await whole(page);
  await type(page, '0.7', '0.55');
  await whole(page);
  while (!keptTexts(folder).some((kept) => kept.includes('0.55')))
    await new Promise((resolve) => setTimeout(resolve, 20));
  await first.end('SIGKILL');
  await page.context().close();
  const second = await startServer(folder, 'a.crt');
  const next = await openPage(browser(), second.url);
  await whole(next);
  assert.equal(await text(next), scene);
  await next.getByRole('button', {name: 'Go on with it'}).click();
  assert.equal(await text(next), scene.replace('0.7', '0.55'));
  await next.context().close();
  const left = join(folder, '.a.crt.1.typed');
  writeFileSync(left, scene.replace('0.7', '0.44'));
  const later = Date.now() / 1000 + 60;  // than the server may still write what `next` had
  utimesSync(left, later, later);
  const other = await openPage(browser(), second.url);
  await other.getByRole('button', {name: 'Discard it'}).click();
  await whole(other);
  await other.context().close();
  assert.equal(await second.end(), 0);
  assert.deepEqual(keptTexts(folder), [scene.replace('0.7', '0.55')]);
  remove();
});

test('the picture alone fills the page, also where the browser keeps nothing', async () => {
  const {folder, remove} = folderWith({'a.crt': scene});
  const server = await startServer(folder, 'a.crt');
  const context = await browser().newContext({viewport: {width: 800, height: 480}});
  await context.addInitScript(() => Object.defineProperty(window, 'localStorage', {
    get() { throw new DOMException('Access is denied', 'SecurityError'); },
  }));
  const page = await context.newPage();
  try {
    await page.goto(`${server.url}&only=view`);
    await whole(page);
    const {height} = await page.locator('.live canvas').boundingBox();
    assert.ok(height > 400, `${height} pixels high`);
    assert.equal(await page.locator('.dv-tab:visible').count(), 0);
    assert.equal(await page.locator('#status').isVisible(), false);
    writeFileSync(join(folder, 'a.crt'), 'Scene {\n  nothing\n}\n');
    await page.locator('#status', {hasText: 'Line 2: '}).waitFor();  // an error is not hidden
  } finally {
    await context.close();
    await server.end();
    remove();
  }
});
