// What a point that is out of focus looks like: a spot of the shape of the lens.

import {svg} from './dom';

const corners: Readonly<Record<string, number>> = {
  triangle: 3, pentagon: 5, hexagon: 6, octagon: 8};

/** Returns a picture of spots of the shape. */
export function apertureSpots(shape: string): SVGSVGElement {
  const picture = svg('svg', {viewBox: '-1.2 -1.2 7.2 2.4', class: 'spots', role: 'img',
                              'aria-label': `Spots of the shape ${shape}`});
  for (const [x, scale] of [[0, 1], [2.2, 0.8], [4.4, 0.5]] as const) {
    const spot = spotOf(shape);
    spot.setAttribute('transform', `translate(${x} 0) scale(${scale})`);
    picture.append(spot);
  }
  return picture;
}

function spotOf(shape: string): SVGElement {
  const count = corners[shape];
  if (count !== undefined) {
    // One of the corners is at the top.
    const points = Array.from({length: count}, (_, i) => {
      const angle = 2 * Math.PI * i / count;
      return `${Math.sin(angle).toFixed(4)},${(-Math.cos(angle)).toFixed(4)}`;
    });
    return svg('polygon', {points: points.join(' ')});
  }
  switch (shape) {
    case 'uniform': return svg('rect', {x: -1, y: -1, width: 2, height: 2});
    case 'square': {
      const half = Math.SQRT1_2;
      return svg('rect', {x: -half, y: -half, width: 2 * half, height: 2 * half});
    }
    case 'line': return svg('rect', {x: -1, y: -0.03, width: 2, height: 0.06});
    case 'gaussian': return bell();
    default: return svg('circle', {r: 1});
  }
}

/** A bell fades outwards: its discs lie over one another. */
function bell(): SVGElement {
  const group = svg('g');
  for (let radius = 1; radius > 0.05; radius -= 0.1)
    group.append(svg('circle', {r: radius, opacity: 0.2}));
  return group;
}
