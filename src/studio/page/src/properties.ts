// The property sheet of an object. What it changes is the text of the script, where a value stands
// there as it is. What is computed can be seen and not changed, and says why.

import {apertureSpots} from './aperture';
import {numberText, stringText, vectorText} from './numbers';
import type {Attribute, AttributeDescription, ObjectDescription, TreeNode} from './protocol';
import {markdown} from './markdown';
import {ranges} from './property_ranges';

export interface SheetHost {
  /** Is called before the edits of a gesture. */
  begin(): void;
  edit(changes: {from: number; to: number; insert: string}[]): void;
  select(span: [number, number]): void;
  textOf(span: [number, number]): string;
  /** Returns a picture of a ball of the material of an object, as an address, or null. */
  ballOf(node: TreeNode): Promise<string | null>;
}

/** A drag of a pixel changes a number by such a share of it. */
const dragShare = 0.01;
/** The ball of a material waits for such a pause in typing. */
const ballMilliseconds = 100;

export class PropertySheet {
  /** For tests: what is known of attributes beside what the server says. */
  static readonly known = {ranges};
  readonly element = document.createElement('div');
  /** Has what the sheet shows of the object, beside what stands below it. */
  private readonly content = document.createElement('div');
  private objects = new Map<string, ObjectDescription>();
  private node: TreeNode | null = null;
  private readonly ball = document.createElement('img');
  private ballTimer: ReturnType<typeof setTimeout> | undefined;
  /** While a gesture or a field has the attention, the sheet is not made anew. */
  private isBusy = false;

  constructor(private readonly host: SheetHost) {
    this.element.className = 'sheet';
    this.element.append(this.content);
    this.ball.className = 'ball';
    this.ball.alt = 'A ball of the material';
    this.show(null);
  }

  describe(objects: ObjectDescription[]): void {
    this.objects = new Map(objects.map((object) => [object.name, object]));
  }

  show(node: TreeNode | null): void {
    const isSame = node !== null && this.node !== null && node.name === this.node.name &&
      node.span[0] === this.node.span[0] &&
      node.attributes.length === this.node.attributes.length;
    this.node = node;
    clearTimeout(this.ballTimer);
    if (node) this.ballTimer = setTimeout(() => void this.drawBall(node), ballMilliseconds);
    const focused = this.element.contains(document.activeElement);
    if (isSame && (this.isBusy || focused)) return;
    this.draw();
  }

  private async drawBall(node: TreeNode): Promise<void> {
    const address = await this.host.ballOf(node);
    if (this.node !== node) return;
    this.ball.hidden = address === null;
    if (address !== null) this.ball.src = address;
  }

  private draw(): void {
    const node = this.node;
    if (!node) {
      const hint = document.createElement('p');
      hint.className = 'hint';
      hint.textContent = 'Click something in the picture, in the tree or in the script.';
      this.content.replaceChildren(hint);
      return;
    }
    const heading = document.createElement('h2');
    heading.textContent = node.base === undefined ? node.name :
      node.base === node.name ? `A copy of ${node.base}` : `${node.name}, a copy of ${node.base}`;
    this.ball.hidden = true;
    const head = document.createElement('header');
    head.append(heading, this.ball);
    const rows: HTMLElement[] = [head];
    const given = new Map(node.attributes.map((attribute) => [attribute.name, attribute]));
    const inherited = new Map(node.inherited?.map((attribute) => [attribute.name, attribute]));
    for (const description of this.descriptionsOf(node)) {
      const attribute = given.get(description.name) ?? inherited.get(description.name);
      const row = document.createElement('div');
      row.className = 'property';
      const label = document.createElement('label');
      label.textContent = description.name;
      label.title = `${description.name}: ${description.type}` +
        (description.required ? ', required' : '');
      const value = document.createElement('div');
      value.className = 'value';
      if (attribute) {
        value.append(...this.editors(attribute, label));
        if (!given.has(description.name)) {
          row.classList.add('inherited');
          label.title += `, as ${node.base} has it: a change is of this copy alone`;
        }
      } else {
        row.classList.add('absent');
        value.append(this.absent(description.name, description.default));
      }
      row.append(label, value);
      if (description.about !== '') {
        const about = document.createElement('details');
        const summary = document.createElement('summary');
        summary.title = `About ${description.name}`;
        summary.setAttribute('aria-label', summary.title);
        about.append(summary, markdown(description.about));
        row.append(about);
      }
      rows.push(row);
    }
    this.content.replaceChildren(...rows);
  }

