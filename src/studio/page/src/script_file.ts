// The script's file: what is opened, saved, kept until then, and written by other programs.

import {ask, endQuestion} from './question';
import {storage} from './storage';

/** Stands for no script in the list, whose names end in .crt. */
const another = 'another';

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
  /** Is called if there is no script to show. */
  hasNone(folder: string): void;
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
  private scripts: string[] = [];
  /** A script to begin with, which calls itself scene.crt. */
  beginning = '';

  constructor(private readonly host: ScriptHost) {
    this.list.setAttribute('aria-label', 'Script to open');
    this.list.addEventListener('change', () => {
      if (this.list.value === another) this.begin();
      else this.open(this.list.value);
    });
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
    if (this.hasText && !scripts.includes(this.name)) return this.host.resume();
    const name = (this.hasText && this.name) || script || scripts[0];
    if (name !== undefined) this.host.send({type: 'open', script: name, page: this.page});
    else this.host.hasNone(folder);
  }

  open(script: string): void {
    this.leave();
    this.name = '';
    this.page = newPageName();
    this.host.send({type: 'open', script, page: this.page});
  }

  /** Begins another script, which is in the folder once it is saved. */
  begin(): void {
    const name = this.askName();
    this.list.value = this.name;
    if (name === null) return;
    if (this.scripts.includes(name)) return this.open(name);
    this.leave();
    this.page = newPageName();
    this.take(name, '', storage.getItem(this.draftKey) ??
              this.beginning.replace('scene.crt', () => name));
    this.host.note(`${name} is in the folder once it is saved.`);
  }

  private askName(): string | null {
    const name = prompt(`Name of the new script in ${this.folder}`, 'scene.crt')?.trim() ?? '';
    if (name === '') return null;
    return name.endsWith('.crt') ? name : `${name}.crt`;
  }

  private leave(): void {
    endQuestion();
    if (this.hasText && this.name !== '' && this.isChanged)
      this.host.note(`What you typed into ${this.name} is not saved. This browser keeps it.`);
  }

  /** Shows a script of which the file has `saved`. */
  private take(name: string, saved: string, text: string): void {
    this.name = name;
    this.savedText = saved;
    this.hasText = true;
    this.listScripts(this.scripts);
    this.host.show(text);
  }

  /** `typed` is what was typed and not saved, as the server kept it. */
  opened(script: string, text: string, typed?: string): void {
    if (script === this.name && this.hasText) {  // the connection came back
      this.savedText = text;
      return this.host.resume();
    }
    this.name = script;
    const kept = storage.getItem(this.draftKey);
    this.take(script, text, kept ?? text);
    this.isInConflict = false;
    if (kept !== null && kept !== text) {
      ask(`What you typed into ${script} and did not save is here again.`, {
        'Go on with it': () => undefined,
        'Take the file': () => this.host.replace(text),
      });
    } else if (typed !== undefined) {
      this.offer(script, typed);
    }
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
    const name = this.name || this.askName();
    if (name === null) return;
    if (this.isInConflict && !force &&
        !confirm(`${name} was changed by another program. Write over it?`)) return;
    this.isInConflict = false;
    this.host.send({type: 'save', script: name, text: this.host.text(), force});
  }

  saved(script: string, scripts: string[]): void {
    endQuestion();
    storage.removeItem(this.draftKey);
    this.name = script;
    this.savedText = this.host.text();
    this.hasText = true;
    document.body.classList.remove('changed');
    this.listScripts(scripts);
    this.host.note(`Saved ${script}`);
  }

  /** Another program has written the file. What was typed here is replaced only if one says so. */
  changedOutside(script: string, text: string): void {
    if (script !== this.name) return;
    if (text === this.host.text() || !this.isChanged) {
      this.takeFile(text);
      return this.host.note(`${script} was changed by another program, and is shown so.`);
    }
    this.savedText = text;
    this.isInConflict = true;
    ask(`${script} was changed by another program, and here, too.`, {
      'Take the file': () => this.takeFile(text),
      'Keep what is here': () => { this.isInConflict = false; },
    });
  }

  private takeFile(text: string): void {
    this.isInConflict = false;
    this.savedText = text;
    this.host.replace(text);
  }

  private listScripts(scripts: string[]): void {
    this.scripts = scripts;
    const all = scripts.includes(this.name) || this.name === '' ? scripts : [this.name, ...scripts];
    this.list.replaceChildren(...all.map((script) => new Option(script, script)));
    if (this.folder !== '') this.list.append(new Option('New script…', another));
    this.list.value = this.name;
    document.title = this.name === '' ? 'CRT studio' : `${this.name} – CRT studio`;
  }
}
