// The curve of what time buys: how far pictures in progress were from the last one.

import {svg} from './dom';
import {numberText} from './numbers';
import type {Frame} from './protocol';

const plotWidth = 260;
const plotHeight = 80;
const margin = 4;
/** About so many pixels of a picture are compared, and so many pictures. */
const mostPixels = 40_000;
const mostPictures = 40;

interface Measure {
  seconds: number;
  /** The root of the mean of the squares, in steps of 8 bits. */
  difference: number;
}

export class TradePlot {
  readonly element = document.createElement('figure');
  measures: Measure[] = [];
  private readonly line = svg('polyline');
  private readonly caption = document.createElement('figcaption');
  private kept: {seconds: number; pixels: Uint8ClampedArray}[] = [];
  /** Some of the pixels of the picture that comes, of which only changed rows are sent. */
  private pixels = new Uint8ClampedArray();
  private key = '';

  constructor() {
    this.element.className = 'trade';
    const picture = svg('svg', {viewBox: `0 0 ${plotWidth} ${plotHeight}`, role: 'img',
                                'aria-label': 'Difference against time, both logarithmic'});
    picture.append(this.line);
    this.element.append(picture, this.caption);
    this.element.hidden = true;
  }

  /** Takes what comes of pictures, and the seconds since the render began. */
  add(frame: Frame, seconds: number): void {
    this.sample(frame);
    if (!frame.isLast) return;
    if (frame.kind === 'draft') {
      this.kept = [];
    } else if (frame.kind === 'progress') {
      // A picture that has holes is not rendered by passes.
      if (this.pixels.every((value, i) => i % 4 !== 3 || value > 0))
        this.kept.push({seconds, pixels: this.pixels.slice()});
      if (this.kept.length > mostPictures) this.kept = this.kept.filter((_, i) => i % 2 === 0);
    } else {
      this.measures = this.kept.map((picture) => ({
        seconds: picture.seconds, difference: differenceOf(picture.pixels, this.pixels)}))
        .filter(({difference}) => difference > 0);
      this.kept = [];
      this.draw();
    }
  }

  private sample(frame: Frame): void {
    const step = Math.max(1, Math.floor(Math.sqrt(frame.width * frame.height / mostPixels)));
    const across = Math.ceil(frame.width / step);
    const key = `${frame.kind} ${frame.width} ${frame.height}`;
    if (key !== this.key)
      this.pixels = new Uint8ClampedArray(4 * across * Math.ceil(frame.height / step));
    this.key = key;
    for (let row = Math.ceil(frame.row / step) * step; row < frame.row + frame.rows; row += step) {
      for (let i = 0; i < across; ++i) {
        const from = 4 * ((row - frame.row) * frame.width + i * step);
        this.pixels.set(frame.pixels.subarray(from, from + 4), 4 * (row / step * across + i));
      }
    }
  }

  private draw(): void {
    const {measures} = this;
    this.element.hidden = measures.length < 2;
    if (measures.length < 2) return;
    const scaled = (values: number[], size: number) => {
      const logs = values.map(Math.log10);
      const [low, high] = [Math.min(...logs), Math.max(...logs)];
      const range = high > low ? high - low : 1;
      return logs.map((log) => margin + (size - 2 * margin) * (log - low) / range);
    };
    const x = scaled(measures.map(({seconds}) => seconds), plotWidth);
    const y = scaled(measures.map(({difference}) => difference), plotHeight);
    this.line.setAttribute('points',
      x.map((at, i) => `${at.toFixed(1)},${(plotHeight - y[i]!).toFixed(1)}`).join(' '));
    const inWords = ({seconds, difference}: Measure) =>
      `${numberText(Number(difference.toPrecision(2)))} after ${seconds.toFixed(2)} s`;
    this.caption.textContent = 'From the last picture, in steps of 8 bits: ' +
      `${inWords(measures[0]!)}, ${inWords(measures.at(-1)!)}`;
  }
}

function differenceOf(a: Uint8ClampedArray, b: Uint8ClampedArray): number {
  if (a.length !== b.length) return 0;
  let squares = 0;
  for (let i = 0; i < a.length; ++i) squares += (a[i]! - b[i]!) ** 2;
  return Math.sqrt(squares / (a.length * 3 / 4));
}
