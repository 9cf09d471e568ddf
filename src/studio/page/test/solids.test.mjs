// How much what is selected is, how far places are apart, and files of triangles.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {clickPicture, withPage} from './page.mjs';

const ball = [0.29, 0.5];
const box = [0.75, 0.5];

const measures = (page) => page.getByRole('region', {name: 'Measures'});

withPage('what is selected has its measures below its properties', async ({page}) => {
  await clickPicture(page, ...box);
  await measures(page).getByText('1 m³').waitFor();
  await measures(page).getByText('6 m²').waitFor();
  await measures(page).getByText('1 × 1 × 1 m').waitFor();
  // No material says a density: water.
  await measures(page).getByText('1000 kg', {exact: true}).waitFor();
  await page.getByLabel('Density').fill('7850');
  await measures(page).getByText('7850 kg', {exact: true}).waitFor();
  await clickPicture(page, ...ball);
  await measures(page).getByText(/^1\.436/).waitFor();
  // A material has none.
  await page.locator('.tree .row', {hasText: 'red'}).first().click();
  await measures(page).waitFor({state: 'hidden'});
});

withPage('two clicks measure how far places are apart', async ({page}) => {
  const selected = await page.evaluate(() => studio.sheet.node?.name);
  await page.getByRole('button', {name: 'Measure', exact: true}).click();
  await clickPicture(page, 0.65, 0.45);
  await page.locator('.controls output', {hasText: 'Click the other place.'}).waitFor();
  await clickPicture(page, 0.65, 0.55);
  const text = page.locator('.overlay .ruler-text');
  await page.locator('.controls output', {hasText: /^Distance: / }).waitFor();
  const distance = Number(/^([0-9.]+) m$/.exec(await text.textContent())[1]);
  const places = await page.evaluate(() => studio.view.overlay.measured);
  const [a, b] = places;
  assert.ok(Math.abs(distance - Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2])) < 1e-5);
  assert.ok(distance > 0.1);
  assert.match(await page.locator('.overlay .ruler').getAttribute('d'), /L/);
  assert.equal(await page.evaluate(() => studio.sheet.node?.name), selected);
  await page.getByRole('button', {name: 'Measure', exact: true}).click();
  assert.equal(await page.locator('.overlay .ruler').getAttribute('d'), '');
  await clickPicture(page, ...box);
  await page.waitForFunction(() => studio.sheet.node?.name === 'Box');
});

withPage('solids are saved as triangles', async ({page}) => {
  const list = page.getByLabel('Save as triangles');
  await page.getByLabel('Deviation of triangles').fill('0.05');
  const [stl] = await Promise.all([page.waitForEvent('download'), list.selectOption('scene stl')]);
  assert.equal(stl.suggestedFilename(), 'a.stl');
  const content = readFileSync(await stl.path());
  assert.equal(content.length, 84 + 50 * content.readUInt32LE(80));
  await page.locator('.console .line', {hasText: 'The triangles are saved.'}).waitFor();
  await clickPicture(page, ...box);
  await page.waitForFunction(() => studio.sheet.node?.name === 'Box');
  const [glb] = await Promise.all([page.waitForEvent('download'),
                                   list.selectOption('entity glb')]);
  assert.equal(glb.suggestedFilename(), 'a.glb');
  assert.equal(readFileSync(await glb.path()).toString('latin1', 0, 4), 'glTF');
});
