// The smaller panels: the console and statistics.

import type {Scene} from './protocol';

const mostLines = 2000;

export class Console {
  readonly element = document.createElement('div');

  constructor() {
    this.element.className = 'console';
    this.element.setAttribute('role', 'log');
    this.element.tabIndex = 0;
  }

  add(text: string, kind: 'print' | 'note' | 'error' | 'warning' = 'note'): void {
    const isAtEnd =
      this.element.scrollTop + this.element.clientHeight >= this.element.scrollHeight - 4;
    const line = document.createElement('div');
    line.className = `line ${kind}`;
    line.textContent = text;
    this.element.append(line);
    while (this.element.childElementCount > mostLines) this.element.firstElementChild!.remove();
    if (isAtEnd) this.element.scrollTop = this.element.scrollHeight;
  }
}

export class Statistics {
  readonly element = document.createElement('div');
  private scene: Scene | null = null;
  private stats: Record<string, number> = {};

  constructor() {
    this.element.className = 'statistics';
  }

  setScene(scene: Scene): void {
    this.scene = scene;
    this.draw();
  }

  setStats(stats: Record<string, number>): void {
    this.stats = stats;
    this.draw();
  }

  private draw(): void {
    const scene = this.scene;
    const rows: [string, number | string][] = scene === null ? [] : [
      ['picture', `${scene.width} × ${scene.height}`], ['entities', scene.entities],
      ['primitives', scene.primitives], ['lights', scene.lights],
      ['bytes of the scene', scene.memory]];
    rows.push(...Object.entries(this.stats).filter(([name]) => name !== 'bytes of memory'));
    const table = document.createElement('table');
    for (const [name, value] of rows) {
      const row = table.insertRow();
      const head = document.createElement('th');
      head.scope = 'row';
      head.textContent = name;
      row.append(head);
      row.insertCell().textContent = typeof value === 'number'
        ? value.toLocaleString('en', {maximumFractionDigits: 3}) : value;
    }
    this.element.replaceChildren(table);
  }
}
