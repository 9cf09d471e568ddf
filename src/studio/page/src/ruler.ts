// The distance between two places that are clicked in the picture.

import type {Overlay} from './overlay';
import type {Vector} from './protocol';

export class Ruler {
  private places: Vector[] = [];
  private isOn = false;

  /** Takes what shows how far apart the places are, as a text. */
  constructor(private readonly overlay: Overlay, private readonly show: (text: string) => void,
              private readonly unit: () => string) {}

  get isUsed(): boolean {
    return this.isOn;
  }

  use(isOn: boolean): void {
    this.isOn = isOn;
    this.clear();
  }

  /** Takes the next place. A third one begins anew. */
  add(place: Vector): void {
    if (this.places.length === 2) this.places = [];
    this.places.push(place);
    const [a, b] = this.places;
    const text = a && b ? `${this.distance(a, b)} ${this.unit()}` : '';
    this.overlay.setRuler(this.places, text);
    this.show(text === '' ? 'Click the other place.' : `Distance: ${text}`);
  }

  clear(): void {
    this.places = [];
    this.overlay.setRuler([], '');
  }

  private distance(a: Vector, b: Vector): string {
    const length = Math.hypot(...a.map((x, i) => x - b[i]!));
    return String(Number(length.toPrecision(6)));
  }
}
