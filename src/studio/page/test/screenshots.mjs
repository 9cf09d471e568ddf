// Takes the pictures of docs/studio.md.
import {join} from 'node:path';
import {copyScene, folderWith, openPage, project, rendered, startBrowser, startServer, type,
        whole} from './studio.mjs';

const browser = await startBrowser();
const file = (name) => ({path: join(project, `docs/studio/${name}.png`)});

/** Opens a script in a theme, and lets pictures be taken of it. */
async function withScript(script, theme, take, ...how) {
  const {folder, remove} = folderWith({});
  copyScene(folder, script);
  const server = await startServer(folder, script);
  const page = await openPage(browser, server.url, ...how);
  await whole(page);
  await page.evaluate((name) => studio.layout.applyTheme(name), theme);
  await take(page);
  await page.context().close();
  await server.end();
  remove();
}

const show = (page, tab) => page.getByRole('tab', {name: tab}).click();
const select = (page, node) => page.locator('.tree .row', {hasText: node}).first().click();
/** Takes a picture of a panel with its tabs. */
const shootPanel = (page, name, panel) =>
  page.locator('.dv-groupview', {has: page.locator(panel)}).screenshot(file(name));

await withScript('csg.crt', 'dark', async (page) => {
  await select(page, 'Material');
  await page.locator('.sheet .ball').waitFor();
  await show(page, 'Queue');
  await page.locator('.queue .machine', {hasText: 'GiB'}).waitFor();
  await page.mouse.move(0, 0);
  await page.screenshot(file('overview'));

  // A section, with the boxes of what it cuts.
  await page.getByLabel('Bounds').check();
  await page.getByLabel('Cutters').check();
  await rendered(page, () => page.getByLabel('Section across').selectOption('2'));
  await rendered(page, () => page.getByLabel('Place of the section', {exact: true}).fill('0'));
  await select(page, 'Camera');
  await shootPanel(page, 'section', '.live');
  await rendered(page, () => page.getByLabel('Section across').selectOption(''));
  await page.getByLabel('Bounds').uncheck();
  await page.getByLabel('Cutters').uncheck();

  // Other channels than the picture.
  for (const channel of ['depth', 'id']) {
    await rendered(page, () => page.getByLabel('Channel').selectOption(channel));
    await page.locator('.live canvas').screenshot(file(channel));
  }
  await rendered(page, () => page.getByLabel('Channel').selectOption('color'));

  // A picture beside the one before.
  await page.getByRole('button', {name: 'Compare'}).click();
  await rendered(page, () => type(page, 'rgb(0.85, 0.28, 0.03)', 'rgb(0.15, 0.6, 0.2)'));
  await shootPanel(page, 'comparison', '.live');
  await page.getByRole('button', {name: 'End', exact: true}).click();

  // The queue and the numbers after a render by passes.
  await rendered(page, () =>
    type(page, 'supersampling -> 4', 'timebudget -> 8 maxsamples -> 65536'));
  await page.locator('.trade').waitFor();
  await page.locator('.queue .machine', {hasText: 'GiB'}).waitFor();
  await page.evaluate(() => studio.layout.dock.getPanel('queue').group.api.setSize({height: 240}));
  await shootPanel(page, 'queue', '.queue');
  await show(page, 'Statistics');
  await page.evaluate(() =>
    studio.layout.dock.getPanel('statistics').group.api.setSize({height: 320}));
  await shootPanel(page, 'statistics', '.statistics');

  await show(page, 'Console');
  await page.evaluate(() => studio.layout.dock.getPanel('console').group.api.setSize({height: 150}));
  await rendered(page, () => type(page, 'cube = Box', 'edge = 1.25\n' +
    'print("The edges are at", edge, "and a corner at", vec3(edge, edge, edge))\ncube = Box'));
  await page.getByRole('button', {name: 'Camera to script'}).click();
  await page.locator('.console .print').waitFor();
  await shootPanel(page, 'console', '.console');
});

await withScript('room.crt', 'dark', async (page) => {
  for (const mode of ['material', 'clay']) {
    await rendered(page, () => page.getByLabel('Mode', {exact: true}).selectOption(mode));
    await shootPanel(page, `mode_${mode}`, '.live');
  }
});

await withScript('animation.crt', 'dark', async (page) => {
  await page.getByLabel('Last frame').fill('23');
  await rendered(page, () => page.getByLabel('Frame t', {exact: true}).fill('5'));
  await page.evaluate(() => document.activeElement.blur());
  await shootPanel(page, 'time', '.live');
});

await withScript('csg.crt', 'light', async (page) => {
  await select(page, 'Camera');
  await page.mouse.move(0, 0);
  await page.screenshot(file('light'));
  await page.evaluate(() => {
    const place = studio.editor.text.indexOf('Plane {');
    studio.editor.view.dispatch({changes: {from: place, insert: 'Sphere {  }\n    '},
                                 selection: {anchor: place + 9}, scrollIntoView: true});
    studio.editor.view.focus();
  });
  await page.locator('#status.error').waitFor();
  await page.keyboard.press('Control+Space');
  await page.locator('.cm-tooltip-autocomplete').waitFor();
  await page.screenshot(file('completion'));
});

const upright = {width: 820, height: 1180};
await withScript('animation.crt', 'light', async (page) => {
  await show(page, 'Scene');
  await page.screenshot(file('tablet_upright'));
  await page.setViewportSize({width: upright.height, height: upright.width});
  await page.waitForFunction(() => studio.layout.room === 'wide');
  await select(page, 'Camera');
  await page.getByLabel('position x').waitFor();
  await page.screenshot(file('tablet_across'));
}, upright, true);

await browser.close();
