// This program measures solids by Manifold: measures.mjs FOLDER < QUESTIONS > ANSWERS
// FOLDER is where manifold-3d is installed. Each line of QUESTIONS is one in JSON:
//   {"solids": [{"joined": [SHAPE, ...], "cut": [SHAPE, ...]}, ...], "search": LENGTH, "rounds": N}
// A SHAPE has a matrix, column after column, and is a "cube" from 0 to 1, a "sphere" of radius 1
// with `sides`, or a "turned" `profile`. ANSWERS has a line for each: the volume of one solid, or
// how near two are within a length, the triangles, and the seconds of the fastest round.

import {createInterface} from 'node:readline';
import {performance} from 'node:perf_hooks';
import {resolve} from 'node:path';
import {pathToFileURL} from 'node:url';

const place = resolve(process.argv[2], 'node_modules/manifold-3d/manifold.js');
const wasm = await (await import(pathToFileURL(place))).default();
wasm.setup();

const makers = {
  cube: () => wasm.Manifold.cube([1, 1, 1]),
  sphere: ({sides}) => wasm.Manifold.sphere(1, sides),
  turned: ({profile, sides}) => wasm.Manifold.revolve([profile], sides),
};

function joined(shapes, made) {
  const parts = shapes.map(shape => {
    const plain = makers[shape.kind](shape);
    made.push(plain, plain.transform(shape.matrix));
    return made.at(-1);
  });
  made.push(wasm.Manifold.union(parts));
  return made.at(-1);
}

function solid({joined: shapes, cut}, made) {
  const whole = joined(shapes, made);
  if (cut.length == 0) return whole;
  made.push(whole.subtract(joined(cut, made)));
  return made.at(-1);
}

function answer({solids, search, rounds}) {
  let last, seconds = Infinity;
  for (let round = 0; round < rounds; ++round) {
    const made = [];
    const start = performance.now();
    const [first, second] = solids.map(shapes => solid(shapes, made));
    const value = second ? first.minGap(second, search) : first.volume();
    seconds = Math.min(seconds, (performance.now() - start) / 1000);
    last = {value, triangles: first.numTri() + (second ? second.numTri() : 0)};
    for (const one of made) one.delete();
  }
  return {...last, seconds};
}

for await (const line of createInterface({input: process.stdin}))
  console.log(JSON.stringify(answer(JSON.parse(line))));
