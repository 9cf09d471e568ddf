// What the tests of the page have in common: a scene, a page that shows it, and gestures.
import assert from 'node:assert/strict';
import {after, before, test} from 'node:test';
import {folderWith, openPage, startBrowser, startServer, whole} from './studio.mjs';

export const scene = `Settings {
    width -> 320 height -> 240 supersampling -> 2
    camera -> Camera { position -> vec3(0, 0, -4) pointing -> vec3(0, 0, 0) }
}
ball = Sphere { center -> vec3(-1, 0, 0) radius -> 0.7 }
red = Material { color -> rgb(0.8, 0.1, 0.1) }
Scene {
    ball
    Box { cornerA -> vec3(0.5, -0.5, -0.5) cornerB -> vec3(1.5, 0.5, 0.5) material -> red }
}
`;

let running;
before(async () => { running = await startBrowser(); });
after(() => running.close());

/** Returns the browser of all tests of a file. */
export const browser = () => running;

/** Runs a test with a server on a folder with the scene and a page that shows it, on a screen. */
export function withPage(name, body, ...how) {
  test(name, async () => {
    const {folder, remove} = folderWith({'a.crt': scene});
    const server = await startServer(folder, 'a.crt');
    const page = await openPage(running, server.url, ...how);
    try {
      await whole(page);
      await body({page, folder, server});
      assert.deepEqual(page.problems, []);
    } finally {
      await page.context().close();
      assert.equal(await server.end(), 0);
      remove();
    }
  });
}

export const shown = (page) => page.evaluate(() => studio.view.shown);
/** Returns what is the same for the same picture alone. */
export const shownBytes = (page) => page.evaluate(() => digest());

/** Waits until the picture is as is wanted. `waitForFunction` takes any promise for a yes. */
async function untilBytes(page, isWanted) {
  const end = Date.now() + 30_000;
  while (!isWanted(await shownBytes(page))) {
    assert.ok(Date.now() < end, 'the picture never is as it should be');
    await page.waitForTimeout(20);
  }
}

/** Waits until the picture is as it was. */
export const showsBytes = (page, bytes) => untilBytes(page, (shown) => shown === bytes);
/** Waits until the picture is another one. */
export const showsOther = (page, bytes) => untilBytes(page, (shown) => shown !== bytes);

/** Clicks the picture at a share of its sides. */
export async function clickPicture(page, x, y, options = {}) {
  const box = await page.locator('.live canvas').boundingBox();
  await page.mouse.click(box.x + x * box.width, box.y + y * box.height, options);
}

export async function dragPicture(page, dx, dy, key) {
  const box = await page.locator('.live canvas').boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  if (key) await page.keyboard.down(key);
  await page.mouse.down();
  for (let i = 1; i <= 10; ++i) await page.mouse.move(x + dx * i / 10, y + dy * i / 10);
  await page.mouse.up();
  if (key) await page.keyboard.up(key);
}

export const selectedText = (page) => page.evaluate(() => {
  const {from, to} = studio.editor.view.state.selection.main;
  return studio.editor.view.state.sliceDoc(from, to);
});
export const cameraOf = (page) => page.evaluate(() => studio.camera ?? studio.scene.camera);

/** Returns the bytes of the picture at a share of its sides. */
export const pixelAt = (page, x, y) => page.evaluate(([u, v]) => {
  const {canvas} = studio.view;
  const [column, row] = [Math.floor(u * canvas.width), Math.floor(v * canvas.height)];
  return [...canvas.getContext('2d').getImageData(column, row, 1, 1).data];
}, [x, y]);
