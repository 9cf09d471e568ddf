// Takes the pictures of docs/studio.md.
import {join} from 'node:path';
import {copyScene, folderWith, openPage, project, rendered, startBrowser, startServer, type,
        whole} from './studio.mjs';

const {folder, remove} = folderWith({});
copyScene(folder, 'csg.crt');
const server = await startServer(folder, 'csg.crt');
const browser = await startBrowser();
const page = await openPage(browser, server.url);
await whole(page);
await page.evaluate(() => studio.layout.applyTheme('dark'));
await page.locator('.tree .row', {hasText: 'Material'}).first().click();
await page.locator('.dv-tab', {hasText: 'Queue'}).click();
await page.mouse.move(0, 0);
await page.screenshot({path: join(project, 'docs/studio/overview.png')});

// A section, with the boxes of what it cuts.
await page.getByLabel('Bounds').check();
await page.getByLabel('Cutters').check();
await rendered(page, () => page.getByLabel('Section across').selectOption('2'));
await rendered(page, () => page.getByLabel('Place of the section', {exact: true}).fill('0'));
await page.locator('.tree .row', {hasText: 'Camera'}).first().click();
await page.screenshot({path: join(project, 'docs/studio/section.png')});
await rendered(page, () => page.getByLabel('Section across').selectOption(''));
await page.getByLabel('Bounds').uncheck();
await page.getByLabel('Cutters').uncheck();

// The queue after a render by passes.
await rendered(page, () => type(page, 'supersampling -> 4', 'timebudget -> 3 maxsamples -> 65536'));
await page.locator('.trade').waitFor();
await page.locator('.queue .machine', {hasText: 'GiB'}).waitFor();
await page.screenshot({path: join(project, 'docs/studio/queue.png')});

// Other channels than the picture.
for (const channel of ['depth', 'id']) {
  await rendered(page, () => page.getByLabel('Channel').selectOption(channel));
  await page.locator('.live canvas').screenshot({path: join(project, `docs/studio/${channel}.png`)});
}
await rendered(page, () => page.getByLabel('Channel').selectOption('color'));

await page.evaluate(() => studio.layout.applyTheme('light'));
await page.evaluate(() => {
  const place = studio.editor.text.indexOf('Plane {');
  studio.editor.view.dispatch({
    changes: {from: place, insert: 'Sphere {  }\n    '}, selection: {anchor: place + 9}, scrollIntoView: true});
  studio.editor.view.focus();
});
await page.waitForFunction(() => document.getElementById('status').className === 'error');
await page.keyboard.press('Control+Space');
await page.locator('.cm-tooltip-autocomplete').waitFor();
await page.screenshot({path: join(project, 'docs/studio/completion.png')});
await browser.close();
await server.end();
remove();
