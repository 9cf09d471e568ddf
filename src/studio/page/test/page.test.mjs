// The page in a real browser: what somebody does who opens it for the first time.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {readFileSync, renameSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {test} from 'node:test';
import {browser, cameraOf, clickPicture, dragPicture, scene, selectedText, shown, shownBytes,
        withPage} from './page.mjs';
import {command, folderWith, openPage, startServer, text, type, whole} from './studio.mjs';

withPage('the last picture has the bytes of crt render', async ({page, folder}) => {
  const [download] = await Promise.all([
    page.waitForEvent('download'), page.getByRole('button', {name: 'PNG'}).click()]);
  const output = join(folder, 'a.png');
  execFileSync(command, ['render', '-q', '--reproducible', '-o', output, join(folder, 'a.crt')]);
  assert.ok(readFileSync(await download.path()).equals(readFileSync(output)));
  assert.equal(download.suggestedFilename(), 'a.png');
});

withPage('typing changes the picture', async ({page}) => {
  const first = await shownBytes(page);
  await type(page, 'radius -> 0.7', 'radius -> 0.3');
  await whole(page);
  assert.notDeepEqual(await shownBytes(page), first);
  await page.keyboard.press('Control+z');
  await whole(page);
  assert.deepEqual(await shownBytes(page), first);
});

withPage('a broken script is marked, keeps its picture, and is mended', async ({page}) => {
  const first = await shownBytes(page);
  await type(page, 'radius', 'radios');
  await page.waitForFunction(() => document.getElementById('status').className === 'error');
  assert.match(await page.locator('#status').textContent(), /radios/);
  await page.locator('.cm-lintRange-error').first().waitFor();
  assert.deepEqual(await shownBytes(page), first);
  await type(page, 'radios', 'radius');
  await page.waitForFunction(() => document.getElementById('status').textContent === '');
  await whole(page);
  assert.deepEqual(await shownBytes(page), first);
});

withPage('words have the colours of what they are', async ({page}) => {
  for (const [kind, word] of [['object', 'Sphere'], ['attribute', 'radius'], ['number', '0.7'],
                              ['keyword', 'Scene'], ['function', 'vec3']])
    await page.locator(`.token-${kind}`, {hasText: word}).first().waitFor();
});

withPage('completion offers what may come', async ({page}) => {
  await type(page, 'material -> red', 'mat');
  await page.keyboard.press('Control+Space');
  await page.locator('.cm-tooltip-autocomplete', {hasText: 'material'}).waitFor();
  await page.waitForTimeout(100);  // CodeMirror takes no key just after the list has come
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => studio.editor.text.includes('material -> '));
});

withPage('F12 goes to the definition, and the formatter lays out', async ({page}) => {
  await type(page, '    ball\n', '        ball\n');
  await page.evaluate((place) =>
    studio.editor.view.dispatch({selection: {anchor: place}}), (await text(page)).lastIndexOf('ball'));
  await page.keyboard.press('F12');
  await page.waitForFunction(() => studio.editor.view.state.selection.main.from ===
    studio.editor.text.indexOf('ball = Sphere'));
  await page.getByRole('button', {name: 'Format'}).click();
  await page.waitForFunction((all) => studio.editor.text === all, scene);
});

withPage('F2 gives a name another one, as one edit, and says where else it stands',
         async ({page, folder}) => {
  const rename = async (word, name) => {
    await page.evaluate((place) => {
      studio.editor.view.dispatch({selection: {anchor: place}});
      studio.editor.view.focus();
    }, (await text(page)).lastIndexOf(word));
    await page.keyboard.press('F2');
    await page.getByLabel('New name').fill(name);
    await page.keyboard.press('Enter');
  };
  await rename('red', 'crimson');
  await page.waitForFunction((wanted) => studio.editor.text === wanted,
                             scene.replaceAll('red', 'crimson'));
  await page.keyboard.press('Control+z');
  assert.equal(await text(page), scene);
  await rename('red', 'ball');
  await page.locator('.console', {hasText: "'ball' already means something"}).waitFor();
  assert.equal(await text(page), scene);
  writeFileSync(join(folder, 'part.crt'), 'size = 0.7\n');
  await type(page, 'ball = Sphere', 'import "part.crt"\nball = Sphere');
  await type(page, 'radius -> 0.7', 'radius -> size');
  await rename('size', 'width');
  await page.locator('.console', {hasText: "'size' also stands in"}).waitFor();
  assert.match(await text(page), /radius -> width/);
});

