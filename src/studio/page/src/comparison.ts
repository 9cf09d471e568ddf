// A comparison of the picture with an earlier one that was kept. A slider moves the line between.

import {button, input} from './dom';

export class Comparison {
  readonly controls = document.createElement('span');
  private readonly kept = document.createElement('canvas');
  private readonly line = document.createElement('div');
  private readonly slider: HTMLInputElement;

  /** Takes the picture, and the frame around it that the kept one is laid into. */
  constructor(private readonly picture: HTMLCanvasElement, private readonly frame: HTMLElement) {
    this.kept.className = 'kept';
    this.kept.setAttribute('aria-hidden', 'true');
    this.line.className = 'divider';
    this.slider = input('range', 'Line between the kept picture and this one', '50',
                        () => this.divide());
    this.slider.title = 'On the left is the kept picture, on the right this one';
    this.controls.className = 'group';
    this.end();
  }

  private keep(): void {
    this.kept.width = this.picture.width;
    this.kept.height = this.picture.height;
    this.kept.getContext('2d')!.drawImage(this.picture, 0, 0);
    this.frame.append(this.kept, this.line);
    this.controls.replaceChildren(
      'A', this.slider, 'B', button('End', 'Show this picture alone', () => this.end()));
    this.divide();
  }

  private end(): void {
    this.kept.remove();
    this.line.remove();
    this.controls.replaceChildren(button(
      'Compare', 'Keep this picture, and compare later ones with it', () => this.keep()));
  }

  private divide(): void {
    this.line.style.left = `${this.slider.value}%`;
    this.kept.style.clipPath = `inset(0 ${100 - this.slider.valueAsNumber}% 0 0)`;
  }
}
