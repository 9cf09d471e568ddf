// Writes a camera into the script: at the literals that are there, or as a new one.

import {numberText, vectorText} from './numbers';
import type {Camera, TreeNode} from './protocol';

export interface TextEdits {
  changes: {from: number; to: number; insert: string}[];
  /** Says what could not be written, and why. */
  refused: string[];
}

export function cameraEdits(tree: TreeNode[], camera: Camera): TextEdits {
  const edits: TextEdits = {changes: [], refused: []};
  const position = vectorText('vec3', camera.position);
  const pointing = vectorText('vec3', camera.pointing);
  const whole = `Camera { position -> ${position} pointing -> ${pointing} ` +
    `fov -> ${numberText(camera.fov * 180 / Math.PI)} }`;
  const settingsIndex = tree.findIndex((node) => node.kind === 'settings');
  const settings = tree[settingsIndex];
  if (!settings) {
    edits.changes.push({from: 0, to: 0, insert: `Settings {\n    camera -> ${whole}\n}\n`});
    return edits;
  }
  const attribute = settings.attributes.find(({name}) => name === 'camera');
  if (!attribute) {
    const place = settings.attributes.at(-1)?.span[1] ?? settings.span[1] - 1;
    edits.changes.push({from: place, to: place, insert: `\n    camera -> ${whole}\n`});
    return edits;
  }
  const object = tree.find((node) => node.kind === 'object' && node.name === 'Camera' &&
    node.span[0] === attribute.span[0]) ?? variableOf(tree, attribute.reason);
  if (!object) {
    edits.refused.push(`the camera is ${attribute.reason ?? 'computed'}`);
    return edits;
  }
  const write = (name: string, text: string, isNeeded: boolean) => {
    const value = object.attributes.find((found) => found.name === name);
    if (value && value.literal !== 'none') {
      edits.changes.push({from: value.span[0], to: value.span[1], insert: text});
    } else if (value) {
      edits.refused.push(`${name} is ${value.reason ?? 'computed'}`);
    } else if (isNeeded) {
      const place = object.attributes.at(-1)?.span[1] ?? object.span[1] - 1;
      edits.changes.push({from: place, to: place, insert: ` ${name} -> ${text}`});
    }
  };
  write('position', position, true);
  write('pointing', pointing, true);
  write('fov', numberText(camera.fov * 180 / Math.PI), false);
  write('focaldistance', numberText(camera.focalDistance), false);
  return edits;
}

/** Finds the Camera that a variable was set to: "the variable 'c'". */
function variableOf(tree: TreeNode[], reason: string | undefined): TreeNode | undefined {
  const name = /^the variable '(.*)'$/.exec(reason ?? '')?.[1];
  const index = tree.findIndex((node) => node.kind === 'assignment' && node.name === name);
  return index < 0 ? undefined : tree.find((node) => node.parent === index && node.name === 'Camera');
}
