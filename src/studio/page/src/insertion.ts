// A list of materials and lights that are put into the script, each where it belongs.

import {cross, subtract, unit} from './camera';
import {vectorText} from './numbers';
import type {Camera, Span, TreeNode, Vector} from './protocol';

export interface InsertHost {
  text(): string;
  /** Returns the tree of the newest text, once it is known. */
  nodes(): Promise<TreeNode[]>;
  /** Returns what the view looks through, if there is a scene. */
  camera(): Camera | null;
  /** Makes an edit, and selects a piece of the text that it gives. */
  insert(place: number, text: string, selected: Span): void;
  note(text: string): void;
}

/** What is inserted where. The selected piece is counted from the beginning of the text. */
export interface Insertion {
  place: number;
  text: string;
  selected: Span;
}

const library = 'crt/materials';
const materials: Record<string, [name: string, attributes: string]> = {
  Metal: ['metal', 'color -> rgb(0.91, 0.78, 0.42) metallic -> 1 roughness -> 0.25'],
  Plastic: ['plastic', 'color -> rgb(0.6, 0.03, 0.02) roughness -> 0.3'],
  'Varnished paint': ['paint', 'color -> rgb(0.03, 0.1, 0.4) roughness -> 0.6 coat -> 1'],
  Glass: ['glass', 'color -> rgb(1, 1, 1) roughness -> 0 transmission -> 1'],
  Cloth: ['cloth', 'color -> rgb(0.25, 0.06, 0.1) roughness -> 0.9 sheen -> 1'],
};

const round = (value: number): number => Number(value.toPrecision(3));
const vector = (v: Vector): string => vectorText('vec3', v.map(round));
const grey = (value: number): string => vectorText('rgb', [value, value, value].map(round));
const length = (v: Vector): number => Math.hypot(...v);

/** Places lights before and above what the camera looks at, as bright as a white light of 1. */
const lights: Record<string, (camera: Camera) => string> = {
  'Sphere light': (camera) => {
    const {place, distance} = before(camera);
    const radius = round(distance / 6);
    return `SphereLight { center -> ${vector(place)} radius -> ${radius} ` +
      `color -> ${grey((distance / radius) ** 2)} }`;
  },
  'Disc light': (camera) => {
    const {place, distance} = before(camera);
    const radius = round(distance / 5);
    return `DiscLight { center -> ${vector(place)} ` +
      `normal -> ${vector(subtract(camera.pointing, place))} radius -> ${radius} ` +
      `color -> ${grey((distance / radius) ** 2)} }`;
  },
  'Rectangle light above': (camera) => {
    const height = before(camera).distance;
    const side = round(height / 2);
    const [x, y, z] = camera.pointing;
    return `RectangleLight { corner -> ${vector([x - side / 2, y + height, z - side / 2])} ` +
      `edgeA -> ${vector([side, 0, 0])} edgeB -> ${vector([0, 0, side])} ` +
      `color -> ${grey(Math.PI * (height / side) ** 2)} }`;
  },
  'Soft sun': (camera) => `ParallelLight { from -> ${vector(before(camera).place)} ` +
    `pointing -> ${vector(camera.pointing)} color -> rgb(1, 1, 1) angle -> 3 }`,
  'Light of the background': () => 'EnvironmentLight { scale -> 1 }',
};

/** Returns a place to the upper left of a camera, and how far it is from what that looks at. */
function before({position, pointing}: Camera): {place: Vector; distance: number} {
  const back = subtract(position, pointing);
  const across = cross([0, 1, 0], back);
  const left: Vector = length(across) > 0 ? unit(across) : [-1, 0, 0];
  const reach = 0.6 * length(back);
  const behind = unit(back);
  const arm = [0, 1, 2].map((axis) =>
    reach * (0.6 * left[axis]! + (axis === 1 ? 0.9 : 0) + 0.5 * behind[axis]!)) as Vector;
  return {place: pointing.map((value, axis) => value + arm[axis]!) as Vector, distance: length(arm)};
}