withPage('a click selects the entity, its statement and its properties', async ({page}) => {
  await clickPicture(page, 0.68, 0.5);
  await page.waitForFunction(() => studio.sheet.node?.name === 'Box');
  assert.match(await selectedText(page), /^Box \{/);
  assert.equal(await page.locator('.tree .row[aria-selected]').textContent(), '●Box');
  assert.match(await page.locator('.sheet .computed').getAttribute('title'), /the variable 'red'/);
});

withPage('what a click on a combination leads to are the properties of what it is made of',
         async ({page}) => {
  await type(page, '    ball\n', '    (ball + ball) <translate vec3(0, 0.1, 0)>\n');
  await whole(page);
  // The cursor is in the scene, and in none of its objects.
  await page.waitForFunction(() => studio.sheet.node === null);
  await clickPicture(page, 0.3, 0.5);
  await page.waitForFunction(() => {
    const {from, to} = studio.editor.view.state.selection.main;
    return studio.editor.text.slice(from, to).startsWith('(ball + ball)');
  });
  await page.waitForFunction(() => studio.sheet.node?.name === 'Sphere');
});

withPage('a changed property is an edit of the text, and undone as one', async ({page}) => {
  await page.locator('.tree .row', {hasText: 'Sphere'}).click();
  const label = page.locator('.sheet label', {hasText: 'radius'});
  const box = await label.boundingBox();
  await page.mouse.move(box.x + 5, box.y + 5);
  await page.mouse.down();
  for (let i = 1; i <= 20; ++i) await page.mouse.move(box.x + 5 + i, box.y + 5);
  await page.mouse.up();
  assert.match(await text(page), /radius -> 0\.84 \}/);
  await whole(page);
  await page.evaluate(() => studio.editor.view.focus());
  await page.keyboard.press('Control+z');
  assert.equal(await text(page), scene);
});

withPage('vectors, colours and absent attributes have their fields', async ({page}) => {
  await page.locator('.tree .row', {hasText: 'Material'}).click();
  await page.getByLabel('color as a colour').fill('#00ff00');
  assert.match(await text(page), /color -> rgb\(0, 1, 0\)/);
  await page.locator('.property', {hasText: 'reflectivity'}).locator('button.default').click();
  assert.match(await text(page), /rgb\(0, 1, 0\) reflectivity -> 0 \}/);
  await page.locator('.tree .row', {hasText: 'Sphere'}).click();
  await page.getByLabel('center y').fill('0.25');
  assert.match(await text(page), /center -> vec3\(-1, 0\.25, 0\)/);
  await whole(page);
});

withPage('dragging orbits, Shift pans, the wheel and keys go nearer, Home returns', async ({page}) => {
  const start = await cameraOf(page);
  await dragPicture(page, 60, 0);
  const turned = await cameraOf(page);
  assert.deepEqual(turned.pointing, start.pointing);
  assert.ok(Math.abs(Math.hypot(...turned.position) - 4) < 1e-9);
  assert.ok(Math.abs(turned.position[0]) > 1);
  await dragPicture(page, 40, 20, 'Shift');
  assert.notDeepEqual((await cameraOf(page)).pointing, start.pointing);
  await page.mouse.wheel(0, -200);
  await page.waitForFunction((far) => {
    const {position, pointing} = studio.camera;
    return Math.hypot(...position.map((p, i) => p - pointing[i])) < far;
  }, 3.9);
  const before = await shown(page);
  await page.keyboard.press('ArrowUp');
  await page.waitForFunction((count) => studio.view.shown > count, before);
  await page.keyboard.press('Home');
  await page.waitForFunction(() => studio.camera === null && studio.scene.isOverridden === false);
});

withPage('the view is written into the script as one edit', async ({page}) => {
  await dragPicture(page, 60, 30);
  await page.waitForFunction(() => studio.scene.isOverridden);
  await page.getByRole('button', {name: 'Camera to script'}).click();
  await page.waitForFunction(() => studio.scene.isOverridden === false);
  assert.doesNotMatch(await text(page), /vec3\(0, 0, -4\)/);
  await whole(page);
  await page.evaluate(() => studio.editor.view.focus());
  await page.keyboard.press('Control+z');
  assert.equal(await text(page), scene);
});

withPage('saving writes the file', async ({page, folder}) => {
  await type(page, '0.7', '0.6');
  await page.keyboard.press('Control+s');
  await page.getByText('Saved a.crt').waitFor();
  assert.equal(readFileSync(join(folder, 'a.crt'), 'utf8'), scene.replace('0.7', '0.6'));
  // So it does from everywhere else.
  await type(page, '0.6', '0.5');
  await page.locator('.live canvas').focus();
  await page.keyboard.press('Control+s');
  await page.waitForFunction(() => !studio.file.isChanged);
  assert.equal(readFileSync(join(folder, 'a.crt'), 'utf8'), scene.replace('0.7', '0.5'));
});

/** Writes the script at once, as the server may look at any time. */
function writeWhole(folder, text) {
  writeFileSync(join(folder, 'a.new'), text);
  renameSync(join(folder, 'a.new'), join(folder, 'a.crt'));
}

withPage('what another program writes is shown, and what was typed is not lost by it',
         async ({page, folder}) => {
  writeWhole(folder, scene.replace('0.7', '0.4'));
  await page.waitForFunction(() => studio.editor.text.includes('radius -> 0.4'));
  assert.equal(await page.evaluate(() => studio.file.isChanged), false);
  await type(page, '0.4', '0.45');
  writeWhole(folder, scene.replace('0.7', '0.9'));
  await page.getByRole('button', {name: 'Keep what is here'}).click();
  assert.match(await text(page), /radius -> 0\.45/);
  writeWhole(folder, scene.replace('0.7', '0.8'));
  await page.getByRole('button', {name: 'Take the file'}).click();
  assert.equal(await text(page), scene.replace('0.7', '0.8'));
  await page.evaluate(() => studio.editor.view.focus());
  await page.keyboard.press('Control+z');
  assert.match(await text(page), /radius -> 0\.45/);
});

