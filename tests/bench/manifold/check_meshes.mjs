// This program asks Manifold whether meshes are solids: check_meshes.mjs FOLDER < MESHES > RESULTS
// FOLDER is where manifold-3d is installed. Each line of MESHES is one in JSON:
//   {"positions": [x, y, z, ...], "indices": [...]}
// RESULTS has a line for each: what Manifold says of it, its volume, area and genus.

import {createInterface} from 'node:readline';
import {resolve} from 'node:path';
import {pathToFileURL} from 'node:url';

const place = resolve(process.argv[2], 'node_modules/manifold-3d/manifold.js');
const wasm = await (await import(pathToFileURL(place))).default();
wasm.setup();

for await (const line of createInterface({input: process.stdin})) {
  const {positions, indices} = JSON.parse(line);
  let answer = {status: 'refused', volume: 0, area: 0, genus: 0};
  try {
    const solid = wasm.Manifold.ofMesh(new wasm.Mesh({
      numProp: 3,
      vertProperties: Float32Array.from(positions),
      triVerts: Uint32Array.from(indices),
    }));
    answer = {
      status: String(solid.status()),
      volume: solid.volume(),
      area: solid.surfaceArea(),
      genus: solid.genus(),
    };
    solid.delete();
  } catch (error) {
    answer.status = String(error.message ?? error);
  }
  console.log(JSON.stringify(answer));
}
