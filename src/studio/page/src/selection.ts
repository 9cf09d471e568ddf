// What is selected: a node of the tree, its properties, and its place in the script.

import type {PropertySheet} from './properties';
import type {Span, TreeNode} from './protocol';
import type {Tree} from './tree';

function isMaterial({name, base}: TreeNode): boolean {
  return name === 'Material' || name === 'PrincipledMaterial' || base !== undefined;
}

export class Selection {
  nodes: TreeNode[] = [];
  /** Is the piece of the text that is selected in the tree. */
  selected: Span | null = null;

  constructor(private readonly tree: Tree, private readonly sheet: PropertySheet,
              private readonly selectText: (span: Span) => void,
              private readonly changed: (span: Span | null) => void) {}

  /** Takes a new tree, and selects in it what is at the cursor. */
  set(nodes: TreeNode[], cursor: number): void {
    this.nodes = nodes;
    this.tree.set(nodes);
    this.showAt(cursor);
  }

  choose(index: number): void {
    const node = this.nodes[index];
    if (node) this.selectText(node.span);
    this.show(index);
  }

  /** Finds the place of the material of an object: itself, one that stands in it or behind a
   *  variable, or the variable's name. */
  materialOf(object: TreeNode): number | null {
    if (isMaterial(object)) return object.span[0];
    const attribute = object.attributes.find(({name}) => name === 'material');
    if (!attribute) return null;
    const variable = /^the variable '(.*)'$/.exec(attribute.reason ?? '')?.[1];
    const place = this.nodes.find(({kind, name}) =>
      kind === 'assignment' && name === variable)?.span ?? attribute.span;
    const material = this.nodes.find((node) =>
      isMaterial(node) && node.span[0] >= place[0] && node.span[1] <= place[1]);
    return (material ?? attribute).span[0];
  }

  /** Shows the innermost node around a place. */
  showAt(place: number): void {
    let found = -1;
    this.nodes.forEach((node, index) => {
      if (node.span[0] <= place && place <= node.span[1]) found = index;
    });
    this.show(found);
  }

  /** Shows a node, with the properties of the innermost object around or else in it. */
  private show(index: number): void {
    this.tree.select(index);
    this.selected = this.nodes[index]?.span ?? null;
    this.changed(this.nodes[index]?.kind === 'scene' ? null : this.selected);
    let object = index;
    while (object >= 0 && !['object', 'settings'].includes(this.nodes[object]!.kind))
      object = this.nodes[object]!.parent;
    const node = this.nodes[index];
    if (object < 0 && node && node.kind !== 'scene')
      object = this.firstObjectIn(index, new Set());
    this.sheet.show(this.nodes[object] ?? null);
  }

  /** Finds the first object in what is placed, combined or assigned, also behind a variable. */
  private firstObjectIn(index: number, seen: Set<number>): number {
    if (seen.has(index)) return -1;
    seen.add(index);
    const [from, to] = this.nodes[index]!.span;
    for (const [inner, {kind, name, span}] of this.nodes.entries()) {
      if (span[0] < from || span[1] > to) continue;
      if (kind === 'object') return inner;
      if (kind !== 'name' && kind !== 'call') continue;
      const assignment = this.nodes.findIndex((node) =>
        node.kind === 'assignment' && node.name === name);
      const found = assignment < 0 ? -1 : this.firstObjectIn(assignment, seen);
      if (found >= 0) return found;
    }
    return -1;
  }
}
