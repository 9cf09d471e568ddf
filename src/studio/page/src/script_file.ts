// The script's file: what is opened, saved, kept until then, and written by other programs.

import {ask} from './question';
import {storage} from './storage';

export interface ScriptHost {
  send(message: Record<string, unknown>): void;
  text(): string;
  /** Shows another text, without a way back. */
  show(text: string): void;
  /** Makes the text another one by an edit, which can be undone. */
  replace(text: string): void;
  /** Is called when a lost connection has come back. */
  resume(): void;
  note(text: string): void;
}

/** Nobody else's name, which also browsers can make that came by plain HTTP. */
function newPageName(): string {
  const numbers = crypto.getRandomValues(new Uint32Array(2));
  return Array.from(numbers, (number) => number.toString(16)).join('');
}

export class ScriptFile {
  readonly list = document.createElement('select');
  name = '';
  private folder = '';
  private savedText = '';
  private hasText = false;
  /** The server keeps what is typed under this name. */
  private page = newPageName();
  /** The file was changed by another program, and what is to become of it was not answered. */
  private isInConflict = false;

  constructor(private readonly host: ScriptHost) {
    this.list.setAttribute('aria-label', 'Script to open');
    this.list.addEventListener('change', () => this.open(this.list.value));
  }

  get isChanged(): boolean {
    return this.host.text() !== this.savedText;
  }

  private get draftKey(): string {
    return `crt-studio:text:${this.folder}/${this.name}`;
  }

  /** Opens the script that the server names, or the first one. */
  start(folder: string, script: string, scripts: string[]): void {
    this.folder = folder;
    this.listScripts(scripts);
    // After a lost connection the server gets what was typed meanwhile.
    const name = (this.hasText && this.name) || script || scripts[0];
    if (name !== undefined) this.host.send({type: 'open', script: name, page: this.page});
  }

  open(script: string): void {
    if (this.isChanged && this.hasText &&
        !confirm('The script has changes that are not saved. They are kept in this browser.')) {
      this.list.value = this.name;
      return;
    }
    this.name = '';
    this.page = newPageName();
    this.host.send({type: 'open', script, page: this.page});
  }

  /** `typed` is what was typed and not saved, as the server kept it. */
  opened(script: string, text: string, typed?: string): void {
    if (script === this.name && this.hasText) {  // the connection came back
      this.savedText = text;
      return this.host.resume();
    }
    this.name = script;
    this.list.value = script;
    document.title = `${script} – CRT studio`;
    const kept = storage.getItem(this.draftKey);
    this.savedText = text;
    this.hasText = true;
    this.isInConflict = false;
    this.host.show(kept ?? text);
    if (kept !== null && kept !== text)
      this.host.note('What you had typed and not saved is here again.');
    if (typed !== undefined && typed !== kept) this.offer(script, typed);
  }

  private offer(script: string, typed: string): void {
    ask(`What was typed into ${script} and not saved was kept.`, {
      'Go on with it': () => this.host.replace(typed),
      'Discard it': () => this.host.send({type: 'forget', script}),
    });
  }

  /** Keeps each new text in the browser until it is saved. */
  keep(text: string): void {
    document.body.classList.toggle('changed', this.isChanged);
    if (this.isChanged) storage.setItem(this.draftKey, text);
    else storage.removeItem(this.draftKey);
  }

  save(force: boolean): void {
    if (this.name === '') return;
    if (this.isInConflict && !force &&
        !confirm(`${this.name} was changed by another program. Write over it?`)) return;
    this.isInConflict = false;
    this.host.send({type: 'save', script: this.name, text: this.host.text(), force});
  }

  saved(script: string, scripts: string[]): void {
    this.savedText = this.host.text();
    storage.removeItem(this.draftKey);
    document.body.classList.remove('changed');
    this.listScripts(scripts);
    this.host.note(`Saved ${script}`);
  }

  /** Another program has written the file. What was typed here is replaced only if one says so. */
  changedOutside(script: string, text: string): void {
    if (script !== this.name) return;
    if (text === this.host.text() || !this.isChanged) {
      this.take(text);
      return this.host.note(`${script} was changed by another program, and is shown so.`);
    }
    this.savedText = text;
    this.isInConflict = true;
    ask(`${script} was changed by another program, and here, too.`, {
      'Take the file': () => this.take(text),
      'Keep what is here': () => { this.isInConflict = false; },
    });
  }

  private take(text: string): void {
    this.isInConflict = false;
    this.savedText = text;
    this.host.replace(text);
  }

  private listScripts(scripts: string[]): void {
    this.list.replaceChildren(...scripts.map((script) => new Option(script, script)));
    this.list.value = this.name;
  }
}
