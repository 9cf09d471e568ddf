// The page by HTTPS, from an address of the network.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import {test} from 'node:test';
import {browser} from './page.mjs';
import {folderWith, startServer, text, type, whole} from './studio.mjs';

const scene = `Settings { width -> 64 height -> 48 }
Scene { Sphere { center -> vec3(0, 0, 2) radius -> 0.7 } }
`;

test('by HTTPS the page renders what is typed, and saves it', async () => {
  const {folder, remove} = folderWith({'a.crt': scene});
  const [certificate, key] = ['cert.pem', 'key.pem'].map((name) => join(folder, name));
  execFileSync('openssl', ['req', '-x509', '-newkey', 'ec', '-pkeyopt',
                           'ec_paramgen_curve:prime256v1', '-nodes', '-keyout', key, '-out',
                           certificate, '-days', '2', '-subj', '/CN=localhost'],
               {stdio: 'ignore'});
  const server = await startServer(folder, 'a.crt', 0, [
    'listen=0.0.0.0', `tls-cert=${certificate}`, `tls-key=${key}`]);
  assert.match(server.url, /^https:/);
  // Nobody vouches for a certificate that a test has made.
  const context = await browser().newContext({ignoreHTTPSErrors: true});
  const page = await context.newPage();
  await page.goto(server.url);
  await whole(page);
  await type(page, '0.7', '0.6');
  await whole(page);
  await page.keyboard.press('Control+s');
  await page.getByText('Saved a.crt').waitFor();
  assert.equal(await text(page), scene.replace('0.7', '0.6'));
  assert.equal(readFileSync(join(folder, 'a.crt'), 'utf8'), scene.replace('0.7', '0.6'));
  await context.close();
  assert.equal(await server.end(), 0);
  remove();
});
