// How light is shown: brighter or darker, by which curve, and without its noise.

import {choice, input, labelled} from './dom';
import {numberText} from './numbers';
import type {ViewOptions} from './protocol';

const toneMaps = [
  ['', 'Script’s tone map'], ['none', 'No tone map'], ['filmic', 'Filmic']] as const;
const usualStops = 6;

export class DisplayControls {
  readonly element = document.createElement('span');
  private readonly slider = input('range', 'Exposure', '0', (field) =>
    this.setExposure(field.valueAsNumber));
  private readonly field = input('number', 'Exposure in stops', '0', (field) => {
    if (Number.isFinite(field.valueAsNumber)) this.setExposure(field.valueAsNumber);
  });
  private readonly toneMap = choice('Tone map', toneMaps, (name) =>
    this.take({toneMap: name === '' ? null : name}));
  private readonly denoise = input('checkbox', 'Denoise', '', (field) =>
    this.keepDenoise(field.checked));

  constructor(private readonly take: (options: Partial<ViewOptions>) => void,
              private readonly keepDenoise: (isWanted: boolean) => void) {
    this.element.className = 'group';
    this.slider.min = String(-usualStops);
    this.slider.max = String(usualStops);
    this.slider.step = '0.1';
    for (const control of [this.slider, this.field])
      control.title = 'Show the picture brighter or darker, in stops beside those of the script. ' +
        'A double click shows it as the script says';
    this.slider.addEventListener('dblclick', () => this.setExposure(0));
    this.toneMap.title = 'Show bright light by another curve';
    const denoise = labelled('Denoise');
    denoise.title = 'Smooth the noise of few samples away, in the view alone. Nothing is claimed of ' +
      'the error of such a picture';
    denoise.prepend(this.denoise);
    this.element.append('Exposure', this.slider, this.field, this.toneMap, denoise);
  }

  private setExposure(exposure: number): void {
    this.take({exposure});
  }

  /** Shows what is in effect. */
  update({exposure, toneMap, denoise}: ViewOptions): void {
    this.slider.value = String(exposure);
    if (this.field.valueAsNumber !== exposure) this.field.value = numberText(exposure);
    this.toneMap.value = toneMap ?? '';
    this.denoise.checked = denoise;
  }
}
