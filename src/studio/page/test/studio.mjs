// Starts the studio and a browser for the tests.
import {spawn} from 'node:child_process';
import {cpSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';
import {chromium} from 'playwright-core';

const here = dirname(fileURLToPath(import.meta.url));
export const project = join(here, '../../../..');
export const program = process.env.CRT_STUDIO ?? join(project, 'build/release/bin/crt-studio');
export const command = process.env.CRT_COMMAND ?? join(project, 'build/release/bin/crt');

/** Starts one browser for all tests of a file. */
export function startBrowser() {
  return chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--no-proxy-server', '--disable-gpu'],
  });
}

/** Makes a folder with scripts, which goes at the end. */
export function folderWith(scripts) {
  const folder = mkdtempSync(join(tmpdir(), 'crt-studio-'));
  for (const [name, text] of Object.entries(scripts)) writeFileSync(join(folder, name), text);
  return {folder, remove: () => rmSync(folder, {recursive: true, force: true})};
}

export function copyScene(folder, name) {
  cpSync(join(project, 'examples/scenes', name), join(folder, name));
}

/** The texts that the server keeps of pages which have not saved them. */
export function keptTexts(folder) {
  return readdirSync(folder).filter((name) => name.endsWith('.typed'))
    .map((name) => readFileSync(join(folder, name), 'utf8'));
}

/** Starts the server. `end` interrupts it and gives its exit code. */
export async function startServer(folder, script = '', port = 0, more = []) {
  const child = spawn(program, [`folder=${folder}`, `script=${script}`, `port=${port}`, ...more],
                      {stdio: ['ignore', 'pipe', 'inherit']});
  const ended = new Promise((resolve) => child.on('exit', (code, signal) => resolve(code ?? signal)));
  const url = await new Promise((resolve, reject) => {
    let output = '';
    child.stdout.on('data', (data) => {
      output += data;
      const found = /https?:\S+/.exec(output);
      if (found) resolve(found[0]);
    });
    child.on('exit', () => reject(new Error('the server ended')));
  });
  return {
    url, child,
    end: (signal = 'SIGINT') => {
      child.kill(signal);
      return ended;
    },
  };
}

/** Opens the page, as a tablet if it is touched. */
export async function openPage(browser, url, size = {width: 1280, height: 720}, isTouched = false) {
  const context = await browser.newContext(
    {viewport: size, hasTouch: isTouched, isMobile: isTouched});
  const page = await context.newPage();
  page.problems = [];
  await page.addInitScript(() => {
    window.digest = async () => {
      const {canvas} = studio.view;
      const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
      const hash = new Uint8Array(await crypto.subtle.digest('SHA-256', data));
      return `${canvas.width} ${canvas.height} ${hash.join(' ')}`;
    };
  });
  page.on('console', (message) => {
    // The tests read the picture, which the page never does.
    const isOfTest = message.text().startsWith('Canvas2D: Multiple readback');
    if (['error', 'warning'].includes(message.type()) && !isOfTest)
      page.problems.push(message.text());
  });
  page.on('pageerror', (error) => page.problems.push(String(error)));
  await page.goto(url);
  return page;
}

export const whole = (page) => page.waitForFunction(() => {
  const {studio} = window;
  return studio.view.lastKind === 'final' && studio.queue.title.textContent === 'Done' &&
    studio.timing.firstPicture > 0;
}, null, {timeout: 60000});

export const text = (page) => page.evaluate(() => studio.editor.text);

/** Replaces a piece of the script as if it were typed. */
export async function type(page, piece, replacement) {
  await page.evaluate(([from, length]) => {
    studio.editor.view.dispatch({selection: {anchor: from, head: from + length}});
    studio.editor.view.focus();
  }, [(await text(page)).indexOf(piece), piece.length]);
  await page.keyboard.insertText(replacement);
}

/** Does something that starts a render, and waits for its end. */
export async function rendered(page, action) {
  await page.evaluate(() => {
    studio.view.lastKind = '';
    studio.queue.title.textContent = '';
  });
  await action();
  await page.waitForFunction(() =>
    studio.view.lastKind !== '' && studio.queue.title.textContent === 'Done');
}
