// The render that runs: how far it is, and how busy the machine is.

import {button} from './dom';
import type {Machine, State} from './protocol';

const phases: Record<State['phase'], string> = {
  script: 'Running the script', preparing: 'Preparing', rendering: 'Rendering', done: 'Done',
  cancelled: 'Cancelled', failed: 'Not rendered'};

export class Queue {
  readonly element = document.createElement('div');
  private readonly title = document.createElement('b');
  private readonly bar = document.createElement('progress');
  private readonly detail = document.createElement('span');
  private readonly button: HTMLButtonElement;
  private readonly machine = document.createElement('span');
  /** Is how long the render has taken. */
  seconds = 0;
  /** Says in short what is done now. */
  summary = '';
  private isRunning = false;

  constructor(ask: (action: 'cancel' | 'restart') => void, trade: HTMLElement) {
    this.element.className = 'queue';
    this.bar.max = 1;
    this.bar.setAttribute('aria-label', 'Progress of the render');
    this.button = button('', '', () => ask(this.isRunning ? 'cancel' : 'restart'));
    this.machine.className = 'machine';
    this.element.append(this.title, this.bar, this.detail, this.button, trade,
                        this.machine);
    this.set({type: 'state', revision: 0, phase: 'done', progress: 0, seconds: 0, message: ''});
  }

  set(state: State): void {
    this.isRunning = ['script', 'preparing', 'rendering'].includes(state.phase);
    this.seconds = state.seconds;
    this.title.textContent = phases[state.phase];
    this.bar.value = state.progress;
    const left = state.progress > 0.02 ? state.seconds / state.progress - state.seconds : NaN;
    this.detail.textContent = state.message !== '' ? state.message :
      `${state.seconds.toFixed(2)} s` +
      (state.phase === 'rendering' && left > 0.5 ? `, about ${left.toFixed(0)} s left` : '');
    this.button.textContent = this.isRunning ? 'Cancel' : 'Render again';
    const share = this.isRunning && state.progress > 0
      ? ` ${Math.floor(100 * state.progress)} %,` : '';
    this.summary = state.phase === 'failed' ? phases.failed :
      `${phases[state.phase]}${share} ${state.phase === 'done' ? 'in ' : ''}${this.detail.textContent}`;
  }

  setMachine(machine: Machine): void {
    const gibibytes = (bytes: number) => `${(bytes / 2 ** 30).toFixed(1)} GiB`;
    const mebibytes = (bytes: number) => `${(bytes / 2 ** 20).toFixed(0)} MiB`;
    const {load, freeMemory, memory, studioMemory} = machine;
    const parts = [`${machine.cores} cores`];
    if (load !== undefined) parts.push(`load ${load.toFixed(1)}`);
    if (freeMemory !== undefined && memory !== undefined)
      parts.push(`memory: ${gibibytes(freeMemory)} of ${gibibytes(memory)} free`);
    if (studioMemory !== undefined) parts.push(`the studio has ${mebibytes(studioMemory)}`);
    this.machine.textContent = parts.join(', ');
  }
}