/** Returns where a light goes: into the list of lights, or with one into the settings. */
export function lightInsertion(nodes: TreeNode[], text: string, light: string): Insertion | string {
  const at = (place: number, head: string, tail: string): Insertion =>
    ({place, text: head + light + tail, selected: [head.length, head.length + light.length]});
  const settings = nodes.find(({kind}) => kind === 'settings');
  if (!settings) return at(0, 'Settings {\n    lights -> [', ']\n}\n');
  const attribute = settings.attributes.find(({name}) => name === 'lights');
  if (!attribute) {
    const place = settings.attributes.at(-1)?.span[1] ?? settings.span[1] - 1;
    return at(place, '\n    lights -> [', ']');
  }
  const [from, to] = attribute.span;
  if (attribute.reason !== 'a list') return `the lights are ${attribute.reason ?? 'computed'}`;
  const last = nodes.filter(({span}) => span[0] > from && span[1] < to).map(({span}) => span)
    .sort((a, b) => a[1] - b[1]).at(-1);
  if (!last) return at(from + 1, '', '');
  const line = text.slice(0, last[0]).split('\n').at(-1)!;
  const isOnItsLine = line.trim() === '';
  return at(last[1], isOnItsLine ? `,\n${line}` : ', ', '');
}

/** Returns where a variable with a material goes: before the scene, under a name that is free. */
export function materialInsertion(nodes: TreeNode[], text: string, kind: string): Insertion {
  const [name, attributes] = materials[kind]!;
  let free = name;
  for (let i = 2; new RegExp(`\\b${free}\\b`).test(text); ++i) free = `${name}${i}`;
  const scene = nodes.find((node) => node.kind === 'scene');
  const head = scene || text === '' || text.endsWith('\n') ? `${free} = ` : `\n${free} = `;
  const object = `PrincipledMaterial { ${attributes} }`;
  return {place: scene?.span[0] ?? text.length, text: `${head}${object}\n`,
          selected: [head.length, head.length + object.length]};
}

/** Returns where the library is imported, if it is not. */
function libraryInsertion(nodes: TreeNode[]): Insertion | string {
  if (nodes.some(({kind, name}) => kind === 'import' && name === library))
    return `"${library}" is imported already`;
  const text = `import "${library}"\n`;
  return {place: nodes[0]?.span[0] ?? 0, text, selected: [0, text.length - 1]};
}

export function makeInsertList(host: InsertHost): HTMLSelectElement {
  const list = document.createElement('select');
  list.className = 'writes insert';
  list.setAttribute('aria-label', 'Insert into the script');
  list.title = 'Insert a material or a light into the script';
  list.append(new Option('Insert…', ''));
  const add = (title: string, kinds: string[]) => {
    const group = document.createElement('optgroup');
    group.label = title;
    group.append(...kinds.map((kind) => new Option(kind, kind)));
    list.append(group);
  };
  add('Materials', [...Object.keys(materials), 'Library of materials']);
  add('Lights', Object.keys(lights));
  list.addEventListener('change', () => {
    const kind = list.value;
    list.value = '';
    void insert(host, kind);
  });
  return list;
}

async function insert(host: InsertHost, kind: string): Promise<void> {
  const nodes = await host.nodes();
  const [text, camera] = [host.text(), host.camera()];
  const light = lights[kind];
  if (light && !camera) return host.note('A light is placed when there is a picture.');
  const insertion = light ? lightInsertion(nodes, text, light(camera!))
    : materials[kind] ? materialInsertion(nodes, text, kind) : libraryInsertion(nodes);
  if (typeof insertion === 'string') return host.note(`Nothing is inserted: ${insertion}.`);
  const [from, to] = insertion.selected;
  host.insert(insertion.place, insertion.text, [insertion.place + from, insertion.place + to]);
}
