// Where points of the scene are in the picture.

import {cross, dot, subtract, unit} from './camera';
import type {Box, Camera, Vector} from './protocol';

/** What is nearer than this share of the way to what is looked at is cut off. */
const nearShare = 1e-3;
/** Boxes without an end are drawn to this place. */
const farthest = 1e4;

type Point = [number, number];

/** A Projector finds places of a picture of a size. Only straight projections have one. */
export class Projector {
  private readonly forward: Vector;
  private readonly right: Vector;
  private readonly up: Vector;
  private readonly near: number;

  constructor(private readonly camera: Camera, private readonly width: number,
              private readonly height: number) {
    const arm = subtract(camera.pointing, camera.position);
    this.forward = unit(arm);
    const isSteep = Math.hypot(this.forward[0], this.forward[2]) < 1e-9;
    const right = unit(cross(isSteep ? [0, 0, 1] : [0, 1, 0], this.forward));
    const up = cross(this.forward, right);
    const [c, s] = [Math.cos(camera.roll), Math.sin(camera.roll)];
    const mix = (a: number, b: number): Vector =>
      [0, 1, 2].map((i) => a * right[i]! + b * up[i]!) as Vector;
    this.right = mix(c, -s);
    this.up = mix(s, c);
    this.near = this.isFlat ? -Infinity : Math.sqrt(dot(arm, arm)) * nearShare;
  }

  static knows(camera: Camera): boolean {
    return camera.projection === 'pinhole' || camera.projection === 'orthographic';
  }

  private get isFlat(): boolean {
    return this.camera.projection === 'orthographic';
  }

  /** Returns the place of a point in pixels, or null if it is behind the camera. */
  place(point: Vector): Point | null {
    const arm = subtract(point, this.camera.position);
    const depth = dot(arm, this.forward);
    if (depth < this.near) return null;
    const distance = this.isFlat ? this.camera.focalDistance : depth;
    const scale = this.height / 2 / (distance * Math.tan(this.camera.fov / 2));
    return [this.width / 2 + scale * dot(arm, this.right),
            this.height / 2 - scale * dot(arm, this.up)];
  }

  /** Returns the two ends of what is seen of an edge, or null. */
  edge(a: Vector, b: Vector): [Point, Point] | null {
    const depth = (p: Vector) => dot(subtract(p, this.camera.position), this.forward) - this.near;
    const [da, db] = [depth(a), depth(b)];
    if (da < 0 && db < 0) return null;
    const cut = (): Vector => {
      const share = da / (da - db);
      // A little behind the plane where it was cut, so that rounding does not take it away.
      const margin = this.near * 1e-6;
      return a.map((x, i) => x + (b[i]! - x) * share + this.forward[i]! * margin) as Vector;
    };
    const ends = [this.place(da < 0 ? cut() : a), this.place(db < 0 ? cut() : b)];
    return ends[0] && ends[1] ? [ends[0], ends[1]] : null;
  }
}

/** Lists the twelve edges of a box. */
export function edgesOf(box: Box): [Vector, Vector][] {
  const corner = (bits: number): Vector =>
    [0, 1, 2].map((i) => (bits >> i) & 1 ? box.upper[i] ?? farthest : box.lower[i] ?? -farthest) as
      Vector;
  const edges: [Vector, Vector][] = [];
  for (let bits = 0; bits < 8; ++bits)
    for (let axis = 0; axis < 3; ++axis)
      if (((bits >> axis) & 1) === 0) edges.push([corner(bits), corner(bits | (1 << axis))]);
  return edges;
}
