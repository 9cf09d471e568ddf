// A notebook shows a scene of Python in a frame. Without Debian's jupyter-notebook, or a
// library that it can load (CRT_LIBRARY), this is skipped.
import assert from 'node:assert/strict';
import {spawn, spawnSync} from 'node:child_process';
import {writeFileSync} from 'node:fs';
import {createServer} from 'node:net';
import {delimiter, dirname, join} from 'node:path';
import {test} from 'node:test';
import {browser} from './page.mjs';
import {folderWith, command, project} from './studio.mjs';

const cells = [
  `import crt
scene = crt.Scene([crt.Sphere((0, 0, 3), 1)], settings=crt.Settings(width=64, height=48))
view = crt.live(scene)
view`,
  `scene.entities[0] = crt.Sphere((50, 0, 3), 1)
view.show(scene)`,
];

/** Makes a notebook with cells of code. */
const notebookOf = (sources) => JSON.stringify({
  nbformat: 4,
  nbformat_minor: 4,
  metadata: {kernelspec: {name: 'python3', display_name: 'Python 3', language: 'python'}},
  cells: sources.map((source) =>
    ({cell_type: 'code', source, metadata: {}, outputs: [], execution_count: null})),
});

/** Returns a port that nobody listens at. */
const freePort = () => new Promise((resolve) => {
  const server = createServer().listen(0, '127.0.0.1', () => {
    const {port} = server.address();
    server.close(() => resolve(port));
  });
});

/** Starts the server of notebooks. It prints its address. */
async function startNotebooks(folder) {
  const child = spawn('jupyter-notebook', [
    '--no-browser', '--allow-root', `--port=${await freePort()}`, `--notebook-dir=${folder}`,
  ], {
    stdio: ['ignore', 'ignore', 'pipe'],
    env: {
      ...process.env,
      HOME: folder,
      PATH: `${dirname(command)}${delimiter}${process.env.PATH}`,
      PYTHONPATH: join(project, 'python'),
      PYTHONDONTWRITEBYTECODE: '1',
    },
  });
  const ended = new Promise((resolve) => child.on('exit', resolve));
  const address = await new Promise((resolve, reject) => {
    let output = '';
    child.stderr.on('data', (data) => {
      output += data;
      const found = /http:\/\/localhost:\d+\/\?token=[0-9a-f]+/.exec(output);
      if (found) resolve(new URL(found[0]));
    });
    child.on('exit', () => reject(new Error(output)));
  });
  return {address, end: () => (child.kill('SIGTERM'), ended)};
}

const hasNotebooks = process.env.CRT_LIBRARY !== undefined &&
  spawnSync('jupyter-notebook', ['--version']).status === 0;

test('a notebook shows a scene, and what becomes of it', {skip: !hasNotebooks}, async () => {
  const {folder, remove} = folderWith({'a.ipynb': notebookOf(cells)});
  const notebooks = await startNotebooks(folder);
  const page = await browser().newPage();
  try {
    const {origin, search} = notebooks.address;
    await page.goto(`${origin}/notebooks/a.ipynb${search}`);
    await page.waitForFunction(() => globalThis.Jupyter?.notebook?.kernel?.is_connected());
    const run = (cell) => page.evaluate((i) => Jupyter.notebook.execute_cells([i]), cell);
    await run(0);
    const frame = page.frameLocator('.output iframe');
    const canvas = frame.locator('.live canvas');
    await canvas.waitFor();
    const middle = () => canvas.evaluate((element) => {
      const place = [element.width / 2, element.height / 2];
      return [...element.getContext('2d').getImageData(...place, 1, 1).data];
    });
    const isWhite = ([red, , , alpha]) => alpha === 255 && red === 255;
    const until = async (condition) => {
      while (!condition(await middle())) await page.waitForTimeout(100);
    };
    await until((color) => color[3] === 255 && !isWhite(color));
    const {height} = await canvas.boundingBox();
    assert.ok(height > 300, `the picture is ${height} pixels high`);
    await run(1);
    await until(isWhite);
  } finally {
    await page.close();
    await notebooks.end();
    remove();
  }
});
