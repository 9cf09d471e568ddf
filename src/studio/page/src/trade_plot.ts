// The curve of what time buys: how far pictures in progress were from the last one. It answers as
// `crt trade` does, which compares with a reference instead.

import {input, svg} from './dom';
import {numberText} from './numbers';
import type {Frame} from './protocol';

const plotWidth = 260;
const plotHeight = 80;
const margin = 4;
/** About so many pixels of a picture are compared, and so many pictures. */
const mostPixels = 40_000;
const mostPictures = 40;
const stepsOfDisplay = 255;

interface Measure {
  /** Is the time of tracing. */
  seconds: number;
  /** The root of the mean of the squares, in steps of 8 bits. */
  difference: number;
}

/** What a render by passes knows of itself, in steps of 8 bits. */
interface Estimate {
  rms: number;
  of95: number;
}

const short = (value: number): string => numberText(Number(value.toPrecision(2)));

export class TradePlot {
  readonly element = document.createElement('figure');
  measures: Measure[] = [];
  estimate: Estimate = {rms: 0, of95: 0};
  private readonly line = svg('polyline');
  private readonly range = document.createElement('p');
  private readonly answer = document.createElement('output');
  private readonly own = document.createElement('p');
  private readonly wanted = input('number', 'Steps of 8 bits', '1', () => this.drawAnswer());
  /** Has measures of the picture that has ended, with the seconds since something changed. */
  private timed: Measure[] = [];
  private kept: {seconds: number; pixels: Uint8ClampedArray}[] = [];
  /** Some of the pixels of the picture that comes, of which only changed rows are sent. */
  private pixels = new Uint8ClampedArray();
  private key = '';
  /** Says whether what is shown is denoised. What time buys is not known of such pictures. */
  private isDenoised = false;

  constructor() {
    this.element.className = 'trade';
    const picture = svg('svg', {viewBox: `0 0 ${plotWidth} ${plotHeight}`, role: 'img',
                                'aria-label': 'Difference against time, both logarithmic'});
    picture.append(this.line);
    const caption = document.createElement('figcaption');
    caption.textContent = 'RMSE from the last picture, in steps of 8 bits';
    this.wanted.min = '0';
    const question = document.createElement('p');
    question.append('Within ', this.wanted, ' steps: ', this.answer);
    const texts = document.createElement('div');
    texts.append(caption, this.range, question, this.own);
    this.element.append(picture, texts);
    this.element.hidden = true;
  }

  /** Takes what comes of pictures, and the seconds since something changed. */
  add(frame: Frame, seconds: number): void {
    this.sample(frame);
    if (!frame.isLast) return;
    this.isDenoised = frame.isDenoised;
    this.hide();
    if (frame.kind === 'draft' || frame.isDenoised) {
      this.kept = [];
    } else if (frame.kind === 'progress') {
      // A picture that has holes is not rendered by passes.
      if (this.pixels.every((value, i) => i % 4 !== 3 || value > 0))
        this.kept.push({seconds, pixels: this.pixels.slice()});
      if (this.kept.length > mostPictures) this.kept = this.kept.filter((_, i) => i % 2 === 0);
    } else {
      this.timed = this.kept.map((picture) => ({
        seconds: picture.seconds, difference: differenceOf(picture.pixels, this.pixels)}))
        .filter(({difference}) => difference > 0);
      this.kept = [];
    }
  }

  /** Takes what the render says of itself at its end, and the seconds since something changed. */
  end(stats: Record<string, number>, seconds: number): void {
    const steps = (name: string) => stepsOfDisplay * (stats[name] ?? 0);
    this.estimate = {rms: steps('error of pixels (root mean square)'),
                     of95: steps('error of 95 of 100 pixels')};
    const before = Math.max(0, seconds - (stats['seconds of tracing'] ?? seconds));
    this.measures = this.timed
      .map((measure) => ({...measure, seconds: measure.seconds - before}))
      .filter((measure) => measure.seconds > 0);
    this.timed = [];
    this.draw();
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

  private hide(): void {
    this.element.hidden = this.measures.length < 2 || this.isDenoised;
  }

  private draw(): void {
    const {measures, estimate} = this;
    this.hide();
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
      `${short(difference)} after ${seconds.toFixed(2)} s`;
    this.range.textContent = `${inWords(measures[0]!)}, ${inWords(measures.at(-1)!)}`;
    this.own.textContent = 'The last picture’s own error, as it knows: 95 of 100 pixels within ' +
      `${short(estimate.of95)} steps`;
    this.drawAnswer();
  }

  /** Says from when on pictures were near enough, as an option of `crt render`. */
  private drawAnswer(): void {
    const wanted = this.wanted.valueAsNumber;
    const isFar = this.measures.map(({difference}) => !(difference <= wanted));
    const first = this.measures[isFar.lastIndexOf(true) + 1];
    const option = document.createElement('code');
    option.textContent = first ? `--timebudget ${short(first.seconds)}` : '';
    this.answer.replaceChildren(
      !(wanted >= this.estimate.rms) ? 'the last picture is not certain enough to tell' :
      first ? option : 'only the last picture is so near');
  }
}

function differenceOf(a: Uint8ClampedArray, b: Uint8ClampedArray): number {
  if (a.length !== b.length) return 0;
  let squares = 0;
  for (let i = 0; i < a.length; ++i) squares += (a[i]! - b[i]!) ** 2;
  return Math.sqrt(squares / (a.length * 3 / 4));
}
