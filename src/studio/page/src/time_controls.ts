// The controls of time: the frame `t` that is shown, and playing.

import {button, input} from './dom';
import {numberText} from './numbers';

const framesASecond = 24;
const usualLast = 100;

export class TimeControls {
  readonly element = document.createElement('span');
  private readonly slider = input('range', 'Frame t', '0', (field) =>
    this.show(field.valueAsNumber));
  private readonly field = input('number', 'Frame t as a number', '0', (field) => {
    if (Number.isFinite(field.valueAsNumber)) this.show(field.valueAsNumber);
  });
  private readonly last = input('number', 'Last frame', String(usualLast), (field) => {
    if (field.valueAsNumber >= 1) this.slider.max = String(Math.round(field.valueAsNumber));
  });
  private readonly play = button('', 'Play the frames one after the other', () =>
    this.isPlaying ? this.stop() : this.start());
  private timer: ReturnType<typeof setInterval> | undefined;
  private shownAtLast = -1;
  private t = 0;
  private frames = 0;

  /** `countShown` counts the pictures that were shown: a frame stays until one of it has been. */
  constructor(private readonly take: (t: number) => void,
              private readonly countShown: () => number) {
    this.element.className = 'group';
    this.slider.max = String(usualLast);
    this.slider.step = '1';
    this.element.append(this.play, 't', this.slider, this.field, 'of', this.last);
    this.stop();
    this.setUsed(false);
  }

  /** Shows the controls for scripts that read `t`. */
  setUsed(isUsed: boolean): void {
    this.element.hidden = !isUsed;
    if (!isUsed) this.stop();
  }

  /** Takes how many frames the script says that there are. With 0 the last one stays as it is. */
  setFrames(frames: number): void {
    if (frames === this.frames) return;
    this.frames = frames;
    this.last.value = this.slider.max = String(frames > 0 ? frames - 1 : usualLast);
  }

  reset(): void {
    this.stop();
    this.t = 0;
    this.slider.value = this.field.value = '0';
  }

  private get isPlaying(): boolean {
    return this.timer !== undefined;
  }

  private start(): void {
    this.play.className = 'pause';
    this.play.setAttribute('aria-label', 'Pause');
    this.shownAtLast = -1;
    this.timer = setInterval(() => this.step(), 1000 / framesASecond);
  }

  private stop(): void {
    clearInterval(this.timer);
    this.timer = undefined;
    this.play.className = 'play';
    this.play.setAttribute('aria-label', 'Play');
  }

  private step(): void {
    const shown = this.countShown();
    if (shown === this.shownAtLast) return;
    this.shownAtLast = shown;
    this.show(this.t + 1 > Number(this.slider.max) ? 0 : this.t + 1);
  }

  private show(t: number): void {
    this.t = t;
    this.slider.value = String(t);
    if (document.activeElement !== this.field) this.field.value = numberText(t);
    this.take(t);
  }
}
