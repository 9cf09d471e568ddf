// Materials and lights that are inserted from the list, where they belong.
import assert from 'node:assert/strict';
import {pixelAt, scene, selectedText, shownBytes, withPage} from './page.mjs';
import {rendered, text, type} from './studio.mjs';

const insert = (page, what) => page.getByLabel('Insert into the script').selectOption(what);
const optionsOf = (page, group) => page.locator(`optgroup[label="${group}"] option`)
  .evaluateAll((options) => options.map(({value}) => value));
const settled = (page) => page.waitForFunction(() => studio.timing.diagnostics > 0 &&
  studio.queue.title.textContent === 'Done');

withPage('each light goes into the list of lights, and lights the scene', async ({page}) => {
  const dark = await pixelAt(page, 0.29, 0.5);
  const kinds = await optionsOf(page, 'Lights');
  assert.equal(kinds.length, 5);
  let count = 0;
  for (const kind of kinds) {
    await rendered(page, () => insert(page, kind));
    await page.waitForFunction((wanted) => studio.scene.lights === wanted, ++count);
    const selected = await selectedText(page);
    assert.match(selected, /^\w+Light \{.*\}$/, kind);
    assert.equal(await page.locator('#status').textContent(), '', kind);
    await page.locator('.sheet h2', {hasText: selected.split(' ')[0]}).waitFor();
  }
  assert.match(await text(page), /pointing -> vec3\(0, 0, 0\) }\n {4}lights -> \[SphereLight {.*}, /);
  assert.notDeepEqual(await pixelAt(page, 0.29, 0.5), dark);
  // Each was one edit.
  for (const _ of kinds) await page.keyboard.press('Control+z');
  assert.equal(await text(page), scene);
});

withPage('a light is as bright, where the camera looks, as a white light of 1', async ({page}) => {
  for (const kind of ['Sphere light', 'Disc light', 'Soft sun']) {
    await page.evaluate((content) => studio.editor.replace(content), scene);
    await rendered(page, () => insert(page, kind));
    const code = await text(page);
    const [, place] = /(?:center|from) -> vec3\(([^)]*)\)/.exec(code.slice(code.indexOf('lights')));
    // A grey wall faces the light, in the middle of the picture.
    await rendered(page, () => page.evaluate((content) => studio.editor.replace(content),
      code.slice(0, code.indexOf('ball =')).replace('Settings {', 'Settings { gamma -> 1') +
      `Scene { Plane { normal -> vec3(${place}) position -> vec3(0, 0, 0)
        material -> Material { color -> rgb(0.5, 0.5, 0.5) } } }`));
    await settled(page);
    const [value] = await pixelAt(page, 0.5, 0.5);
    assert.ok(Math.abs(value - 127.5) < 10, `${kind}: ${value}`);
  }
});

withPage('lights on lines of their own get another line, and computed ones stay',
         async ({page}) => {
  const list = '    lights -> [\n' +
    '        PointLight { origin -> vec3(0, 9, -9) color -> rgb(1, 1, 1) }\n    ]\n';
  await rendered(page, () => page.evaluate((content) => studio.editor.replace(content),
    scene.replace('    camera', `${list}    camera`)));
  await settled(page);
  await rendered(page, () => insert(page, 'Light of the background'));
  assert.match(await text(page),
    /rgb\(1, 1, 1\) },\n {8}EnvironmentLight { scale -> 1 }\n {4}\]/);
  const computed = `shine = [PointLight { origin -> vec3(0, 9, -9) color -> rgb(1, 1, 1) }]\n${scene}`
    .replace('    camera', '    lights -> shine\n    camera');
  await rendered(page, () => page.evaluate((content) => studio.editor.replace(content), computed));
  await settled(page);
  await insert(page, 'Soft sun');
  await page.locator('.console .warning', {hasText: "the lights are the variable 'shine'"})
    .waitFor();
  assert.equal(await text(page), computed);
  // A script without settings gets some, and an empty list its first light.
  await rendered(page, () => page.evaluate((content) => studio.editor.replace(content),
    'Scene { Sphere { center -> vec3(0, 0, 3) radius -> 1 } }\n'));
  await settled(page);
  await rendered(page, () => insert(page, 'Light of the background'));
  await rendered(page, () => type(page, 'EnvironmentLight { scale -> 1 }', ''));
  await settled(page);
  await rendered(page, () => insert(page, 'Light of the background'));
  assert.match(await text(page), /^Settings {\n {4}lights -> \[EnvironmentLight { scale -> 1 }\]\n}/);
});

withPage('materials are variables before the scene, and the library is imported once',
         async ({page}) => {
  const before = await shownBytes(page);
  for (const kind of (await optionsOf(page, 'Materials')).slice(0, -1)) {
    await rendered(page, () => insert(page, kind));
    assert.match(await selectedText(page), /^PrincipledMaterial \{.*\}$/);
    await page.locator('.sheet h2', {hasText: 'PrincipledMaterial'}).waitFor();
  }
  await rendered(page, () => insert(page, 'Metal'));
  assert.match(await text(page), /\nmetal = Pri.*\n(.*\n)*metal2 = Principled.*\nScene {/);
  await rendered(page, () => insert(page, 'Library of materials'));
  assert.match(await text(page), /^import "crt\/materials"\nSettings {/);
  await settled(page);
  await insert(page, 'Library of materials');
  await page.locator('.console .warning', {hasText: 'is imported already'}).waitFor();
  assert.equal((await text(page)).split('import').length, 2);
  await rendered(page, () => type(page, 'material -> red', 'material -> metal2'));
  assert.notEqual(await shownBytes(page), before);
});
