// What the view shows of the scene. What is hidden moves with the text.

import type {ChangeDesc} from '@codemirror/state';

import type {Span, ViewOptions} from './protocol';
import {storage} from './storage';

/** The light in which scenes are shown, by what it is called. The browser keeps the choice. */
export const modes = [
  ['rendered', 'Rendered'], ['material', 'Material'], ['clay', 'Clay']] as const;
const modeKey = 'crt-studio:mode';
/** The browser keeps, too, whether noise is smoothed away. */
const denoiseKey = 'crt-studio:denoise';

function keptMode(): string {
  const kept = storage.getItem(modeKey);
  return modes.some(([mode]) => mode === kept) ? kept! : modes[0][0];
}

/** All of a scene, as files are. */
const whole = {hidden: [], section: null, region: null, t: 0};
const plain = {exposure: 0, toneMap: null};

export class ViewState {
  options: ViewOptions = {
    channel: 'color', mode: keptMode(), denoise: storage.getItem(denoiseKey) === 'true',
    ...whole, ...plain};

  constructor(private readonly changed: () => void) {}

  set(options: Partial<ViewOptions>): void {
    this.options = {...this.options, ...options};
    this.changed();
  }

  setMode(mode: string): void {
    storage.setItem(modeKey, mode);
    this.set({mode});
  }

  setDenoise(denoise: boolean): void {
    storage.setItem(denoiseKey, String(denoise));
    this.set({denoise});
  }

  /** Goes on to the next mode, and after the last to the first. */
  nextMode(): void {
    const index = modes.findIndex(([mode]) => mode === this.options.mode);
    this.setMode(modes[(index + 1) % modes.length]![0]);
  }

  isHidden(span: Span): boolean {
    return this.options.hidden.some(([from, to]) => from === span[0] && to === span[1]);
  }

  toggle(span: Span): void {
    const others = this.options.hidden.filter(([from, to]) => from !== span[0] || to !== span[1]);
    this.set({hidden: others.length < this.options.hidden.length ? others : [...others, span]});
  }

  /** Follows an edit. The text that goes to the server brings what is hidden with it. */
  follow(changes: ChangeDesc): void {
    const hidden = this.options.hidden
      .map(([from, to]): Span => [changes.mapPos(from, 1), changes.mapPos(to, -1)])
      .filter(([from, to]) => from < to);
    this.options = {...this.options, hidden};
  }

  /** Lets what is hidden be whole statements again, of which an edit may have moved the end. */
  fit(statements: Span[]): void {
    const hidden = this.options.hidden.map(([from, to]): Span =>
      statements.find((span) => span[0] === from) ?? [from, to]);
    if (hidden.some((span, i) => span[1] !== this.options.hidden[i]![1])) this.set({hidden});
  }

  /** Shows all of another script. */
  reset(): void {
    this.options = {...this.options, ...whole, ...plain};
  }
}
