// This program measures solids by Manifold: measures.mjs FOLDER < QUESTIONS > ANSWERS
// FOLDER is where manifold-3d is installed. Each line of QUESTIONS is one in JSON:
//   {"solids": [{"joined": [SHAPE, ...], "cut": [SHAPE, ...]}, ...], "search": LENGTH}
// A SHAPE has a matrix, column after column, and is a "cube" from 0 to 1, a "sphere" of radius 1
// with `sides`, or a "turned" `profile`. ANSWERS has a line for each: the volume of one solid, or
// how near two are within a length, the triangles, and the seconds of processors, of the fastest
// of some rounds.

import {createInterface} from 'node:readline';
import {resolve} from 'node:path';
import {pathToFileURL} from 'node:url';

const ROUNDS = 3; // fewer if they take long
const MOST_SECONDS = 10;

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

function answer({solids, search}) {
  let last, seconds = Infinity, all = 0;
  for (let round = 0; round < ROUNDS && all < MOST_SECONDS; ++round) {
    const made = [];
    const start = process.cpuUsage();
    const [first, second] = solids.map(shapes => solid(shapes, made));
    const value = second ? first.minGap(second, search) : first.volume();
    const {user, system} = process.cpuUsage(start);
    seconds = Math.min(seconds, (user + system) / 1e6);
    all += (user + system) / 1e6;
    last = {value, triangles: first.numTri() + (second ? second.numTri() : 0)};
    for (const one of made) one.delete();
  }
  return {...last, seconds};
}

for await (const line of createInterface({input: process.stdin}))
  console.log(JSON.stringify(answer(JSON.parse(line))));
