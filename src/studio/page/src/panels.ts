// The smaller panels: the console and statistics.

import {numberText} from './numbers';
import type {Scene} from './protocol';

const mostLines = 2000;

type Kind = 'print' | 'note' | 'error' | 'warning';

export class Console {
  readonly element = document.createElement('div');
  private warnings: string[] = [];

  constructor() {
    this.element.className = 'console';
    this.element.setAttribute('role', 'log');
    this.element.tabIndex = 0;
  }

  add(text: string, kind: Kind = 'note'): void {
    this.append(text, kind);
  }

  /** Adds what a run of the script has to say, which goes when it is run again. */
  addOfRun(text: string, kind: Kind): void {
    this.append(text, kind).classList.add('of-run');
  }

  /** Takes away what the run before said. */
  beginRun(): void {
    for (const line of this.element.querySelectorAll('.of-run')) line.remove();
    this.warnings = [];
  }

  /** Shows what there is to say about a scene, once. */
  setWarnings(warnings: string[]): void {
    if (String(warnings) === String(this.warnings)) return;
    for (const line of this.element.querySelectorAll('.of-run.warning')) line.remove();
    for (const warning of warnings) this.addOfRun(warning, 'warning');
    this.warnings = warnings;
  }

  private append(text: string, kind: Kind): HTMLElement {
    const isAtEnd =
      this.element.scrollTop + this.element.clientHeight >= this.element.scrollHeight - 4;
    const line = document.createElement('div');
    line.className = `line ${kind}`;
    line.textContent = text;
    this.element.append(line);
    while (this.element.childElementCount > mostLines) this.element.firstElementChild!.remove();
    if (isAtEnd) this.element.scrollTop = this.element.scrollHeight;
    return line;
  }
}

/** Says how a number of the server's is called, and what is shown of it. */
type Row = readonly [key: string, title: string, text: (value: number) => string];

const count = (value: number) => value.toLocaleString('en');
const short = (value: number, digits: number) => numberText(Number(value.toPrecision(digits)));
const seconds = (value: number) =>
  value < 0.1 ? `${short(1000 * value, 2)} ms` : `${short(value, 3)} s`;
const steps = (value: number) => `${short(255 * value, 2)} steps of 8 bits`;

const always: readonly Row[] = [
  ['seconds of tracing', 'Tracing', seconds], ['seconds of preparing', 'Preparing', seconds],
  ['threads', 'Threads', count], ['camera rays', 'Camera rays', count],
  ['shadow rays', 'Shadow rays', count], ['reflection rays', 'Reflection rays', count],
  ['refraction rays', 'Refraction rays', count],
  ['intersection tests', 'Intersection tests', count],
  ['exact fallbacks', 'Exact fallbacks', count],
  ['samples of a pixel (mean)', 'Samples of a pixel', (value) => value.toFixed(1)]];
const errorKey = 'error of 95 of 100 pixels';
/** The plain grid knows nothing of its error. */
const byPasses: readonly Row[] = [
  ['passes', 'Passes', count], [errorKey, '95 of 100 pixels within', steps]];

export class Statistics {
  readonly element = document.createElement('div');
  private scene: Scene | null = null;
  private stats: Record<string, number> = {};
  private isDenoised = false;

  constructor() {
    this.element.className = 'statistics';
    this.element.tabIndex = 0;
    this.draw();
  }

  setScene(scene: Scene): void {
    this.scene = scene;
    this.draw();
  }

  setStats(stats: Record<string, number>): void {
    this.stats = stats;
    this.draw();
  }

  /** Shows no error of a picture that is denoised. */
  setDenoised(isDenoised: boolean): void {
    if (this.isDenoised === isDenoised) return;
    this.isDenoised = isDenoised;
    this.draw();
  }

  private draw(): void {
    const {scene, stats} = this;
    if (!scene) {
      const hint = document.createElement('p');
      hint.className = 'hint';
      hint.textContent = 'Numbers of the scene and of its picture come with the first picture.';
      return this.element.replaceChildren(hint);
    }
    const rows = [...always, ...(stats['passes'] ? byPasses : [])]
      .filter(([key]) => stats[key] !== undefined || key === errorKey)
      .map(([key, title, text]): [string, string] => [title, key === errorKey && this.isDenoised
        ? 'not known of what is denoised' : text(stats[key]!)]);
    this.element.replaceChildren(
      tableOf('Scene', [
        ['Picture', `${scene.width} × ${scene.height}`], ['Entities', count(scene.entities)],
        ['Primitives', count(scene.primitives)], ['Lights', count(scene.lights)],
        ['Memory', `${count(Math.ceil(scene.memory / 1024))} KiB`]]),
      tableOf('Last picture', rows));
  }
}

function tableOf(title: string, rows: [string, string][]): HTMLTableElement {
  const table = document.createElement('table');
  table.createCaption().textContent = title;
  for (const [name, text] of rows) {
    const row = table.insertRow();
    const head = document.createElement('th');
    head.scope = 'row';
    head.textContent = name;
    row.append(head);
    row.insertCell().textContent = text;
  }
  return table;
}
