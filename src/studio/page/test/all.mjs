// All tests of the page, in one process and so in one browser of page.mjs.
import {readdirSync} from 'node:fs';

for (const name of readdirSync(new URL('.', import.meta.url)).sort())
  if (name.endsWith('.test.mjs')) await import(`./${name}`);
