// A list that saves the solids of the scene, or the entity that is selected, as triangles.

import {input} from './dom';
import type {Span} from './protocol';

export interface ExportHost {
  /** Asks for a file, which comes by itself. Says whether it was made: null if it cannot be. */
  ask(format: string, deviation: number, span: Span | null): Promise<boolean | null>;
  selected(): Span | null;
  note(text: string, kind: 'note' | 'warning'): void;
}

const formats = [['stl', 'STL'], ['3mf', '3MF'], ['obj', 'OBJ'], ['ply', 'PLY'], ['glb', 'glTF']] as
  const;

export function makeExportList(host: ExportHost): HTMLElement {
  const group = document.createElement('span');
  group.className = 'export';
  const list = document.createElement('select');
  list.setAttribute('aria-label', 'Save as triangles');
  list.title = 'Save the surfaces of solids as triangles';
  list.append(new Option('Triangles…', ''));
  for (const [of, title] of [['scene', 'Whole scene'], ['entity', 'Selected entity']] as const) {
    const choices = document.createElement('optgroup');
    choices.label = title;
    choices.append(...formats.map(([format, name]) => new Option(name, `${of} ${format}`)));
    list.append(choices);
  }
  const deviation = input('number', 'Deviation of triangles', '', () => undefined);
  deviation.min = '0';
  deviation.placeholder = 'deviation';
  deviation.title = 'How far triangles may be from the surface, in scene units: by default a ' +
    'thousandth of the longest side';
  list.addEventListener('change', () => {
    const [of, format] = list.value.split(' ');
    list.value = '';
    if (format) void save(host, format, Number(deviation.value), of === 'entity');
  });
  group.append(list, deviation);
  return group;
}

async function save(host: ExportHost, format: string, deviation: number,
                    isEntity: boolean): Promise<void> {
  const span = isEntity ? host.selected() : null;
  if (isEntity && !span) return host.note('Nothing is selected.', 'warning');
  host.note('Triangles are being made.', 'note');
  const isMade = await host.ask(format, deviation, span);
  if (isMade) host.note('The triangles are saved.', 'note');
}
