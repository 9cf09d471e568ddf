// The tree of the script. What is selected here is selected in the editor.

import type {Span, TreeNode} from './protocol';

const signs: Record<string, string> = {
  settings: '⚙', scene: '▣', import: '⇣', assignment: '=', macro: 'ƒ', object: '●',
  combination: '◐', placed: '⤢', call: 'ƒ', name: '→', list: '≡', loop: '↻', choice: '?'};

const combinations: Record<string, string> = {
  '+': 'union', '-': 'difference', '^': 'intersection'};

/** Entities come from statements in these. */
const hasStatements = new Set(['scene', 'loop', 'choice', 'macro']);
const givesEntities = new Set(['object', 'combination', 'placed', 'call', 'name', 'list', 'loop',
                               'choice']);

/** What may be hidden, and what is. */
export interface Eyes {
  isHidden(span: Span): boolean;
  toggle(span: Span): void;
}

export function titleOf(node: TreeNode): string {
  if (node.kind === 'combination') return combinations[node.name] ?? 'combination';
  if (node.base !== undefined) return `${node.base} { }`;
  if (node.kind === 'placed') return `placed: ${node.name}`;
  return node.name;
}

export class Tree {
  readonly element = document.createElement('div');
  private nodes: TreeNode[] = [];
  private rows: HTMLElement[] = [];
  private readonly closed = new Set<string>();
  private selected = -1;

  constructor(private readonly choose: (index: number) => void, private readonly eyes: Eyes) {
    this.element.className = 'tree';
    this.element.setAttribute('role', 'tree');
    this.element.setAttribute('aria-label', 'Scene');
    this.element.tabIndex = 0;
    this.element.addEventListener('keydown', (event) => this.key(event));
  }

  set(nodes: TreeNode[]): void {
    this.nodes = nodes;
    this.draw();
  }

  /** Lists the pieces of the script that can be hidden. */
  statements(): Span[] {
    return this.nodes.filter((_, index) => this.canBeHidden(index)).map(({span}) => span);
  }

  select(index: number): void {
    this.rows[this.selected]?.removeAttribute('aria-selected');
    this.selected = index;
    const row = this.rows[index];
    row?.setAttribute('aria-selected', 'true');
    row?.scrollIntoView({block: 'nearest'});
    // The tree has the keyboard, and says so which of its rows is meant.
    if (row) this.element.setAttribute('aria-activedescendant', row.id);
    else this.element.removeAttribute('aria-activedescendant');
  }

  private path(index: number): string {
    const parts = [];
    for (let i = index; i >= 0; i = this.nodes[i]!.parent) parts.push(this.nodes[i]!.name);
    return parts.join('/');
  }

  draw(): void {
    this.rows = [];
    const depths: number[] = [];
    const hidden: boolean[] = [];
    const parents = new Set(this.nodes.map((node) => node.parent));
    const content = document.createDocumentFragment();
    this.nodes.forEach((node, index) => {
      const depth = node.parent < 0 ? 0 : depths[node.parent]! + 1;
      const isClosed = this.closed.has(this.path(index));
      depths.push(depth);
      const isHidden = node.parent >= 0 && hidden[node.parent]!;
      hidden.push(isHidden || isClosed);
      const row = document.createElement('div');
      row.className = `row kind-${node.kind}`;
      row.id = `node-${index}`;
      row.setAttribute('role', 'treeitem');
      row.setAttribute('aria-level', String(depth + 1));
      row.style.paddingLeft = `${0.5 + 0.9 * depth}rem`;
      const arrow = document.createElement('span');
      arrow.className = 'arrow';
      arrow.setAttribute('aria-hidden', 'true');
      if (parents.has(index)) {
        arrow.textContent = isClosed ? '▸' : '▾';
        row.setAttribute('aria-expanded', String(!isClosed));
        arrow.addEventListener('click', (event) => {
          event.stopPropagation();
          this.toggle(index);
        });
      }
      const sign = document.createElement('span');
      sign.className = 'sign';
      sign.setAttribute('aria-hidden', 'true');
      sign.textContent = signs[node.kind] ?? '';
      const title = document.createElement('span');
      title.className = 'title';
      title.textContent = titleOf(node);
      row.append(arrow, sign, title);
      if (this.canBeHidden(index)) row.append(this.eyeOf(node));
      row.hidden = isHidden;
      row.addEventListener('click', () => this.choose(index));
      this.rows.push(row);
      content.append(row);
    });
    this.element.replaceChildren(content);
    this.select(Math.min(this.selected, this.rows.length - 1));
  }

  /** Says whether a node is a statement that puts entities into the scene, or one in a macro. */
  private canBeHidden(index: number): boolean {
    const node = this.nodes[index]!;
    const parent = this.nodes[node.parent];
    if (!parent || !hasStatements.has(parent.kind) || !givesEntities.has(node.kind)) return false;
    for (let i = node.parent; i >= 0; i = this.nodes[i]!.parent)
      if (['scene', 'macro'].includes(this.nodes[i]!.kind)) return true;
    return false;
  }

  private eyeOf(node: TreeNode): HTMLElement {
    const eye = document.createElement('button');
    const isHidden = this.eyes.isHidden(node.span);
    eye.className = isHidden ? 'eye shut' : 'eye';
    eye.tabIndex = -1;
    eye.title = isHidden ? 'Show it again (H)' : 'Hide it in the view alone (H)';
    eye.setAttribute('aria-label', `${isHidden ? 'Show' : 'Hide'} ${titleOf(node)}`);
    eye.addEventListener('click', (event) => {
      event.stopPropagation();
      this.eyes.toggle(node.span);
    });
    return eye;
  }

  private toggle(index: number): void {
    const path = this.path(index);
    if (!this.closed.delete(path)) this.closed.add(path);
    this.draw();
  }

  private key(event: KeyboardEvent): void {
    const step = event.key === 'ArrowDown' ? 1 : event.key === 'ArrowUp' ? -1 : 0;
    const node = this.nodes[this.selected];
    const row = this.rows[this.selected];
    if (step !== 0) {
      let next = this.selected + step;
      while (this.rows[next]?.hidden) next += step;
      if (this.rows[next]) this.choose(next);
    } else if (event.key === 'Home' || event.key === 'End') {
      const seen = this.rows.flatMap((row, index) => row.hidden ? [] : [index]);
      const end = event.key === 'Home' ? seen[0] : seen.at(-1);
      if (end !== undefined) this.choose(end);
    } else if (node && event.key === 'h' && this.canBeHidden(this.selected)) {
      this.eyes.toggle(node.span);
    } else if (node && event.key === 'ArrowLeft') {
      if (row?.getAttribute('aria-expanded') === 'true') this.toggle(this.selected);
      else if (node.parent >= 0) this.choose(node.parent);
    } else if (node && event.key === 'ArrowRight') {
      if (row?.getAttribute('aria-expanded') === 'false') this.toggle(this.selected);
      else if (row?.hasAttribute('aria-expanded')) this.choose(this.selected + 1);
    } else {
      return;
    }
    event.preventDefault();
  }
}
