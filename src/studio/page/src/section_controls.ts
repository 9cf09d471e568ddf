// The controls of the section: a plane that takes away what lies on one side of it.

import {choice, input, labelled} from './dom';
import {numberText} from './numbers';
import type {Box, SectionPlane, Vector} from './protocol';

const steps = 200;
/** Without any box that ends the plane moves so far. */
const usualReach = 5;

/** Returns where boxes begin and end along an axis. */
function reach(boxes: Box[], axis: number): [number, number] {
  const ends = boxes.map((box) => [box.lower[axis], box.upper[axis]])
    .filter((pair): pair is [number, number] => pair.every((end) => typeof end === 'number'));
  if (ends.length === 0) return [-usualReach, usualReach];
  return [Math.min(...ends.map(([low]) => low)), Math.max(...ends.map(([, high]) => high))];
}

export class SectionControls {
  readonly element = document.createElement('span');
  private section: SectionPlane | null = null;
  private readonly axis = choice('Section across', [
    ['', 'No section'], ['0', 'Section across x'], ['1', 'Section across y'],
    ['2', 'Section across z']], (value) => void this.choose(value));
  private readonly slider = input('range', 'Place of the section', '0', (field) =>
    this.move(field.valueAsNumber));
  private readonly field = input('number', 'Place of the section as a number', '0', (field) => {
    if (Number.isFinite(field.valueAsNumber)) this.move(field.valueAsNumber);
  });
  private readonly flip = input('checkbox', 'Flip', '', (field) => {
    if (this.section) this.set({...this.section, isFlipped: field.checked});
  });
  private readonly side = labelled('Flip');

  /**
   * `askBoxes` asks for the boxes of what can be cut, which the slider goes through. `viewer` says
   * where the camera is: its side is taken away at first.
   */
  constructor(private readonly take: (section: SectionPlane | null) => void,
              private readonly askBoxes: () => Promise<Box[]>,
              private readonly viewer: () => Vector) {
    this.element.className = 'group';
    this.side.title = 'Take away the other side';
    this.side.prepend(this.flip);
    this.draw();
  }

  reset(): void {
    this.section = null;
    this.axis.value = '';
    this.draw();
  }

  private async choose(value: string): Promise<void> {
    if (value === '') {
      this.set(null);
    } else {
      const axis = Number(value);
      const [low, high] = reach(await this.askBoxes(), axis);
      this.slider.min = String(low);
      this.slider.max = String(high);
      this.slider.step = String((high - low) / steps || 1);
      const offset = Number(numberText((low + high) / 2));
      this.flip.checked = this.viewer()[axis]! < offset;
      this.set({axis, offset, isFlipped: this.flip.checked});
    }
    this.draw();
  }

  private move(offset: number): void {
    if (this.section) this.set({...this.section, offset});
  }

  private set(section: SectionPlane | null): void {
    this.section = section;
    if (section) {
      const text = numberText(section.offset);
      if (document.activeElement !== this.field) this.field.value = text;
      this.slider.value = text;
    }
    this.take(section);
  }

  private draw(): void {
    this.element.replaceChildren(
      this.axis, ...(this.section ? [this.slider, this.field, this.side] : []));
  }
}
