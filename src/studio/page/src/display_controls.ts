// How light is shown: brighter or darker, and by which curve. Nothing is rendered again for it.

import {choice, input} from './dom';
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

  constructor(private readonly take: (options: Partial<ViewOptions>) => void) {
    this.element.className = 'group';
    this.slider.min = String(-usualStops);
    this.slider.max = String(usualStops);
    this.slider.step = '0.1';
    for (const control of [this.slider, this.field])
      control.title = 'Show the picture brighter or darker, in stops beside those of the script. ' +
        'A double click shows it as the script says';
    this.slider.addEventListener('dblclick', () => this.setExposure(0));
    this.toneMap.title = 'Show bright light by another curve';
    this.element.append('Exposure', this.slider, this.field, this.toneMap);
  }

  private setExposure(exposure: number): void {
    this.take({exposure});
  }

  /** Shows what is in effect. */
  update({exposure, toneMap}: ViewOptions): void {
    this.slider.value = String(exposure);
    if (this.field.valueAsNumber !== exposure) this.field.value = numberText(exposure);
    this.toneMap.value = toneMap ?? '';
  }
}
