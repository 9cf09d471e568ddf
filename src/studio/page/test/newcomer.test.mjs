// A newcomer's first five minutes: open an example, type, drag, turn, click, undo and save.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {test} from 'node:test';
import {browser, clickPicture, dragPicture, scene, selectedText, shownBytes, withPage}
  from './page.mjs';
import {command, copyScene, folderWith, openPage, rendered, startServer, text, type, whole}
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

test('in a folder without a script one is begun, rendered and saved', async () => {
  const {folder, remove} = folderWith({});
  const server = await startServer(folder);
  const page = await openPage(browser(), server.url);
  try {
    await page.locator('.live .hint', {hasText: 'has no script yet'}).waitFor();
    page.once('dialog', (dialog) => dialog.accept('first'));
    await page.getByRole('button', {name: 'New script…'}).click();
    await whole(page);
    // It is a good example: nothing is wrong with it, and it is laid out.
    assert.equal(await page.locator('#status').textContent(), '');
    assert.equal(await page.locator('.console .warning').count(), 0);
    const begun = await text(page);
    execFileSync(command, ['new', 'new.crt', '-q'], {cwd: folder});
    const written = readFileSync(join(folder, 'new.crt'), 'utf8');
    assert.equal(begun, written.replace('new.crt', 'first.crt'));
    await page.getByRole('button', {name: 'Format'}).click();
    await page.evaluate(() => studio.ask('hover', 0));
    assert.equal(await text(page), begun);
    await page.getByRole('button', {name: 'Save'}).click();
    await page.getByText('Saved first.crt').waitFor();
    assert.equal(readFileSync(join(folder, 'first.crt'), 'utf8'), begun);
    assert.equal(await page.title(), 'first.crt – CRT studio');
    assert.deepEqual(page.problems, []);
  } finally {
    await page.context().close();
    assert.equal(await server.end(), 0);
    remove();
  }
});

withPage('what is typed and not saved is kept while another script is looked at',
         async ({page, folder}) => {
  writeFileSync(join(folder, 'b.crt'), scene.replace('0.7', '0.1'));
  await page.reload();
  await whole(page);
  await type(page, '0.7', '0.55');
  const list = page.getByLabel('Script to open');
  await list.selectOption('b.crt');
  await page.waitForFunction(() => studio.editor.text.includes('radius -> 0.1'));
  await list.selectOption('a.crt');
  await page.waitForFunction(() => studio.editor.text.includes('radius -> 0.55'));
  await page.getByRole('button', {name: 'Take the file'}).click();
  assert.equal(await text(page), scene);
});

withPage('a script that is wrong from the start says so in the place of the picture',
         async ({page, folder}) => {
  writeFileSync(join(folder, 'b.crt'), 'x = 0\nwhile (x < 1) { x = 0 }\nScene { }\n');
  await page.evaluate(() => studio.file.open('b.crt'));
  await page.locator('.live .hint', {hasText: /There is no picture: line 2: .* steps/}).waitFor();
  assert.equal(await page.locator('.live canvas').isVisible(), false);
  // A picture of the script before that comes late is not shown.
  await page.evaluate(() => studio.view.show({
    kind: 'draft', isLast: true, picture: 1, revision: 1, fullWidth: 2, fullHeight: 2, width: 1,
    height: 1, row: 0, rows: 1, pixels: new Uint8ClampedArray(4)}));
  assert.equal(await page.locator('.live canvas').isVisible(), false);
  await page.locator('#status.error', {hasText: /^Line 2: .* steps/}).waitFor();
  await page.evaluate(() => studio.file.open('a.crt'));
  await whole(page);
  assert.equal(await page.locator('#status').textContent(), '');
  assert.equal(await page.locator('.live canvas').isVisible(), true);
});

withPage('the console has what the last run said, once', async ({page}) => {
  await rendered(page, () => type(page, 'ball = ', 'print("here", 1)\nball = '));
  await page.locator('.console .print', {hasText: 'here 1'}).waitFor();
  await rendered(page, () => type(page, '"here"', '"there"'));
  await rendered(page, () => dragPicture(page, 60, 30));
  assert.deepEqual(await page.locator('.console .of-run').allTextContents(),
                   ['there 1', 'the scene has no lights: a head light shines from the camera']);
});

withPage('a picture larger than a screen is shown smaller, and picked at its own pixels',
         async ({page}) => {
  await rendered(page, () => type(page, 'width -> 320 height -> 240 supersampling -> 2',
    'width -> 4800 height -> 2400'));
  await page.waitForFunction(() => studio.view.lastKind === 'final');
  assert.deepEqual(await page.evaluate(() => [studio.view.canvas.width, studio.view.canvas.height]),
                   [2400, 1200]);
  await page.getByLabel('Bounds').check();
  const found = await page.evaluate(async () => {
    const pick = await studio.connection.ask({type: 'pick', x: 1680, y: 1200});
    return studio.view.overlay.placeOf(pick.position);
  });
  assert.ok(Math.hypot(found[0] - 1680, found[1] - 1200) < 0.01, String(found));
  await clickPicture(page, 0.35, 0.5);
  await page.waitForFunction(() => studio.sheet.node?.name === 'Sphere');
});
