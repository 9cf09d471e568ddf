// The messages between the page and the server, as docs/studio.md has them.

export type Span = [number, number];
export type Vector = [number, number, number];

export interface Attribute {
  name: string;
  nameSpan: Span;
  span: Span;
  literal: 'none' | 'number' | 'boolean' | 'string' | 'vector' | 'color';
  numbers?: number[];
  text?: string;
  reason?: string;
  /** Has the value of an inherited attribute as it is written. */
  written?: string;
}

export interface TreeNode {
  kind: string;
  name: string;
  span: Span;
  nameSpan: Span;
  parent: number;
  attributes: Attribute[];
  /** Is the variable that a derived material is a copy of. */
  base?: string;
  /** Has what a derived material has from there, without places. */
  inherited?: Attribute[];
}

export interface AttributeDescription {
  name: string;
  type: string;
  required: boolean;
  default: string;
  about: string;
  choices?: string[];
}

export interface ObjectDescription {
  name: string;
  attributes: AttributeDescription[];
}

export interface Camera {
  position: Vector;
  pointing: Vector;
  fov: number;
  roll: number;
  aperture: number;
  lensRadius: number;
  focalDistance: number;
  projection: string;
  apertureShape: number;
}

export interface Diagnostic {
  severity: 'error' | 'warning';
  message: string;
  line: number;
  span: Span;
}

export interface CompletionItem {
  kind: string;
  label: string;
  detail: string;
  about: string;
  text: string;
  snippet: string;
  rank: number;
}

/** The places that get a new name, and the other scripts that have the old one. */
export interface Renaming {
  spans: Span[];
  others: string[];
}

export interface Pick {
  entity: number;
  revision: number;
  distance: number;
  position: Vector;
  normal: Vector;
  statement: Span;
  origin: Span;
}

export interface Scene {
  type: 'scene';
  revision: number;
  width: number;
  height: number;
  entities: number;
  primitives: number;
  lights: number;
  memory: number;
  warnings: string[];
  camera: Camera;
  isOverridden: boolean;
  readsTime: boolean;
  /** Is how many frames the script says that there are, or 0. */
  frames: number;
  /** Is what a scene unit is: m, cm, mm or in. */
  unit: string;
}

/** Numbers that are between two others. What is infinite is null. */
export type Interval = [number | null, number | null];

/** How much an entity is. What has no volume has a fault, which says why. */
export interface Measures {
  entity: number;
  revision: number;
  unit: string;
  metres: number;  // in a unit
  lower: (number | null)[];
  upper: (number | null)[];
  density?: number;  // of its materials, in kg per cubic metre
  volume?: Interval;
  area?: Interval;
  centroid?: [Interval, Interval, Interval];
  fault?: string;
}

export interface Region {
  x: number;
  y: number;
  width: number;
  height: number;
}

export interface SectionPlane {
  axis: number;
  offset: number;
  isFlipped: boolean;
}

/** What the view shows of the scene, without touching the script. */
export interface ViewOptions {
  channel: string;
  /** In what light the scene is shown: rendered, material or clay. */
  mode: string;
  hidden: Span[];
  section: SectionPlane | null;
  region: Region | null;
  t: number;
  /** Stops by which the picture is shown brighter than the script says. */
  exposure: number;
  /** The tone map in the place of the script's, or null. */
  toneMap: string | null;
  /** Says whether a filter smooths noise away, also where the script does not say so. */
  denoise: boolean;
}

/** A box around an entity. Sides at infinity are null. */
export interface Box {
  lower: (number | null)[];
  upper: (number | null)[];
}

/** The boxes of entities, and of what is cut from them. */
export interface Boxes {
  boxes: Box[];
  cutters: Box[];
}

export interface Machine {
  type: 'machine';
  cores: number;
  load?: number;
  memory?: number;
  freeMemory?: number;
  studioMemory?: number;
}

export interface State {
  type: 'state';
  revision: number;
  phase: 'script' | 'preparing' | 'rendering' | 'done' | 'cancelled' | 'failed';
  progress: number;
  seconds: number;
  message: string;
}

export type Message =
  | {type: 'hello'; version: string; folder: string; script: string; scripts: string[];
     beginning?: string; objects: ObjectDescription[]}
  | {type: 'opened'; script: string; text: string; typed?: string; readOnly?: boolean}
  | {type: 'analysis'; revision: number; tokens: number[]; tree: TreeNode[]}
  | {type: 'diagnostics'; revision: number; diagnostics: Diagnostic[]}
  | {type: 'answer'; id: number; revision?: number; result: unknown}
  | {type: 'finished'; revision: number; stats: Record<string, number>}
  | {type: 'print'; line: string}
  | {type: 'changed'; script: string; text: string}
  | {type: 'saved'; script: string; scripts: string[]}
  | {type: 'conflict'; script: string; message: string}
  | {type: 'error'; message: string; id?: number; about?: string}
  | Machine
  | Scene
  | State;

/** Source code, and in what it may differ from what it was written of. */
export interface Code {
  text: string;
  warnings: string[];
}

/** A rectangle of a picture, with the whole that it belongs to. */
export interface Frame {
  kind: 'draft' | 'progress' | 'final';
  isLast: boolean;
  /** Says that a filter has smoothed noise away, so that nothing is known of the error. */
  isDenoised: boolean;
  picture: number;
  revision: number;
  fullWidth: number;
  fullHeight: number;
  width: number;
  height: number;
  row: number;
  rows: number;
  pixels: Uint8ClampedArray<ArrayBuffer>;
}

const kinds = ['draft', 'progress', 'final'] as const;
const headerBytes = 40;
const frameMagic = 0x46545243;
const fileMagic = 0x49545243;

/** Reads a binary message: rows of a picture, or a picture as a file. */
export function readBinary(data: ArrayBuffer): Frame | {format: string; file: ArrayBuffer} | null {
  const view = new DataView(data);
  if (data.byteLength < 8) return null;
  const magic = view.getUint32(0, true);
  if (magic === fileMagic) {
    const format = String.fromCharCode(...new Uint8Array(data, 4, 3));
    return {format, file: data.slice(8)};
  }
  if (magic !== frameMagic || data.byteLength < headerBytes) return null;
  const at = (index: number) => view.getUint32(4 * index, true);
  return {
    kind: kinds[at(1) & 0xff] ?? 'draft',
    isLast: (at(1) & 0x100) !== 0,
    isDenoised: (at(1) & 0x200) !== 0,
    picture: at(2),
    revision: at(3),
    fullWidth: at(4),
    fullHeight: at(5),
    width: at(6),
    height: at(7),
    row: at(8),
    rows: at(9),
    pixels: new Uint8ClampedArray(data, headerBytes),
  };
}
