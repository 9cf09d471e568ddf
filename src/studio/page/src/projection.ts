// Where points of the scene are in the picture.

import {cross, dot, subtract, unit} from './camera';
import type {Box, Camera, Vector} from './protocol';

/** What is nearer than this share of the way to what is looked at is cut off. */
const nearShare = 1e-3;
/** Boxes without an end are drawn to this place. */
const farthest = 1e4;

export type Point = [number, number];

/** An edge is drawn by pieces that are seen under no larger angle, in radians, where it is bent. */
const longestPiece = 0.05;
/** An edge is halved so often at most. */
const mostHalvings = 10;

const middle = (a: Vector, b: Vector): Vector => a.map((x, i) => (x + b[i]!) / 2) as Vector;

/** A Projector finds places of a picture of a size, as the library's cameras see them. */
export class Projector {
  private readonly forward: Vector;
  private readonly right: Vector;
  private readonly up: Vector;
  private readonly near: number;
  private readonly halfAcross: number;
  private readonly halfUp: number;

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
    const isFlat = camera.projection === 'orthographic';
    this.near = isFlat || this.isBent ? -Infinity : Math.sqrt(dot(arm, arm)) * nearShare;
    const halfAngle = camera.fov / 2;
    const halfLength = Math.tan(halfAngle);
    this.halfAcross = (this.isBent ? halfAngle : halfLength) * width / height;
    this.halfUp = camera.projection === 'spherical' ? halfAngle : halfLength;
  }

  /** Says whether straight lines are bent in the picture, which may go all around. */
  private get isBent(): boolean {
    return this.camera.projection === 'spherical' || this.camera.projection === 'cylindrical';
  }

  /** Returns the place of a point in pixels, or null if it is behind the camera. */
  place(point: Vector): Point | null {
    const arm = subtract(point, this.camera.position);
    const depth = dot(arm, this.forward);
    if (depth < this.near) return null;
    const [nx, ny] = this.scaled(dot(arm, this.right), dot(arm, this.up), depth);
    return [this.width / 2 * (1 + nx / this.halfAcross), this.height / 2 * (1 - ny / this.halfUp)];
  }

  /** Returns a place in lengths at distance 1, or in angles where the picture has these. */
  private scaled(toRight: number, toTop: number, depth: number): Point {
    const level = Math.hypot(toRight, depth);
    switch (this.camera.projection) {
      case 'spherical': return [Math.atan2(toRight, depth), Math.atan2(toTop, level)];
      case 'cylindrical': return [Math.atan2(toRight, depth), toTop / level];
      case 'orthographic':
        return [toRight / this.camera.focalDistance, toTop / this.camera.focalDistance];
      default: return [toRight / depth, toTop / depth];
    }
  }

  /** Returns the lines that are seen of an edge. */
  lines(a: Vector, b: Vector): Point[][] {
    if (!this.isBent) return this.straightLine(a, b);
    const places = [a, ...this.between(a, b, mostHalvings), b].map((point) => this.place(point)!);
    // Where the picture goes all around, an edge may leave it on one side and enter on the other.
    const turn = this.width * Math.PI / this.halfAcross;  // in pixels
    const lines: Point[][] = [[]];
    places.forEach((place, i) => {
      if (i > 0 && Math.abs(place[0] - places[i - 1]![0]) > turn / 2) lines.push([]);
      lines.at(-1)!.push(place);
    });
    return lines.filter((line) => line.length > 1);
  }

  /** Returns points between two of which each is seen near to the next. */
  private between(a: Vector, b: Vector, halvings: number): Vector[] {
    const [first, last] = [a, b].map((end) => subtract(end, this.camera.position)) as
      [Vector, Vector];
    const angle = Math.atan2(Math.hypot(...cross(first, last)), dot(first, last));
    if (halvings === 0 || angle < longestPiece) return [];
    const half = middle(a, b);
    return [...this.between(a, half, halvings - 1), half, ...this.between(half, b, halvings - 1)];
  }

  private straightLine(a: Vector, b: Vector): Point[][] {
    const depth = (p: Vector) => dot(subtract(p, this.camera.position), this.forward) - this.near;
    const [da, db] = [depth(a), depth(b)];
    if (da < 0 && db < 0) return [];
    const cut = (): Vector => {
      const share = da / (da - db);
      // A little behind the plane where it was cut, so that rounding does not take it away.
      const margin = this.near * 1e-6;
      return a.map((x, i) => x + (b[i]! - x) * share + this.forward[i]! * margin) as Vector;
    };
    const ends = [this.place(da < 0 ? cut() : a), this.place(db < 0 ? cut() : b)];
    return ends[0] && ends[1] ? [[ends[0], ends[1]]] : [];
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
