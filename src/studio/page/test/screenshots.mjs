// Takes the pictures of docs/studio.md.
import {join} from 'node:path';
import {copyScene, folderWith, openPage, project, startBrowser, startServer, whole}
  from './studio.mjs';

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
