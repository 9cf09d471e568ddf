// A newcomer's first five minutes: open an example, type, drag, turn, click, undo and save.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import {test} from 'node:test';
import {browser, clickPicture, dragPicture, selectedText, shownBytes} from './page.mjs';
import {copyScene, folderWith, openPage, rendered, startServer, text, type, whole}
  from './studio.mjs';

test('a newcomer opens an example, changes it, looks around and saves it', async () => {
  const {folder, remove} = folderWith({});
  copyScene(folder, 'csg.crt');
  const file = join(folder, 'csg.crt');
  const original = readFileSync(file, 'utf8');
  const server = await startServer(folder);
  const page = await openPage(browser(), server.url);
  await whole(page);
  assert.equal(await text(page), original);

  // Typing changes the picture. A mistake is said in words, and its end is seen.
  const first = await shownBytes(page);
  await type(page, 'supersampling -> 4', 'supersampling -> 2');
  await whole(page);
  await type(page, 'Scene {', 'Scene { Sphere { }');
  await page.waitForFunction(() => document.getElementById('status').className === 'error');
  assert.match(await page.locator('#status').textContent(), /Line \d+: .*center/);
  await page.keyboard.press('Control+z');
  await page.waitForFunction(() => document.getElementById('status').textContent === '');
  await whole(page);

  // Turning the view is followed at once, and Home leads back.
  const start = await shownBytes(page);
  await rendered(page, () => dragPicture(page, 80, 20));
  assert.notDeepEqual(await shownBytes(page), start);
  await rendered(page, () => page.keyboard.press('Home'));
  assert.deepEqual(await shownBytes(page), start);

  // A click leads to the statement, and numbers are changed by dragging their names.
  await clickPicture(page, 0.5, 0.5);
  await page.waitForFunction(() => studio.editor.view.state.selection.main.empty === false);
  assert.notEqual(await selectedText(page), '');
  await page.locator('.tree .row', {hasText: 'Sphere'}).first().click();
  const before = await text(page);
  const label = page.locator('.sheet label.draggable').first();
  const box = await label.boundingBox();
  await page.mouse.move(box.x + 5, box.y + 5);
  await page.mouse.down();
  await rendered(page, () => page.mouse.move(box.x + 25, box.y + 5, {steps: 5}));
  await page.mouse.up();
  assert.notEqual(await text(page), before);

  // Saving writes what is seen, and nothing is left to be saved.
  await page.evaluate(() => studio.editor.view.focus());
  await page.keyboard.press('Control+s');
  await page.getByText('Saved csg.crt').waitFor();
  assert.equal(readFileSync(file, 'utf8'), await text(page));
  assert.equal(await page.evaluate(() => studio.file.isChanged), false);
  assert.notDeepEqual(await shownBytes(page), first);
  assert.deepEqual(page.problems, []);
  await page.context().close();
  assert.equal(await server.end(), 0);
  remove();
});