  /** Lists what an object of the language may have, and of others what they have. */
  private descriptionsOf(node: TreeNode): AttributeDescription[] {
    return this.objects.get(node.name)?.attributes ?? node.attributes.map(({name}) =>
      ({name, type: '', required: false, default: '', about: ''}));
  }

  /** Finds the attribute as the newest tree has it: its place moves with the text. */
  private current(name: string): Attribute | undefined {
    return this.node?.attributes.find((attribute) => attribute.name === name);
  }

  private write(name: string, text: string): void {
    const attribute = this.current(name);
    if (!attribute) return this.override(name, text);
    if (attribute.literal === 'none') return;
    this.host.edit([{from: attribute.span[0], to: attribute.span[1], insert: text}]);
    // Until the next tree comes, the places are those that this edit makes.
    const growth = text.length - (attribute.span[1] - attribute.span[0]);
    attribute.span = [attribute.span[0], attribute.span[1] + growth];
    this.node!.span = [this.node!.span[0], this.node!.span[1] + growth];
    for (const other of this.node!.attributes) {
      if (other.span[0] > attribute.span[0])
        other.span = [other.span[0] + growth, other.span[1] + growth];
    }
  }

  /** Gives a derived material a value of its own. */
  private override(name: string, text: string): void {
    const inherited = this.node?.inherited?.find((attribute) => attribute.name === name);
    if (!inherited || inherited.literal === 'none') return;
    const [begin, end] = this.insert(name, text);
    // Until the next tree comes, this is what it will have.
    this.node!.attributes.push({...inherited, nameSpan: [begin, begin + name.length],
                                span: [end - text.length, end]});
  }

  /** Writes another attribute behind the last one. Returns its place. */
  private insert(name: string, text: string): [number, number] {
    const node = this.node!;
    const last = node.attributes.at(-1);
    const place = last ? last.span[1] : node.span[1] - 1;
    const before = this.host.textOf(node.span).includes('\n') ? '\n    ' : ' ';
    const written = `${name} -> ${text}`;
    this.host.edit([{from: place, to: place, insert: before + written}]);
    node.span = [node.span[0], node.span[1] + before.length + written.length];
    const begin = place + before.length;
    return [begin, begin + written.length];
  }

  private editors(attribute: Attribute, label: HTMLLabelElement): Element[] {
    const numbers = attribute.numbers ?? [];
    switch (attribute.literal) {
      case 'number': {
        const field = this.numberField(attribute.name, numbers[0]!, (value) =>
          this.write(attribute.name, numberText(value)));
        this.makeDraggable(label, field);
        return [field, ...this.slider(attribute.name, field)];
      }
      case 'boolean': {
        const box = this.input('checkbox', attribute.name);
        box.checked = numbers[0] === 1;
        box.addEventListener('change', () =>
          this.write(attribute.name, box.checked ? 'true' : 'false'));
        return [box];
      }
      case 'string': {
        const texts = this.choices(attribute.name);
        if (texts?.includes(attribute.text ?? '')) return this.list(attribute, texts);
        const field = this.input('text', attribute.name);
        field.value = attribute.text ?? '';
        field.addEventListener('input', () =>
          this.write(attribute.name, stringText(field.value)));
        return [field];
      }
      case 'vector':
      case 'color':
        return this.vectorFields(attribute, numbers);
      case 'none': {
        const value = document.createElement('button');
        value.className = 'computed';
        const isInherited = attribute.written !== undefined;
        value.textContent = (attribute.written ?? this.host.textOf(attribute.span)).slice(0, 60);
        value.title = `Not changed here: it is ${attribute.reason ?? 'computed'}`;
        value.disabled = isInherited;
        if (!isInherited) value.addEventListener('click', () => this.host.select(attribute.span));
        return [value];
      }
    }
  }

  /** Returns the texts that an attribute takes, if it takes only some. */
  private choices(name: string): string[] | undefined {
    const attributes = this.objects.get(this.node!.name)?.attributes;
    return attributes?.find((attribute) => attribute.name === name)?.choices;
  }

  /** Makes a list of texts, and shows the lens if they are its shapes. */
  private list(attribute: Attribute, texts: readonly string[]): Element[] {
    const list = document.createElement('select');
    list.setAttribute('aria-label', attribute.name);
    list.append(...texts.map((text) => new Option(text)));
    list.value = attribute.text!;
    const isLens = attribute.name === 'apertureshape';
    const spots = document.createElement('span');
    const show = () => isLens && spots.replaceChildren(apertureSpots(list.value));
    list.addEventListener('focus', () => this.host.begin());
    list.addEventListener('change', () => {
      this.write(attribute.name, stringText(list.value));
      show();
    });
    show();
    return isLens ? [list, spots] : [list];
  }

