// What is selected is copied as source code, and scenes of programs are shown without an editor.
import assert from 'node:assert/strict';
import {spawn} from 'node:child_process';
import {join} from 'node:path';
import {test} from 'node:test';
import {browser, clickPicture, pixelAt, selectedText, withPage} from './page.mjs';
import {openPage, project, whole} from './studio.mjs';

const example = process.env.CRT_STUDIO_SCENE ?? join(project, 'build/release/bin/studio_scene');

const copied = async (page, what) => {
  await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
  await page.getByLabel('Copy as source code').selectOption(what);
  await page.locator('.console .line', {hasText: 'is in the clipboard'}).last().waitFor();
  return page.evaluate(() => navigator.clipboard.readText());
};

withPage('the selected entity and the scene are copied in each language', async ({page}) => {
  await clickPicture(page, 0.75, 0.5);
  await page.waitForFunction(() => studio.sheet.node?.name === 'Box');
  assert.match(await copied(page, 'entity cpp'), /Box\{\.corner_a = \{0\.5, -0\.5, -0\.5\}/);
  await page.evaluate(() => studio.console.element.replaceChildren());
  const scene = await copied(page, 'scene python');
  assert.match(scene, /crt\.Box\(.*\n?.*crt\.Settings/s);
  assert.match(scene, /crt\.Sphere\(center=\(-1, 0, 0\), radius=0\.7/);
  await page.evaluate(() => studio.console.element.replaceChildren());
  assert.match(await copied(page, 'scene c'), /crt_box_create/);
  await page.evaluate(() => studio.console.element.replaceChildren());
  assert.match(await copied(page, 'scene script'), /Scene \{\n.*Box \{ cornerA -> /s);
});

test('a scene of a program is listed, turned and picked, and cannot be changed', async () => {
  const program = spawn(example, {stdio: ['pipe', 'pipe', 'inherit']});
  const ended = new Promise((resolve) => program.on('exit', resolve));
  const url = await new Promise((resolve) => program.stdout.once('data', (data) =>
    resolve(/http:\S+/.exec(data)[0])));
  const page = await openPage(browser(), url);
  try {
    await whole(page);
    assert.equal(await page.title(), 'ring of balls – CRT studio');
    assert.equal(await page.locator('.tree .row').count(), 8);
    assert.equal(await page.getByRole('button', {name: 'Save'}).isVisible(), false);
    assert.equal(await page.getByRole('button', {name: 'PNG'}).isVisible(), true);

    await page.evaluate(() => studio.editor.view.focus());
    const text = await page.evaluate(() => studio.editor.text);
    await page.keyboard.type('Sphere');
    assert.equal(await page.evaluate(() => studio.editor.text), text);

    await page.locator('.tree .row').nth(1).click();
    assert.match(await selectedText(page), /^Sphere  center \(2, 0\.5, 0\)  radius 0\.5/);
    await page.locator('.property', {hasText: 'radius'}).waitFor();
    await clickPicture(page, 0.5, 0.95);
    await page.waitForFunction(() => studio.editor.view.state.selection.main.from === 0);
    assert.match(await selectedText(page), /^Plane/);

    const before = await pixelAt(page, 0.25, 0.5);
    program.stdin.write('1\n');
    await page.waitForFunction(() => document.querySelectorAll('.tree .row').length === 2);
    await whole(page);
    assert.notDeepEqual(await pixelAt(page, 0.25, 0.5), before);
    assert.deepEqual(page.problems, []);
  } finally {
    await page.context().close();
    program.stdin.end();
    assert.equal(await ended, 0);
  }
});

withPage('a page in a frame may show the picture alone', async ({page, server}) => {
  const alone = await openPage(browser(), `${server.url}&only=view`, {width: 400, height: 300});
  await whole(alone);
  assert.equal(await alone.locator('.live canvas').isVisible(), true);
  assert.equal(await alone.locator('#bar').isVisible(), false);
  assert.equal(await alone.locator('.tree').count(), 0);
  assert.deepEqual(alone.problems, []);
  await alone.context().close();
  await page.reload();
  await whole(page);
  assert.equal(await page.locator('.tree').count(), 1);
});
