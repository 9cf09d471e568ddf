// The live view shows the pictures as they come, and turns gestures into cameras.

import {dolly, orbit, pan, zoom} from './camera';
import {Comparison} from './comparison';
import {Overlay} from './overlay';
import type {Camera, Frame, Region} from './protocol';

export interface ViewHost {
  cameraMoved(camera: Camera): void;
  cameraReset(): void;
  picked(x: number, y: number, focuses: boolean): void;
  modeChanged(): void;
  /** Takes the part of the picture that is to be refined, or null for all of it. */
  regionChosen(region: Region | null): void;
}

const radiansAPixel = 0.01;
const keyRadians = 0.06;
const keyShare = 0.05;
const wheelRate = 0.0015;
/** A press that moves less than this is a click. */
const clickPixels = 4;
/** The canvas of a larger picture has fewer pixels, as the pictures that the server sends have. */
const mostPixels = 2 ** 23;

export class LiveView {
  readonly element = document.createElement('div');
  readonly canvas = document.createElement('canvas');
  readonly overlay = new Overlay();
  readonly comparison: Comparison;
  /** Counts the pictures that were shown, for tests. */
  shown = 0;
  lastKind = '';
  private readonly stage = new OffscreenCanvas(1, 1);
  private stageKind = '';
  private camera: Camera | null = null;
  private asked: Camera | null = null;
  private readonly pointers = new Map<number, {x: number; y: number}>();
  private moved = 0;
  /** Is where a region begins while it is dragged. */
  private corner: {x: number; y: number} | null = null;
  private readonly area = document.createElement('div');
  private readonly frame = document.createElement('div');
  private readonly note = document.createElement('p');
  private readonly mark = document.createElement('span');
  /** Is the size of the whole picture. */
  private size = {width: 1, height: 1};
  private takesRegion = false;
  /** Is the first revision of which pictures are shown. */
  private first = 0;

  constructor(private readonly host: ViewHost) {
    this.element.className = 'live';
    this.canvas.tabIndex = 0;
    // It takes keys, which a picture does not.
    this.canvas.setAttribute('role', 'application');
    this.canvas.setAttribute('aria-label',
      'Picture: drag or arrow keys turn, shift moves, wheel or plus and minus go nearer');
    this.note.className = 'hint';
    this.area.className = 'area';
    this.frame.className = 'frame';
    this.mark.className = 'mark';
    this.mark.textContent = 'Denoised';
    this.mark.hidden = true;
    this.frame.append(this.canvas, this.overlay.element, this.mark);
    this.area.append(this.frame, this.note);
    this.clear(0);
    this.element.append(this.area);
    this.comparison = new Comparison(this.canvas, this.frame);
    new ResizeObserver(() => this.fit()).observe(this.area);
    const canvas = this.canvas;
    canvas.addEventListener('pointerdown', (event) => this.press(event));
    canvas.addEventListener('pointermove', (event) => this.drag(event));
    canvas.addEventListener('pointerup', (event) => this.release(event));
    canvas.addEventListener('pointercancel', (event) => this.pointers.delete(event.pointerId));
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
    canvas.addEventListener('wheel', (event) => this.wheel(event), {passive: false});
    canvas.addEventListener('keydown', (event) => this.key(event));
  }

  /** Takes the picture away until there is one of a revision, or of a later one. */
  clear(revision: number): void {
    this.first = revision;
    this.frame.hidden = true;
    this.note.replaceChildren();
  }

  /** Says why there is no picture, while there is none. */
  say(note: string, ...more: HTMLElement[]): void {
    if (this.frame.hidden) this.note.replaceChildren(note, ...more);
  }

  /** Lets the next drag choose a region, or not. */
  takeRegion(takes: boolean): void {
    this.takesRegion = takes;
  }

  setCamera(camera: Camera): void {
    if (this.asked !== null) return;
    this.camera = camera;
    this.overlay.setCamera(camera);
  }

  show(frame: Frame): void {
    const {canvas, stage} = this;
    this.resize(frame.fullWidth, frame.fullHeight);
    if (stage.width !== frame.width || stage.height !== frame.height ||
        this.stageKind !== frame.kind) {
      stage.width = frame.width;
      stage.height = frame.height;
      this.stageKind = frame.kind;
    }
    const target = stage.getContext('2d')!;
    if (frame.rows > 0)
      target.putImageData(new ImageData(frame.pixels, frame.width, frame.rows), 0, frame.row);
    if (!frame.isLast || frame.revision < this.first) return;
    const context = canvas.getContext('2d')!;
    if (frame.kind !== 'progress') context.clearRect(0, 0, canvas.width, canvas.height);
    context.imageSmoothingEnabled = frame.kind === 'draft';
    context.drawImage(stage, 0, 0, canvas.width, canvas.height);
    this.frame.hidden = false;
    this.note.replaceChildren();
    this.shown += 1;
    this.lastKind = frame.kind;
    // Below a picture in progress there is another one.
    const isDenoised = frame.isDenoised || (frame.kind === 'progress' && this.isDenoised);
    this.mark.hidden = !isDenoised;
  }

  /** Says whether a filter has smoothed noise away, perhaps in a part of the picture. */
  get isDenoised(): boolean {
    return !this.mark.hidden;
  }

