// A list that copies the scene, or the entity that is selected, as source code.

import type {Code, Span} from './protocol';

export interface CopyHost {
  /** Asks for source code: of the scene, or of what comes from a piece of the text. */
  ask(language: string, span: Span | null): Promise<Code | null>;
  selected(): Span | null;
  note(text: string, kind: 'note' | 'warning'): void;
}

const languages = [['cpp', 'C++'], ['python', 'Python'], ['c', 'C'], ['script', 'a script']] as const;
const endings: Record<string, string> = {cpp: 'cpp', python: 'py', c: 'c', script: 'crt'};

export function makeCopyList(host: CopyHost): HTMLSelectElement {
  const list = document.createElement('select');
  list.setAttribute('aria-label', 'Copy as source code');
  list.title = 'Copy as source code that makes the same';
  list.append(new Option('Copy as…', ''));
  for (const [of, title] of [['entity', 'Selected entity'], ['scene', 'Whole scene']] as const) {
    const group = document.createElement('optgroup');
    group.label = title;
    group.append(...languages.map(([language, name]) => new Option(name, `${of} ${language}`)));
    list.append(group);
  }
  list.addEventListener('change', () => {
    const [of, language] = list.value.split(' ');
    list.value = '';
    if (language) void copy(host, language, of === 'entity');
  });
  return list;
}

async function copy(host: CopyHost, language: string, isEntity: boolean): Promise<void> {
  const span = isEntity ? host.selected() : null;
  if (isEntity && !span) return host.note('Nothing is selected.', 'warning');
  const code = await host.ask(language, span);
  if (!code) return;  // the server has said why
  for (const warning of code.warnings) host.note(warning, 'warning');
  const name = languages.find(([key]) => key === language)![1];
  const what = isEntity ? 'The entity' : 'The scene';
  try {
    await navigator.clipboard.writeText(code.text);
    host.note(`${what} is in the clipboard, as ${name}.`, 'note');
  } catch {  // a frame in another page may not write there
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([code.text]));
    link.download = `${isEntity ? 'entity' : 'scene'}.${endings[language]}`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
    host.note(`${what} is saved as ${name}: the browser keeps the clipboard from us.`, 'note');
  }
}
