// The smaller panels: the console, the queue of renders, and statistics.

import type {Scene, State} from './protocol';

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

const phases: Record<State['phase'], string> = {
  script: 'Running the script', preparing: 'Preparing', rendering: 'Rendering', done: 'Done',
  cancelled: 'Cancelled', failed: 'Not rendered'};

export class Queue {
  readonly element = document.createElement('div');
  private readonly title = document.createElement('b');
  private readonly bar = document.createElement('progress');
  private readonly detail = document.createElement('span');
  private readonly button = document.createElement('button');
  private isRunning = false;

  constructor(ask: (action: 'cancel' | 'restart') => void) {
    this.element.className = 'queue';
    this.bar.max = 1;
    this.bar.setAttribute('aria-label', 'Progress of the render');
    this.button.addEventListener('click', () => ask(this.isRunning ? 'cancel' : 'restart'));
    this.element.append(this.title, this.bar, this.detail, this.button);
    this.set({type: 'state', revision: 0, phase: 'done', progress: 0, seconds: 0, message: ''});
  }

  set(state: State): void {
    this.isRunning = ['script', 'preparing', 'rendering'].includes(state.phase);
    this.title.textContent = phases[state.phase];
    this.bar.value = state.progress;
    const left = state.progress > 0.02 ? state.seconds / state.progress - state.seconds : NaN;
    this.detail.textContent = state.message !== '' ? state.message :
      `${state.seconds.toFixed(2)} s` +
      (state.phase === 'rendering' && left > 0.5 ? `, about ${left.toFixed(0)} s left` : '');
    this.button.textContent = this.isRunning ? 'Cancel' : 'Render again';
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