  private resize(width: number, height: number): void {
    if (this.size.width === width && this.size.height === height) return;
    this.size = {width, height};
    const step = Math.max(1, Math.ceil(Math.sqrt(width * height / mostPixels)));
    this.canvas.width = Math.ceil(width / step);
    this.canvas.height = Math.ceil(height / step);
    this.overlay.setSize(width, height);
    this.fit();
  }

  private fit(): void {
    const {clientWidth, clientHeight} = this.area;
    const {width, height} = this.size;
    const scale = Math.min(clientWidth / width, clientHeight / height);
    this.frame.style.width = `${Math.max(1, width * scale)}px`;
    this.frame.style.height = `${Math.max(1, height * scale)}px`;
  }

  /** Returns the place of an event in pixels of the picture. */
  private placeOf(event: MouseEvent): {x: number; y: number} {
    const box = this.canvas.getBoundingClientRect();
    return {x: (event.clientX - box.left) / box.width * this.size.width,
            y: (event.clientY - box.top) / box.height * this.size.height};
  }

  private regionTo(event: PointerEvent): Region {
    const [a, b] = [this.corner!, this.placeOf(event)];
    const within = (value: number, most: number) => Math.round(Math.max(0, Math.min(most, value)));
    const [left, right] = [Math.min(a.x, b.x), Math.max(a.x, b.x)]
      .map((x) => within(x, this.size.width)) as [number, number];
    const [top, bottom] = [Math.min(a.y, b.y), Math.max(a.y, b.y)]
      .map((y) => within(y, this.size.height)) as [number, number];
    return {x: left, y: top, width: right - left, height: bottom - top};
  }

  /** Asks for pictures of a camera, the newest once a frame of the screen. */
  private move(camera: Camera): void {
    this.camera = camera;
    this.overlay.setCamera(camera);
    const isFirst = this.asked === null;
    this.asked = camera;
    if (!isFirst) return;
    requestAnimationFrame(() => {
      const newest = this.asked!;
      this.asked = null;
      this.host.cameraMoved(newest);
    });
  }

  private press(event: PointerEvent): void {
    this.canvas.focus();
    this.canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
    if (this.pointers.size === 1) this.moved = 0;
    this.corner = event.ctrlKey || event.metaKey || this.takesRegion ? this.placeOf(event) : null;
  }

  private drag(event: PointerEvent): void {
    const before = this.pointers.get(event.pointerId);
    if (!before || !this.camera) return;
    const dx = event.clientX - before.x;
    const dy = event.clientY - before.y;
    const others = [...this.pointers].filter(([id]) => id !== event.pointerId);
    this.pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
    this.moved += Math.abs(dx) + Math.abs(dy);
    if (this.moved < clickPixels) return;
    if (this.corner) return this.overlay.setRegion(this.regionTo(event));
    const height = this.canvas.clientHeight;
    const other = others[0]?.[1];
    if (other) {  // two fingers: pinch, and move by half of what each moves
      const distance = (x: number, y: number) => Math.hypot(x - other.x, y - other.y);
      const factor = distance(before.x, before.y) / Math.max(1, distance(event.clientX, event.clientY));
      this.move(pan(dolly(this.camera, factor), -dx / height / 2, dy / height / 2));
    } else if (event.shiftKey || (event.buttons & 6) !== 0) {
      this.move(pan(this.camera, -dx / height, dy / height));
    } else {
      this.move(orbit(this.camera, -dx * radiansAPixel, dy * radiansAPixel));
    }
  }

  private release(event: PointerEvent): void {
    const wasDown = this.pointers.delete(event.pointerId);
    if (wasDown && this.corner && this.moved >= clickPixels) {
      const region = this.regionTo(event);
      this.corner = null;
      return this.host.regionChosen(region.width > 0 && region.height > 0 ? region : null);
    }
    if (!wasDown || this.moved >= clickPixels || event.button !== 0) return;
    const {x, y} = this.placeOf(event);
    this.host.picked(x, y, event.altKey);
  }

  private wheel(event: WheelEvent): void {
    if (!this.camera) return;
    event.preventDefault();
    const factor = Math.exp(event.deltaY * wheelRate);
    this.move(event.altKey ? zoom(this.camera, factor) : dolly(this.camera, factor));
  }

  private key(event: KeyboardEvent): void {
    if (!this.camera || event.ctrlKey || event.metaKey) return;
    const directions: Record<string, [number, number]> = {
      ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
    const direction = directions[event.key];
    if (direction) {
      const [x, y] = direction;
      this.move(event.shiftKey ? pan(this.camera, x * keyShare, y * keyShare)
                               : orbit(this.camera, x * keyRadians, y * keyRadians));
    } else if (event.key === '+' || event.key === '=') {
      this.move(dolly(this.camera, 0.9));
    } else if (event.key === '-') {
      this.move(dolly(this.camera, 1 / 0.9));
    } else if (event.key === '[' || event.key === ']') {
      this.move(zoom(this.camera, event.key === '[' ? 0.95 : 1 / 0.95));
    } else if (event.key === 'Home') {
      this.host.cameraReset();
    } else if (event.key === 'm') {
      this.host.modeChanged();
    } else if (event.key === 'Escape') {
      this.host.regionChosen(null);
    } else {
      return;
    }
    event.preventDefault();
  }
}
