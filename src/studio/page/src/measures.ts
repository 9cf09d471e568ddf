// How much the entity is that is selected: numbers with the digits that are sure, below its
// properties.

import {input} from './dom';
import type {Interval, Measures, Span} from './protocol';

export interface MeasuresHost {
  measure(span: Span): Promise<Measures | null>;
}

/** The numbers wait for such a pause in typing and selecting. */
const pauseMilliseconds = 300;

/** This is the density of water, in kg per cubic metre, for what no material says. */
const usualDensity = 1000;

/** Writes the middle of an interval with the digits that are sure. */
export function sureText([lower, upper]: Interval): string {
  if (lower === null || upper === null) return '?';
  const middle = (lower + upper) / 2;
  const width = upper - lower;
  if (middle === 0 || Math.abs(middle) < width) return '0';
  const places = (x: number) => Math.floor(Math.log10(Math.abs(x)));
  const digits = width > 0 ? places(middle) - places(width) : 9;
  return String(Number(middle.toPrecision(Math.min(9, Math.max(1, digits)))));
}

export class MeasuresSheet {
  readonly element = document.createElement('section');
  private readonly rows = document.createElement('dl');
  private readonly density: HTMLInputElement;
  private readonly mass = document.createElement('dd');
  private span: Span | null = null;
  private measures: Measures | null = null;
  private asked = 0;
  private timer: ReturnType<typeof setTimeout> | undefined;

  constructor(private readonly host: MeasuresHost) {
    this.element.className = 'measures';
    this.element.setAttribute('aria-label', 'Measures');
    this.density = input('number', 'Density', '', () => this.drawMass());
    this.density.min = '0';
    this.draw();
  }

  /** Measures what comes from a piece of the text, or nothing. */
  show(span: Span | null): void {
    clearTimeout(this.timer);
    const isSame = span !== null && this.span !== null && span[0] === this.span[0];
    this.span = span;
    if (!isSame) {
      this.set(null);
      this.density.value = '';
    }
    if (span) this.timer = setTimeout(() => void this.ask(span), pauseMilliseconds);
  }

  /** Measures again, as the scene is another one. */
  update(): void {
    this.show(this.span);
  }

  private async ask(span: Span): Promise<void> {
    const asked = ++this.asked;
    const measures = await this.host.measure(span);
    // What was asked later has ended this.
    if (asked === this.asked && this.span === span) this.set(measures);
  }

  private set(measures: Measures | null): void {
    this.measures = measures;
    this.draw();
  }

  private draw(): void {
    const {measures} = this;
    this.element.hidden = measures === null;
    this.rows.replaceChildren();
    if (!measures) return;
    const {unit, lower, upper, volume, area, centroid, fault} = measures;
    const size = lower.map((low, i) => {
      const high = upper[i];
      return low === null || high === null || high === undefined ? '∞' :
        sureText([high - low, high - low]);
    });
    this.add('Size', `${size.join(' × ')} ${unit}`);
    if (fault !== undefined) this.add('Volume', `none: ${fault}`);
    if (volume) this.add('Volume', `${sureText(volume)} ${unit}³`, volume);
    if (area) this.add('Area', `${sureText(area)} ${unit}²`, area);
    if (centroid) this.add('Centroid', `${centroid.map(sureText).join(', ')} ${unit}`);
    if (!volume) return;
    const density = document.createElement('dd');
    this.density.placeholder = String(measures.density ?? usualDensity);
    density.append(this.density, ' kg/m³');
    this.add('Density', density);
    this.add('Mass', this.mass);
    this.drawMass();
  }

  private add(name: string, value: string | HTMLElement, interval?: Interval): void {
    const term = document.createElement('dt');
    term.textContent = name;
    let row: HTMLElement;
    if (typeof value === 'string') {
      row = document.createElement('dd');
      row.textContent = value;
    } else {
      row = value;
    }
    if (interval) row.title = `between ${interval[0] ?? '−∞'} and ${interval[1] ?? '∞'}`;
    this.rows.append(term, row);
    if (!this.element.contains(this.rows)) this.element.replaceChildren(heading(), this.rows);
  }

  private drawMass(): void {
    if (!this.measures?.volume) return;
    const {volume: [lower, upper], metres} = this.measures;
    const density = Number(this.density.value || this.density.placeholder);
    if (!(density >= 0)) return;
    const scale = density * metres ** 3;
    const mass = sureText([lower === null ? null : lower * scale,
                           upper === null ? null : upper * scale]);
    this.mass.textContent = `${mass} kg`;
  }
}

function heading(): HTMLElement {
  const title = document.createElement('h3');
  title.textContent = 'Measures';
  return title;
}
