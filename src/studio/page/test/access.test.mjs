// The page for those who use it by keyboard, by a screen reader, or by fingers.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {scene, withPage} from './page.mjs';
import {rendered, text, type} from './studio.mjs';

const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

/** Returns what axe finds serious, or cannot decide. Contrasts have a test of their own. */
async function complaints(page) {
  if (!await page.evaluate(() => 'axe' in window)) await page.evaluate(axe);
  return page.evaluate(async () => {
    // In the editor axe does not know what is in front of what.
    const {violations, incomplete} = await axe.run(document, {
      rules: {'color-contrast': {enabled: false}}});
    return [...violations, ...incomplete]
      .filter(({impact}) => ['serious', 'critical'].includes(impact))
      .flatMap(({id, nodes}) => nodes.map((node) =>
        `${id}: ${node.failureSummary} ${node.html.slice(0, 120)}`));
  });
}

withPage('axe has no serious objection to any panel in either theme', async ({page}) => {
  // What only some scripts have: time, prints, hidden entities, a section, a kept picture.
  await rendered(page, () => type(page, 'radius -> 0.7', 'radius -> 0.7 + t / 100'));
  await rendered(page, () => type(page, 'ball = ', 'print("a ball")  -- and a comment\nball = '));
  await page.getByRole('button', {name: 'Compare'}).click();
  await rendered(page, () => page.getByLabel('Section across').selectOption('0'));
  const row = page.locator('.tree .row.kind-name', {hasText: 'ball'});
  await row.hover();
  await rendered(page, () => row.locator('.eye').click());
  for (const theme of ['dark', 'light']) {
    await page.evaluate((name) => studio.layout.applyTheme(name), theme);
    for (const node of ['Sphere', 'Material', 'Camera', 'Settings']) {
      await page.locator('.tree .row', {hasText: node}).first().click();
      assert.deepEqual(await complaints(page), [], `${theme} ${node}`);
    }
    for (const tab of ['Queue', 'Statistics', 'Console']) {
      await page.getByRole('tab', {name: tab}).click();
      assert.deepEqual(await complaints(page), [], `${theme} ${tab}`);
    }
  }
  // A script with an error, its list of completions, and a question.
  await type(page, 'Scene {', 'Scene { Sphere {  } ');
  await page.locator('#status.error').waitFor();
  await page.evaluate(() => {
    const place = studio.editor.text.indexOf('Sphere {  }') + 9;
    studio.editor.view.dispatch({selection: {anchor: place}});
  });
  await page.keyboard.press('Control+Space');
  await page.locator('.cm-tooltip-autocomplete').waitFor();
  await page.evaluate(() => studio.file.offer('a.crt', ''));
  for (const theme of ['light', 'dark']) {
    await page.evaluate((name) => studio.layout.applyTheme(name), theme);
    assert.deepEqual(await complaints(page), [], `${theme}, with an error`);
  }
});

withPage('texts of both themes have the contrast of WCAG AA', async ({page}) => {
  for (const theme of ['dark', 'light']) {
    await page.evaluate((name) => studio.layout.applyTheme(name), theme);
    const weak = await page.evaluate(() => {
      const style = getComputedStyle(document.documentElement);
      const luminance = (name) => {
        const hex = style.getPropertyValue(name).trim();
        const [r, g, b] = [1, 3, 5].map((i) => {
          const c = parseInt(hex.slice(i, i + 2), 16) / 255;
          return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
        });
        return 0.2126 * r + 0.7152 * g + 0.0722 * b;
      };
      const contrast = (a, b) => {
        const [low, high] = [luminance(a), luminance(b)].sort((x, y) => x - y);
        return (high + 0.05) / (low + 0.05);
      };
      const texts = ['text', 'dim', 'accent', 'error', 'warning', 'token-comment', 'token-string',
                     'token-number', 'token-keyword', 'token-object', 'token-attribute',
                     'token-parameter', 'token-function'];
      const pairs = texts.flatMap((text) =>
        ['page', 'panel', 'editor', 'line'].map((ground) => [text, ground]));
      pairs.push(['accent-text', 'accent-fill'], ['text', 'selection']);
      return pairs.filter(([a, b]) => contrast(`--${a}`, `--${b}`) < 4.5).map((p) => p.join(' on '));
    });
    assert.deepEqual(weak, [], theme);
  }
});

