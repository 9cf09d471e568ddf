// This program computes booleans of meshes by Manifold: booleans.mjs FOLDER < BOOLEANS > RESULTS
// FOLDER is where manifold-3d is installed. Each line of BOOLEANS is a boolean in JSON:
//   {"meshes": [{"positions": [x, y, z, ...], "indices": [...]}, ...], "operations": [...]}
// The first operation joins the first two meshes, the next one joins the third to them, and so on.
// RESULTS has a line for each: what Manifold says of the result, its mesh, and how long both took.

import {createInterface} from 'node:readline';
import {performance} from 'node:perf_hooks';
import {resolve} from 'node:path';
import {pathToFileURL} from 'node:url';

const ROUNDS = 3; // of which the fastest counts
const METHODS = {union: 'add', difference: 'subtract', intersection: 'intersect'};

const place = resolve(process.argv[2], 'node_modules/manifold-3d/manifold.js');
const wasm = await (await import(pathToFileURL(place))).default();
wasm.setup();

// Returns the result of a function, and how many milliseconds it took.
function timed(work) {
  const start = performance.now();
  const result = work();
  return [result, performance.now() - start];
}

function solids(meshes) {
  return meshes.map(({positions, indices}) => wasm.Manifold.ofMesh(new wasm.Mesh({
    numProp: 3,
    vertProperties: Float32Array.from(positions),
    triVerts: Uint32Array.from(indices),
  })));
}

// Returns what is left of the solids, and all that was made on the way. Manifold computes no
// boolean before it is asked what came out.
function combined(parts, operations) {
  const made = [parts[0]];
  operations.forEach((name, i) => made.push(made.at(-1)[METHODS[name]](parts[i + 1])));
  const result = made.at(-1);
  result.numTri();
  return {result, made: made.slice(1)};
}

function answer({meshes, operations}) {
  let making = Infinity, combining = Infinity, last;
  for (let round = 0; round < ROUNDS; ++round) {
    const [parts, madeIn] = timed(() => {
      const made = solids(meshes);
      made.forEach(part => part.numTri());
      return made;
    });
    const [{result, made}, combinedIn] = timed(() => combined(parts, operations));
    making = Math.min(making, madeIn);
    combining = Math.min(combining, combinedIn);
    if (round == ROUNDS - 1) {
      const mesh = result.getMesh();
      last = {
        status: String(result.status()),
        broken: parts.map(part => String(part.status())).filter(status => status != 'NoError'),
        volume: result.volume(),
        area: result.surfaceArea(),
        tolerance: result.tolerance(),
        positions: Array.from(mesh.vertProperties),
        indices: Array.from(mesh.triVerts),
      };
    }
    for (const solid of [...made, ...parts]) solid.delete();
  }
  return {...last, making, combining};
}

for await (const line of createInterface({input: process.stdin})) {
  process.stdout.write(JSON.stringify(answer(JSON.parse(line))) + '\n');
}