  /** Makes a slider beside the field of a number that has a usual range. */
  private slider(name: string, field: HTMLInputElement): HTMLInputElement[] {
    const range = ranges[`${this.node!.name}.${name}`];
    if (!range) return [];
    const slider = this.input('range', `${name} as a slider`);
    slider.min = String(range.low);
    slider.max = String(range.high);
    slider.step = String(range.step);
    slider.value = field.value;
    slider.addEventListener('input', () => {
      field.value = slider.value;
      field.dispatchEvent(new Event('input'));
    });
    field.addEventListener('input', () => { slider.value = field.value; });
    return [slider];
  }

  private vectorFields(attribute: Attribute, numbers: number[]): HTMLElement[] {
    const values = [...numbers];
    const isColor = attribute.literal === 'color';
    const constructor = isColor ? (values.length === 4 ? 'rgba' : 'rgb') : 'vec3';
    const write = () => this.write(attribute.name, vectorText(constructor, values));
    const names = isColor ? ['red', 'green', 'blue', 'alpha'] : ['x', 'y', 'z'];
    const fields = values.map((value, index) =>
      this.numberField(`${attribute.name} ${names[index]}`, value, (changed) => {
        values[index] = changed;
        write();
      }));
    if (!isColor) return fields;
    const picker = this.input('color', `${attribute.name} as a colour`);
    // Lights are brighter than a screen. What is picked then has the brightness that there is.
    const brightness = Math.max(1, ...values.slice(0, 3));
    const byte = (value: number) =>
      Math.round(255 * Math.max(0, Math.min(1, value / brightness)));
    picker.value = '#' + values.slice(0, 3).map((v) => byte(v).toString(16).padStart(2, '0')).join('');
    picker.addEventListener('input', () => {
      for (let i = 0; i < 3; ++i) {
        const share = parseInt(picker.value.slice(1 + 2 * i, 3 + 2 * i), 16) / 255;
        values[i] = Number((brightness * share).toFixed(3));
        fields[i]!.value = numberText(values[i]!);
      }
      write();
    });
    return [picker, ...fields];
  }

  private input(type: string, label: string): HTMLInputElement {
    const field = document.createElement('input');
    field.addEventListener('focus', () => this.host.begin());
    field.type = type;
    field.setAttribute('aria-label', label);
    return field;
  }

  private numberField(label: string, value: number, take: (value: number) => void) {
    const field = this.input('number', label);
    field.step = 'any';
    field.value = numberText(value);
    field.addEventListener('input', () => {
      if (field.value !== '' && Number.isFinite(field.valueAsNumber)) take(field.valueAsNumber);
    });
    return field;
  }

  /** Lets the name of a number be dragged to change it. */
  private makeDraggable(label: HTMLLabelElement, field: HTMLInputElement): void {
    label.classList.add('draggable');
    label.addEventListener('pointerdown', (event) => {
      event.preventDefault();
      label.setPointerCapture(event.pointerId);
      this.isBusy = true;
      this.host.begin();
      const start = field.valueAsNumber;
      const isWhole = Number.isInteger(start) && Math.abs(start) >= 10;
      const rate = Math.max(Math.abs(start), 1e-3) * dragShare;
      const move = (moved: PointerEvent) => {
        const value = start + (moved.clientX - event.clientX) * rate;
        field.value = numberText(isWhole ? Math.round(value) : Number(value.toPrecision(4)));
        field.dispatchEvent(new Event('input'));
      };
      label.addEventListener('pointermove', move);
      label.addEventListener('lostpointercapture', () => {
        label.removeEventListener('pointermove', move);
        this.isBusy = false;
      }, {once: true});
    });
  }

  private absent(name: string, defaultText: string): HTMLElement {
    const canBeAdded = /^(-?[\d.]+|true|false|(vec3|rgba?)\([-\d., ]+\)|"[^"]*")$/.test(defaultText);
    if (!canBeAdded) {
      const value = document.createElement('span');
      value.className = 'default';
      value.textContent = defaultText === '' ? 'not given' : defaultText;
      return value;
    }
    const button = document.createElement('button');
    button.className = 'default';
    button.textContent = defaultText;
    button.title = `Write ${name} into the script`;
    // The newest tree counts: it may have come without the sheet being made anew.
    button.addEventListener('click', () => this.insert(name, defaultText));
    return button;
  }
}
