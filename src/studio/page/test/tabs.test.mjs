// The same script in two tabs: what is typed in one is never lost by the other.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import {test} from 'node:test';
import {browser} from './page.mjs';
import {folderWith, keptTexts, openPage, startServer, text, type, whole}
  from './studio.mjs';

const scene = `Settings { width -> 64 height -> 48 }
Scene { Sphere { center -> vec3(0, 0, 2) radius -> 0.7 } }
`;
const withRadius = (radius) => scene.replace('0.7', radius);

/** Opens the script in two tabs of one browser and types something else into each. */
async function typeInTwoTabs(action) {
  const {folder, remove} = folderWith({'a.crt': scene});
  const server = await startServer(folder, 'a.crt');
  const first = await openPage(browser(), server.url);
  await whole(first);
  const second = await first.context().newPage();
  await second.goto(server.url);
  await whole(second);
  await type(first, '0.7', '0.5');
  await type(second, '0.7', '0.9');
  while (keptTexts(folder).length < 2) await new Promise((resolve) => setTimeout(resolve, 20));
  await action({first, second, server, folder, file: join(folder, 'a.crt')});
  await first.context().close();
  remove();
}

test('both texts are there after the browser and the server have crashed', async () => {
  await typeInTwoTabs(async ({first, server, folder}) => {
    await server.end('SIGKILL');
    await first.context().close();
    const again = await startServer(folder, 'a.crt');
    const found = [];
    for (let i = 0; i < 2; ++i) {
      const page = await openPage(browser(), again.url);
      await page.getByRole('button', {name: 'Go on with it'}).click();
      found.push(await text(page));
    }
    assert.deepEqual(found.sort(), [withRadius('0.5'), withRadius('0.9')]);
    assert.equal(await again.end(), 0);
  });
});

test('what one tab saves is not written over by the other unasked', async () => {
  await typeInTwoTabs(async ({first, second, server, folder, file}) => {
    await first.bringToFront();
    await first.evaluate(() => studio.editor.view.focus());
    await first.keyboard.press('Control+s');
    await first.getByText('Saved a.crt').waitFor();
    await second.bringToFront();
    await second.getByRole('button', {name: 'Keep what is here'}).waitFor();
    assert.equal(await text(second), withRadius('0.9'));
    assert.deepEqual(keptTexts(folder), [withRadius('0.9')]);
    const questions = [];
    second.once('dialog', (dialog) => {
      questions.push(dialog.message());
      void dialog.dismiss();
    });
    await second.evaluate(() => studio.editor.view.focus());
    await second.keyboard.press('Control+s');
    assert.match(questions[0], /was changed by another program/);
    assert.equal(readFileSync(file, 'utf8'), withRadius('0.5'));
    await second.getByRole('button', {name: 'Keep what is here'}).click();
    await second.evaluate(() => studio.editor.view.focus());
    await second.keyboard.press('Control+s');
    await second.getByText('Saved a.crt').waitFor();
    assert.equal(readFileSync(file, 'utf8'), withRadius('0.9'));
    assert.deepEqual(keptTexts(folder), []);
    assert.equal(await server.end(), 0);
  });
});