withPage('nothing that was typed is lost with the page', async ({page, folder, server}) => {
  await type(page, '0.7', '0.55');
  const next = await page.context().newPage();
  await page.close({runBeforeUnload: false});
  await next.goto(server.url);
  await next.waitForFunction(() => studio.editor.text.includes('0.55'));
  assert.equal(readFileSync(join(folder, 'a.crt'), 'utf8'), scene);
});

withPage('the picture has the most room, and all panels are seen at 1280 by 720', async ({page}) => {
  const boxes = {};
  for (const name of ['live', 'editor', 'tree', 'sheet', 'console'])
    boxes[name] = await page.locator(`.${name}`).boundingBox();
  for (const box of Object.values(boxes)) {
    assert.ok(box.width > 200 && box.height > 80, JSON.stringify(boxes));
    assert.ok(box.x >= 0 && box.x + box.width <= 1281 && box.y + box.height <= 721);
  }
  assert.ok(boxes.live.width * boxes.live.height > 1280 * 720 / 4, JSON.stringify(boxes));
});

withPage('the layout and the theme are kept', async ({page, server}) => {
  const theme = await page.evaluate(() => document.documentElement.dataset.theme);
  await page.getByRole('button', {name: 'Theme'}).click();
  await page.locator('.dv-tab', {hasText: 'Statistics'}).click();
  await page.locator('.statistics').waitFor();
  await page.evaluate(() => studio.layout.dock.getPanel('queue').api.close());
  await page.goto('about:blank');
  await page.goto(server.url);
  await whole(page);
  assert.notEqual(await page.evaluate(() => document.documentElement.dataset.theme), theme);
  assert.equal(await page.locator('.dv-tab', {hasText: 'Queue'}).count(), 0);
  await page.getByLabel('Show a panel').selectOption('queue');
  await page.locator('.queue progress').waitFor();
});

test('a server that is killed in a render leaves the text, and its next run goes on', async () => {
  const {folder, remove} = folderWith({'a.crt': scene});
  const first = await startServer(folder, 'a.crt');
  const port = new URL(first.url).port;
  const page = await openPage(browser(), first.url);
  await whole(page);
  await type(page, 'supersampling -> 2', 'supersampling -> 64');
  await page.waitForFunction(() => studio.view.lastKind !== 'final');
  await first.end('SIGKILL');
  await page.waitForFunction(() => document.body.classList.contains('lost'));
  await type(page, '64', '3');
  const second = await startServer(folder, 'a.crt', port);
  await page.goto('about:blank');
  await page.goto(second.url);
  await page.waitForFunction(() => studio.editor.text.includes('supersampling -> 3'));
  await whole(page);
  await page.context().close();
  assert.equal(await second.end(), 0);
  remove();
});

withPage('two tabs have scripts of their own', async ({page, server}) => {
  const other = await openPage(browser(), server.url);
  await whole(other);
  await type(other, '0.7', '0.2');
  await whole(other);
  assert.equal(await text(page), scene);
  assert.notDeepEqual(await shownBytes(other), await shownBytes(page));
  await other.context().close();
});

withPage('a page of another origin gets nothing', async ({page, server, folder}) => {
  const {port, hash} = new URL(server.url);
  const hostile = await browser().newPage();
  const {folder: other, remove} = folderWith({'b.crt': scene});
  const elsewhere = await startServer(other, 'b.crt');
  await hostile.goto(elsewhere.url.replace(/#.*/, 'licenses.txt'));
  const answer = await hostile.evaluate(([target]) => new Promise((resolve) => {
    const socket = new WebSocket(target);
    socket.onopen = () => resolve('open');
    socket.onerror = () => resolve('refused');
  }), [`ws://127.0.0.1:${port}/socket?${hash.slice(1)}`]).catch(() => 'refused');
  assert.equal(answer, 'refused');
  await hostile.close();
  await elsewhere.end();
  remove();
  assert.equal(readFileSync(join(folder, 'a.crt'), 'utf8'), scene);
  assert.equal(await text(page), scene);
});

withPage('a script of 10000 lines can be typed in', async ({page, folder}) => {
  const long = scene.replace('Scene {\n', 'Scene {\n' +
    '    Sphere { center -> vec3(0, 0, 9) radius -> 0.1 }\n'.repeat(10000));
  writeFileSync(join(folder, 'long.crt'), long);
  await page.evaluate(() => studio.file.open('long.crt'));
  await page.waitForFunction(() => studio.editor.view.state.doc.lines > 10000);
  await whole(page);
  await type(page, '0.7', '0.6');
  await whole(page);
  const {diagnostics} = await page.evaluate(() => studio.timing);
  assert.ok(diagnostics > 0);
});
