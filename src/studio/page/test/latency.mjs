// Measures how long a key stroke takes to its first new picture and to its diagnostics, and how many
// pictures a second orbiting shows, in Chromium. It prints medians.
import {readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {folderWith, openPage, project, startBrowser, startServer} from './studio.mjs';

const part = `Settings {
    width -> 640 height -> 480
    camera -> Camera { position -> vec3(0, 30, -45) pointing -> vec3(0, 0, 0) }
}
steel = Material { color -> rgb(0.6, 0.6, 0.65) }
solid = Box { cornerA -> vec3(-16.5, -1, -16.5) cornerB -> vec3(16.5, 1, 16.5) material -> steel }
for (i in range(0, 999)) {
    x = i % 32 - 15.5
    z = floor(i / 32) - 15.5
    solid = solid - Cylinder {
        from -> vec3(x, -2, z) to -> vec3(x, 2, z) radius -> 0.3 material -> steel }
}
Scene { solid }
`;

const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];

async function measure(browser, folder, script) {
  const server = await startServer(folder, script);
  const page = await openPage(browser, server.url);
  await page.waitForFunction(() => studio.timing.firstPicture > 0, null, {timeout: 60000});
  const strokes = [];
  for (let i = 0; i < 21; ++i) {
    await page.waitForTimeout(150);
    strokes.push(await page.evaluate(async () => {
      const {view} = studio.editor;
      const place = studio.editor.text.indexOf('width -> 640') + 'width -> 640'.length;
      view.dispatch({changes: {from: place, insert: ' '}, userEvent: 'input.type'});
      while (studio.timing.firstPicture === 0 || studio.timing.diagnostics === 0)
        await new Promise((resolve) => setTimeout(resolve, 1));
      const result = {...studio.timing};
      studio.timing.diagnostics = 0;
      return result;
    }));
  }
  const box = await page.locator('.live canvas').boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  const before = await page.evaluate(() => ({shown: studio.view.shown, at: performance.now()}));
  for (let i = 0; i < 300; ++i) {
    await page.mouse.move(box.x + box.width / 2 + 50 * Math.sin(i / 20), box.y + box.height / 2);
    await page.waitForTimeout(8);
  }
  const after = await page.evaluate(() => ({shown: studio.view.shown, at: performance.now()}));
  await page.mouse.up();
  await page.context().close();
  await server.end();
  console.log(script, {
    'ms to the first picture': median(strokes.slice(1).map((s) => s.firstPicture)),
    'ms to diagnostics': median(strokes.slice(1).map((s) => s.diagnostics)),
    'pictures a second in orbit': 1000 * (after.shown - before.shown) / (after.at - before.at)});
}

const browser = await startBrowser();
const {folder, remove} = folderWith({'part.crt': part});
const chess = readFileSync(join(project, 'examples/scenes/chess.crt'), 'utf8');
writeFileSync(join(folder, 'chess.crt'),
              chess.replace(/width -> \d+/, 'width -> 640').replace(/height -> \d+/, 'height -> 480'));
for (const script of ['chess.crt', 'part.crt']) await measure(browser, folder, script);
await browser.close();
remove();
