// Principled and derived materials, and lights with a size, in the tree and the property sheet.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {browser, shownBytes} from './page.mjs';
import {folderWith, openPage, rendered, startServer, text, whole} from './studio.mjs';

const script = `import "crt/materials"
Settings {
    width -> 160 height -> 120
    camera -> Camera { position -> vec3(0, 0, -6) pointing -> vec3(0, 0, 0) }
    lights -> [SphereLight { center -> vec3(0, 4, -3) radius -> 0.5 color -> rgb(20, 10, 5) }]
}
brass = PrincipledMaterial { color -> rgb(0.9, 0.8, 0.4) metallic -> 1 roughness -> 0.2 }
dull = brass { roughness -> 0.6 }
Scene {
    Sphere { center -> vec3(-1.2, 0, 0) radius -> 1 material -> dull }
    Sphere { center -> vec3(1.2, 0, 0) radius -> 1 material -> ruby }
}
`;

/** Runs a test with a page that shows the script. */
function withMaterials(name, body) {
  test(name, async () => {
    const {folder, remove} = folderWith({'a.crt': script});
    const server = await startServer(folder, 'a.crt');
    const page = await openPage(browser(), server.url);
    try {
      await whole(page);
      await body(page);
      assert.deepEqual(page.problems, []);
    } finally {
      await page.context().close();
      assert.equal(await server.end(), 0);
      remove();
    }
  });
}

const rowOf = (page, title, index = 0) =>
  page.locator('.tree .row', {has: page.locator(`.title:text-is("${title}")`)}).nth(index);
const propertyOf = (page, name) =>
  page.locator('.property', {has: page.locator(`label:text-is("${name}")`)});
/** Waits for a ball that is not the one of an address. */
async function ballBeside(page, before = '') {
  await page.locator('.sheet .ball').waitFor();
  await page.waitForFunction((old) => studio.sheet.ball.src !== old, before);
  return page.locator('.sheet .ball').getAttribute('src');
}

withMaterials('a principled material has sliders, and a ball that follows them', async (page) => {
  await rowOf(page, 'PrincipledMaterial').click();
  const ball = await ballBeside(page);
  await rendered(page, () => page.getByLabel('roughness as a slider').fill('0.05'));
  assert.equal(await text(page), script.replace('roughness -> 0.2', 'roughness -> 0.05'));
  const polished = await ballBeside(page, ball);
  await propertyOf(page, 'coat').locator('button.default').click();
  await page.getByLabel('coat as a slider').fill('1');
  assert.match(await text(page), /roughness -> 0\.05 coat -> 1 }/);
  await ballBeside(page, polished);
  for (const name of ['transmission', 'coatroughness', 'sheen', 'refractiveindex']) {
    await propertyOf(page, name).locator('button.default').click();
    await page.getByLabel(`${name} as a slider`).waitFor();
  }
});

withMaterials('a derived material shows what it inherits, and writes what it has by itself',
              async (page) => {
  await rowOf(page, 'brass { }').click();
  const ball = await ballBeside(page);
  await page.locator('.sheet h2', {hasText: 'PrincipledMaterial, a copy of brass'}).waitFor();
  assert.deepEqual(await page.locator('.property.inherited label').allTextContents(),
                   ['color', 'metallic']);
  assert.equal(await page.getByLabel('metallic', {exact: true}).inputValue(), '1');
  assert.equal(await page.getByLabel('roughness', {exact: true}).inputValue(), '0.6');
  // A drag over the slider gives many values, of which each takes the place of the one before.
  const slider = page.getByLabel('metallic as a slider');
  await slider.focus();
  for (const value of ['0.9', '0.7', '0.5']) await slider.fill(value);
  const overridden = script.replace('brass { roughness -> 0.6 }',
                                    'brass { roughness -> 0.6 metallic -> 0.5 }');
  assert.equal(await text(page), overridden);
  await ballBeside(page, ball);
  // The tree that comes then has it as an attribute of its own.
  await page.waitForFunction(() =>
    studio.sheet.node.attributes.length === 2 && studio.sheet.node.inherited.length === 1);
  await slider.fill('0.3');
  assert.equal(await text(page), overridden.replace('0.5 }\n', '0.3 }\n'));
  await rowOf(page, 'Scene').click();
  await rowOf(page, 'brass { }').click();
  assert.deepEqual(await page.locator('.property.inherited label').allTextContents(), ['color']);
  await page.getByLabel('color as a colour').fill('#ff0000');
  assert.match(await text(page), /metallic -> 0\.3 color -> rgb\(1, 0, 0\) }/);
});

withMaterials('a material of the library has a ball where it is used, and can be derived from',
              async (page) => {
  await rowOf(page, 'Sphere', 1).click();
  const ball = await ballBeside(page);
  await rendered(page, () => page.evaluate(() => {
    const place = studio.editor.text.indexOf('ruby') + 4;
    studio.editor.view.dispatch({changes: {from: place, insert: ' { roughness -> 0.4 }'},
                                 selection: {anchor: place + 4}});
  }));
  await page.locator('.sheet h2', {hasText: 'PrincipledMaterial, a copy of ruby'}).waitFor();
  await ballBeside(page, ball);
  const inherited = await page.locator('.property.inherited label').allTextContents();
  assert.deepEqual(inherited,
                   ['color', 'refractiveindex', 'transmission', 'absorption', 'density']);
});

withMaterials('the braces of a derived material complete its attributes', async (page) => {
  await page.evaluate(() => {
    const place = studio.editor.text.indexOf('-> ruby') + 7;
    studio.editor.view.dispatch({changes: {from: place, insert: ' {  }'},
                                 selection: {anchor: place + 3}});
    studio.editor.view.focus();
  });
  await page.keyboard.type('rough');
  await page.locator('.cm-tooltip-autocomplete li', {hasText: 'roughness'}).first().waitFor();
  await page.waitForTimeout(100);  // CodeMirror takes no choice just after the list comes
  await page.keyboard.press('Enter');
  assert.match(await text(page), /material -> ruby { roughness ->  }/);
});

withMaterials('a light with a size has its radius and its colour, which stays as bright',
              async (page) => {
  await rowOf(page, 'SphereLight').click();
  const before = await shownBytes(page);
  await rendered(page, () => page.getByLabel('radius as a slider').fill('1.5'));
  assert.match(await text(page), /radius -> 1\.5 color -> rgb\(20, 10, 5\)/);
  assert.notEqual(await shownBytes(page), before);
  const picker = page.getByLabel('color as a colour');
  assert.equal(await picker.inputValue(), '#ff8040');
  await picker.fill('#00ff00');
  assert.match(await text(page), /color -> rgb\(0, 20, 0\)/);
  await propertyOf(page, 'visible').locator('button.default').click();
  await page.getByLabel('visible', {exact: true}).setChecked(false);
  assert.match(await text(page), /visible -> false }\]/);
});
