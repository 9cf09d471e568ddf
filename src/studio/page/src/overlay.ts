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
  private readonly ruler = svg('path', {class: 'ruler'});
  private readonly rulerText = svg('text', {class: 'ruler-text', 'text-anchor': 'middle'});
  private measured: Vector[] = [];
  private boxes: Box[] = [];
  private cutters: Box[] = [];
  private camera: Camera | null = null;
  private size = {width: 1, height: 1};

  constructor() {
    this.element.append(this.wires, this.ghosts, this.region, this.ruler, this.rulerText);
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

  /** Draws a line between two places, or a mark at one, with a text. */
  setRuler(places: Vector[], text: string): void {
    this.measured = places;
    this.rulerText.textContent = text;
    this.draw();
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
    this.drawRuler(projector);
  }

  private drawRuler(projector: Projector | null): void {
    const [a, b] = this.measured;
    const lines = projector && a && b ? projector.lines(a, b) : [];
    const arm = this.size.height / 80;
    const marks = this.measured.flatMap((point) => {
      const place = projector?.place(point);
      if (!place) return [];
      const [x, y] = place;
      return [`M${x - arm} ${y}H${x + arm}M${x} ${y - arm}V${y + arm}`];
    });
    this.ruler.setAttribute('d', [...marks, ...lines.map((line) =>
      `M${line.map((place) => place.map((x) => x.toFixed(1)).join(' ')).join('L')}`)].join(''));
    const ends = lines[0];
    if (!ends) return this.rulerText.setAttribute('visibility', 'hidden');
    const [from, to] = [ends[0]!, ends.at(-1)!];
    this.rulerText.setAttribute('visibility', 'visible');
    this.rulerText.setAttribute('font-size', String(this.size.height / 24));
    this.rulerText.setAttribute('x', String((from[0] + to[0]) / 2));
    this.rulerText.setAttribute('y', String((from[1] + to[1]) / 2 - arm));
  }
}