/** Returns what has the keyboard: its role or element, and its name. */
const focused = (page) => page.evaluate(() => {
  let element = document.activeElement;
  while (element.shadowRoot?.activeElement) element = element.shadowRoot.activeElement;
  const role = element.getAttribute('role') ?? element.localName;
  return `${role} ${element.getAttribute('aria-label') ?? element.textContent.trim()}`;
});

withPage('the keyboard reaches everything, in the order in which it is seen', async ({page}) => {
  await page.locator('.tree .row', {hasText: 'Sphere'}).click();
  await page.getByLabel('Script to open').focus();
  const reached = [await focused(page)];
  for (;;) {
    // In the script Tab indents until Escape.
    if (reached.at(-1) === 'textbox Script') await page.keyboard.press('Escape');
    await page.keyboard.press('Tab');
    const next = await focused(page);
    if (next.startsWith('body') || next === reached[0]) break;
    reached.push(next);
    assert.ok(reached.length < 100, reached.join('\n'));
  }
  assert.deepEqual(reached.map((name) => name.replace(/ {2,}/g, ' ')), [
    'select Script to open', 'button Save', 'button Format', 'select Insert into the script',
    'button Camera to script', 'button Reset view', 'button PNG', 'button EXR',
    'select Save as triangles', 'input Deviation of triangles',
    'select Copy as source code', 'select Show a panel', 'button Theme',
    'tab Script', 'textbox Script',
    'tab Live view',
    'application Picture: drag or arrow keys turn, shift moves, wheel or plus and minus go nearer',
    'select Mode', 'select Channel', 'input Bounds', 'input Cutters', 'select Section across',
    'button Compare', 'button Region', 'button Measure',
    'input Exposure', 'input Exposure in stops', 'select Tone map', 'input Denoise',
    'tab Console', 'log Console',
    'tab Scene', 'tree Scene',
    'tab Properties', 'input center x', 'input center y', 'input center z',
    'input radius', 'summary About radius', 'button true', 'summary About shadow',
    'button true', 'summary About visible']);
  assert.equal(await text(page), scene);
});

withPage('tabs, tree and time are worked by keys', async ({page}) => {
  const tab = (name) => page.getByRole('tab', {name});
  await tab('Console').focus();
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('Enter');
  await page.locator('.queue progress').waitFor();
  assert.equal(await tab('Queue').getAttribute('aria-selected'), 'true');
  assert.equal(await tab('Console').getAttribute('aria-selected'), 'false');
  await tab('Queue').focus();
  await page.keyboard.press('Delete');
  assert.equal(await tab('Queue').count(), 0);

  const tree = page.getByRole('tree');
  await tree.focus();
  await page.keyboard.press('Home');
  const chosen = () => page.evaluate(() => document.getElementById(
    document.querySelector('.tree').getAttribute('aria-activedescendant')).textContent);
  assert.match(await chosen(), /Settings/);
  await page.keyboard.press('ArrowDown');
  assert.match(await chosen(), /Camera/);
  await page.keyboard.press('ArrowLeft');
  assert.match(await chosen(), /Settings/);
  await page.keyboard.press('ArrowLeft');
  assert.equal(await page.locator('.tree .row', {hasText: 'Camera'}).isVisible(), false);
  await page.keyboard.press('End');
  assert.match(await chosen(), /Box/);
  await rendered(page, () => page.keyboard.press('h'));
  await page.getByRole('button', {name: 'Show all'}).waitFor();
});

