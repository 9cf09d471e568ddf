// What is drawn over the picture: the boxes of entities and of what cuts them, and the region that
// is refined.

import {svg} from './dom';
import {edgesOf, Projector} from './projection';
import type {Box, Camera, Region, Vector} from './protocol';

export class Overlay {
  readonly element = svg('svg', {class: 'overlay', 'aria-hidden': 'true'});
  private readonly wires = svg('path', {class: 'wires'});
  private readonly ghosts = svg('path', {class: 'wires ghosts'});
  private readonly region = svg('rect', {class: 'region', visibility: 'hidden'});
  private boxes: Box[] = [];
  private cutters: Box[] = [];
  private camera: Camera | null = null;
  private size = {width: 1, height: 1};

  constructor() {
    this.element.append(this.wires, this.ghosts, this.region);
  }

  setSize(width: number, height: number): void {
    this.size = {width, height};
    this.element.setAttribute('viewBox', `0 0 ${width} ${height}`);
    this.draw();
  }

  setCamera(camera: Camera): void {
    this.camera = camera;
    this.draw();
  }

  setBoxes(boxes: Box[], cutters: Box[]): void {
    this.boxes = boxes;
    // The half-space of a section cuts, too. What has no end is left out.
    this.cutters = cutters.filter(({lower, upper}) => ![...lower, ...upper].includes(null));
    this.draw();
  }

  setRegion(region: Region | null): void {
    this.region.setAttribute('visibility', region ? 'visible' : 'hidden');
    for (const [name, value] of Object.entries(region ?? {}))
      this.region.setAttribute(name, String(value));
  }

  /** Returns the place of a point in pixels of the picture. */
  placeOf(point: Vector): [number, number] | null {
    return this.projector()?.place(point) ?? null;
  }

  private projector(): Projector | null {
    const {camera, size} = this;
    return camera && new Projector(camera, size.width, size.height);
  }

  private draw(): void {
    const projector = this.projector();
    const linesOf = (boxes: Box[]) => projector === null ? '' :
      boxes.flatMap(edgesOf).flatMap(([a, b]) => projector.lines(a, b)).map((line) =>
        `M${line.map((place) => place.map((x) => x.toFixed(1)).join(' ')).join('L')}`).join('');
    this.wires.setAttribute('d', linesOf(this.boxes));
    this.ghosts.setAttribute('d', linesOf(this.cutters));
  }
}
