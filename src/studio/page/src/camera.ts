// How gestures move the camera. The top of the picture is towards y.

import type {Camera, Vector} from './protocol';

const add = (a: Vector, b: Vector): Vector => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const scale = (a: Vector, s: number): Vector => [a[0] * s, a[1] * s, a[2] * s];
export const subtract = (a: Vector, b: Vector): Vector => add(a, scale(b, -1));
export const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Vector, b: Vector): Vector =>
  [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const length = (a: Vector): number => Math.sqrt(dot(a, a));
export const unit = (a: Vector): Vector => scale(a, 1 / length(a));

/** So near to straight up or down orbiting ends, in radians. */
const poleMargin = 0.02;

/** Turns the camera about what it looks at. */
export function orbit(camera: Camera, yaw: number, pitch: number): Camera {
  const arm = subtract(camera.position, camera.pointing);
  const distance = length(arm);
  const longitude = Math.atan2(arm[0], arm[2]) - yaw;
  const most = Math.PI / 2 - poleMargin;
  const latitude = Math.max(-most, Math.min(most, Math.asin(arm[1] / distance) + pitch));
  const flat = distance * Math.cos(latitude);
  const turned: Vector = [flat * Math.sin(longitude), distance * Math.sin(latitude),
                          flat * Math.cos(longitude)];
  return {...camera, position: add(camera.pointing, turned)};
}

/** Moves the camera across, by shares of the picture's height. */
export function pan(camera: Camera, right: number, up: number): Camera {
  const forward = subtract(camera.pointing, camera.position);
  const height = 2 * length(forward) * Math.tan(Math.min(camera.fov, 3) / 2);
  // As seen in CRT's pictures, whose coordinates are left-handed: x points right where z goes away.
  const across = unit(cross([0, 1, 0], forward));
  const above = unit(cross(forward, across));
  const move = add(scale(across, right * height), scale(above, up * height));
  return {...camera, position: add(camera.position, move), pointing: add(camera.pointing, move)};
}

/** Moves the camera towards what it looks at, or away if the factor is above 1. */
export function dolly(camera: Camera, factor: number): Camera {
  const arm = subtract(camera.position, camera.pointing);
  return {...camera, position: add(camera.pointing, scale(arm, factor))};
}

/** Changes the field of view within what a lens can have. */
export function zoom(camera: Camera, factor: number): Camera {
  return {...camera, fov: Math.max(0.01, Math.min(3, camera.fov * factor))};
}

/** Lets the camera be in focus at a point. What lies behind a flat picture changes nothing. */
export function focusOn(camera: Camera, point: Vector): Camera {
  const arm = subtract(point, camera.position);
  const isAllAround = camera.projection === 'spherical' || camera.projection === 'cylindrical';
  const depth = dot(unit(subtract(camera.pointing, camera.position)), arm);
  const focalDistance = isAllAround ? length(arm) : depth;
  return focalDistance > 0 ? {...camera, focalDistance} : camera;
}