/** Lists what can be pressed and is smaller than a finger or a mouse wants it. */
const tooSmall = (page, least) => page.evaluate((pixels) => {
  const seen = [...document.querySelectorAll('button, select, input, summary, .dv-tab, .tree .row')]
    .map((element) => element.type === 'checkbox' ? element.closest('label') ?? element : element)
    .map((element) => ({element, box: element.getBoundingClientRect()}))
    .filter(({box}) => box.width > 0 && box.height > 0);
  return seen.filter(({box}) => box.height < pixels - 0.5 || box.width < Math.min(pixels, 28) - 0.5)
    .map(({element, box}) =>
      `${element.getAttribute('aria-label') ?? element.textContent}: ${box.width} x ${box.height}`);
}, least);

withPage('what can be pressed is large enough for a mouse', async ({page}) => {
  for (const node of ['Sphere', 'Material', 'Camera']) {
    await page.locator('.tree .row', {hasText: node}).first().click();
    assert.deepEqual(await tooSmall(page, 24), []);
  }
});

withPage('a tablet has large targets, panels for each way it is held, and gestures',
         async ({page}) => {
  const boxOf = (name) => page.locator(`.${name}`).boundingBox();
  const upright = await boxOf('live');
  assert.ok(upright.width > 800 && upright.height > 450, JSON.stringify(upright));
  assert.ok((await boxOf('editor')).y > upright.y + upright.height - 1);
  await page.getByRole('tab', {name: 'Scene'}).tap();
  await page.locator('.tree .row', {hasText: 'Camera'}).tap();
  assert.deepEqual(await tooSmall(page, 40), []);
  await page.getByRole('tab', {name: 'Properties'}).tap();
  await page.getByLabel('position x').waitFor();
  assert.deepEqual(await tooSmall(page, 40), []);

  // A region is chosen by a button and a finger. Escape takes that back.
  const region = page.getByRole('button', {name: 'Region'});
  await region.tap();
  assert.equal(await region.getAttribute('aria-pressed'), 'true');
  await page.locator('.live canvas').press('Escape');
  assert.equal(await region.getAttribute('aria-pressed'), 'false');
  await region.tap();
  const {x, y, width, height} = await page.locator('.live canvas').boundingBox();
  const touch = await page.context().newCDPSession(page);
  const send = (kind, points) => touch.send('Input.dispatchTouchEvent', {
    type: kind, touchPoints: points.map(([u, v], id) => ({x: x + u * width, y: y + v * height, id}))});
  await send('touchStart', [[0.1, 0.2]]);
  await send('touchMove', [[0.3, 0.6]]);
  await rendered(page, () => send('touchEnd', []));
  assert.ok(await page.evaluate(() => studio.viewState.options.region.width > 20));
  await rendered(page, () => page.getByRole('button', {name: 'Whole picture'}).click());

  // Two fingers that come together go away from what is looked at.
  await send('touchStart', [[0.2, 0.5], [0.8, 0.5]]);
  await send('touchMove', [[0.3, 0.5], [0.7, 0.5]]);
  await send('touchMove', [[0.4, 0.5], [0.6, 0.5]]);
  await rendered(page, () => send('touchEnd', []));
  const distance = await page.evaluate(() => Math.hypot(...studio.camera.position.map((p, i) =>
    p - studio.camera.pointing[i])));
  assert.ok(distance > 5, String(distance));

  await page.setViewportSize({width: 1180, height: 820});
  await page.locator('.tree').waitFor();
  await page.waitForFunction((least) => document.querySelector('.live').clientHeight > least, 400);
  assert.ok((await boxOf('editor')).x + 1 < (await boxOf('live')).x);
  assert.ok((await boxOf('live')).width > 450, JSON.stringify(await boxOf('live')));
  assert.deepEqual(await tooSmall(page, 40), []);
}, {width: 820, height: 1180}, true);
