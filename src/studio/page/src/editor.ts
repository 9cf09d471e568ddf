// The editor. What the text means comes from the server, which asks CRT's own front end.

import {autocompletion, completionKeymap, snippet, type CompletionContext, type CompletionResult}
  from '@codemirror/autocomplete';
import {defaultKeymap, history, historyKeymap, indentWithTab, isolateHistory} from '@codemirror/commands';
import {bracketMatching, indentOnInput, indentUnit} from '@codemirror/language';
import {lintGutter, setDiagnostics, lintKeymap} from '@codemirror/lint';
import {highlightSelectionMatches, search, searchKeymap} from '@codemirror/search';
import {ChangeSet, EditorState, type Extension, type ChangeDesc, Transaction}
  from '@codemirror/state';
import {Decoration, EditorView, ViewPlugin, drawSelection, highlightActiveLine,
        highlightActiveLineGutter, hoverTooltip, keymap, lineNumbers, showDialog, tooltips,
        type DecorationSet, type ViewUpdate} from '@codemirror/view';
import {markdown} from './markdown';
import type {CompletionItem, Diagnostic, Renaming, Span} from './protocol';

const tokenClasses = ['comment', 'string', 'number', 'keyword', 'object', 'attribute', 'variable',
                      'parameter', 'function'];
const marks = tokenClasses.map((name) => Decoration.mark({class: `token-${name}`}));

/** CodeMirror joins events of these names alone. */
const gestureEvent = 'input.type.gesture';
/** A gesture may take so many milliseconds, and a pause in typing ends what is undone as one. */
const longestGesture = 60_000;
const typingPause = 500;
/** So long after Escape Tab leaves the script. */
const tabMilliseconds = 2000;

export interface EditorHost {
  /** Takes each new text, and how it came from the one before. Without that it is another one. */
  changed(text: string, changes: ChangeDesc | null): void;
  moved(place: number): void;
  /** Asks about a place. `name` is the new one of what is there. */
  ask(what: string, at: number, name?: string): Promise<unknown>;
  note(text: string): void;
  save(): void;
}

/** Colours what is visible by the tokens that came last, moved by what was typed since. */
class Highlighter {
  decorations: DecorationSet = Decoration.none;
  private tokens: number[] = [];
  private since: ChangeDesc = ChangeSet.empty(0);

  constructor(private readonly view: EditorView) {
    this.since = ChangeSet.empty(view.state.doc.length);
  }

  set(tokens: number[]): void {
    this.tokens = tokens;
    this.since = ChangeSet.empty(this.view.state.doc.length);
    this.paint(this.view);
  }

  update(update: ViewUpdate): void {
    if (update.docChanged) this.since = this.since.composeDesc(update.changes);
    if (update.docChanged || update.viewportChanged) this.paint(update.view);
  }

  private paint(view: EditorView): void {
    const ranges = [];
    const back = this.since.invertedDesc;
    for (const {from, to} of view.visibleRanges) {
      const end = back.mapPos(to, 1);
      for (let i = this.firstAfter(back.mapPos(from, -1)); i < this.tokens.length; i += 3) {
        if (this.tokens[i]! > end) break;
        const begin = this.since.mapPos(this.tokens[i]!, 1);
        const behind = this.since.mapPos(this.tokens[i + 1]!, -1);
        if (begin < behind) ranges.push(marks[this.tokens[i + 2]!]!.range(begin, behind));
      }
    }
    this.decorations = Decoration.set(ranges, true);
  }

  private firstAfter(place: number): number {
    let low = 0;
    let high = this.tokens.length / 3;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.tokens[3 * middle + 1]! < place) low = middle + 1;
      else high = middle;
    }
    return 3 * low;
  }
}

const theme = EditorView.theme({
  '&': {height: '100%', color: 'var(--text)', backgroundColor: 'var(--editor)'},
  '.cm-scroller': {fontFamily: 'var(--mono)', fontSize: '13px', lineHeight: '1.5'},
  '.cm-content': {caretColor: 'var(--text)'},
  '.cm-cursor': {borderLeftColor: 'var(--text)', borderLeftWidth: '2px'},
  '.cm-gutters': {backgroundColor: 'var(--editor)', color: 'var(--dim)', border: 'none'},
  '.cm-activeLine, .cm-activeLineGutter': {backgroundColor: 'var(--line)'},
  '&.cm-focused .cm-selectionBackground, .cm-selectionBackground, ::selection':
    {backgroundColor: 'var(--selection) !important'},
  '.cm-tooltip': {backgroundColor: 'var(--panel)', color: 'var(--text)',
                  border: '1px solid var(--border)', maxWidth: '32rem'},
  '.cm-tooltip .hover': {padding: '0.4rem 0.7rem', maxHeight: '20rem', overflow: 'auto'},
  '.cm-tooltip pre': {margin: '0.3rem 0', fontFamily: 'var(--mono)', whiteSpace: 'pre-wrap'},
  '.cm-tooltip.cm-tooltip-autocomplete > ul': {maxWidth: 'min(32rem, 80vw)', minWidth: '12rem'},
  '.cm-tooltip-autocomplete > ul > li': {overflow: 'hidden', textOverflow: 'ellipsis'},
  '.cm-tooltip-autocomplete > ul > li[aria-selected]':
    {backgroundColor: 'var(--accent-fill)', color: 'var(--accent-text)'},
  '.cm-panels': {backgroundColor: 'var(--panel)', color: 'var(--text)'},
  '.cm-searchMatch': {backgroundColor: 'var(--match)'},
  '.token-comment': {color: 'var(--token-comment)', fontStyle: 'italic'},
  '.token-string': {color: 'var(--token-string)'},
  '.token-number': {color: 'var(--token-number)'},
  '.token-keyword': {color: 'var(--token-keyword)', fontWeight: '600'},
  '.token-object': {color: 'var(--token-object)'},
  '.token-attribute': {color: 'var(--token-attribute)'},
  '.token-parameter': {color: 'var(--token-parameter)'},
  '.token-function': {color: 'var(--token-function)'},
});

const completionTypes: Record<string, string> = {
  attribute: 'property', object: 'class', variable: 'variable', macro: 'function',
  function: 'function', constant: 'constant', keyword: 'keyword'};

export class Editor {
  readonly element = document.createElement('div');
  readonly view: EditorView;
  /** Holds from the next text on. */
  isReadOnly = false;
  private lastTyped = 0;
  private readonly plugin = ViewPlugin.fromClass(Highlighter, {decorations: (p) => p.decorations});

  constructor(private readonly host: EditorHost) {
    this.element.className = 'editor';
    // In a tree of its own the editor's styles need no permission of the page's policy.
    const root = this.element.attachShadow({mode: 'open'});
    this.view = new EditorView({
      state: EditorState.create({extensions: this.extensions()}), parent: root, root});
  }

  get text(): string {
    return this.view.state.doc.toString();
  }

  /** Replaces all, without a way back. */
  open(text: string): void {
    this.view.setState(EditorState.create({doc: text, extensions: this.extensions()}));
    this.host.changed(this.text, null);
  }

  setTokens(tokens: number[]): void {
    this.view.plugin(this.plugin)?.set(tokens);
    this.view.dispatch({});
  }

  setDiagnostics(diagnostics: Diagnostic[]): void {
    const length = this.view.state.doc.length;
    this.view.dispatch(setDiagnostics(this.view.state, diagnostics.map((diagnostic) => ({
      from: Math.min(diagnostic.span[0], length),
      to: Math.min(diagnostic.span[1], length),
      severity: diagnostic.severity,
      message: diagnostic.message,
    }))));
  }

  select(span: Span, takesFocus: boolean): void {
    const length = this.view.state.doc.length;
    const [anchor, head] = [Math.min(span[0], length), Math.min(span[1], length)];
    this.view.dispatch({selection: {anchor, head}, effects: EditorView.scrollIntoView(anchor)});
    if (takesFocus) this.view.focus();
  }

  /** Makes edits that are undone as one. Those of one gesture are one, too. */
  edit(changes: {from: number; to: number; insert: string}[]): void {
    if (this.isReadOnly) return;
    this.view.dispatch({changes, annotations: Transaction.userEvent.of(gestureEvent)});
  }

  /** Says that the edits that follow are those of another gesture. */
  beginGesture(): void {
    this.view.dispatch({annotations: isolateHistory.of('full')});
  }

  async format(): Promise<void> {
    const before = this.text;
    const text = await this.host.ask('format', 0);
    if (typeof text !== 'string' || this.text !== before) return;
    this.replace(text);
  }

  /** Makes the text another one by an edit of what differs, which can be undone. */
  replace(text: string): void {
    const before = this.text;
    if (text === before) return;
    let begin = 0;
    while (begin < before.length && before[begin] === text[begin]) ++begin;
    let same = 0;
    const most = Math.min(before.length, text.length) - begin;
    while (same < most && before[before.length - 1 - same] === text[text.length - 1 - same]) ++same;
    this.view.dispatch({
      changes: {from: begin, to: before.length - same, insert: text.slice(begin, text.length - same)},
      annotations: isolateHistory.of('full')});
  }

  async goToDefinition(place = this.view.state.selection.main.head): Promise<void> {
    const found = (await this.host.ask('definition', place)) as {span?: Span} | null;
    if (found?.span) this.select(found.span, true);
  }

  /** Asks for a new name for the one at the cursor, and changes it by one edit. */
  async rename(): Promise<void> {
    const place = this.view.state.selection.main.head;
    const word = this.view.state.wordAt(place);
    if (!word || this.isReadOnly) return;
    const value = this.view.state.sliceDoc(word.from, word.to);
    const {result} = showDialog(this.view, {
      label: 'New name', input: {type: 'text', name: 'name', value}, submitLabel: 'Rename',
      focus: true});
    const name = (await result)?.querySelector('input')?.value;
    this.view.focus();
    if (!name || name === value) return;
    const before = this.text;
    const found = (await this.host.ask('rename', place, name)) as Renaming | null;
    if (!found || this.text !== before) return;
    this.view.dispatch({changes: found.spans.map(([from, to]) => ({from, to, insert: name})),
                        annotations: isolateHistory.of('full')});
    if (found.others.length > 0)
      this.host.note(`'${value}' also stands in ${found.others.join(', ')}, and is not changed there.`);
  }

  private extensions(): Extension[] {
    return [
      lineNumbers(), highlightActiveLineGutter(), highlightActiveLine(), drawSelection(),
      history({newGroupDelay: longestGesture, joinToEvent: (transaction, isAdjacent) => {
        const pause = performance.now() - this.lastTyped;
        this.lastTyped = performance.now();
        return transaction.isUserEvent(gestureEvent) || (isAdjacent && pause < typingPause);
      }}),
      indentOnInput(), indentUnit.of('    '), bracketMatching(), search({top: true}),
      highlightSelectionMatches(), lintGutter(), this.plugin, theme,
      EditorView.contentAttributes.of({
        'aria-label': 'Script', tabindex: '0',
        'aria-description': 'Tab indents. Escape, then Tab leaves the script.'}),
      EditorState.readOnly.of(this.isReadOnly),
      autocompletion({icons: false, override: [(context) => this.complete(context)]}),
      hoverTooltip((_view, place) => this.hover(place)),
      // What is beyond the panel is cut off.
      tooltips({tooltipSpace: (view) => view.dom.getBoundingClientRect()}),
      EditorView.domEventHandlers({
        mousedown: (event, view) => {
          if (!event.ctrlKey && !event.metaKey) return false;
          const place = view.posAtCoords({x: event.clientX, y: event.clientY});
          if (place !== null) void this.goToDefinition(place);
          return place !== null;
        },
      }),
      keymap.of([
        {key: 'Mod-s', run: () => (this.host.save(), true), preventDefault: true},
        {key: 'F2', run: () => (void this.rename(), true)},
        // Escape lets the next Tab leave the script, also where it has something else to do.
        {key: 'Escape', run: (view) => (view.setTabFocusMode(tabMilliseconds), false)},
        {key: 'F12', run: () => (void this.goToDefinition(), true)},
        {key: 'Shift-Alt-f', run: () => (void this.format(), true)},
        ...completionKeymap, ...lintKeymap, ...searchKeymap, ...historyKeymap, ...defaultKeymap,
        indentWithTab,
      ]),
      EditorView.updateListener.of((update) => {
        if (update.docChanged) this.host.changed(this.text, update.changes);
        // Where the cursor is in a new text is seen when that has been analysed.
        if (update.selectionSet && !update.docChanged)
          this.host.moved(update.state.selection.main.head);
      }),
    ];
  }

  private async complete(context: CompletionContext): Promise<CompletionResult | null> {
    const before = context.matchBefore(/[A-Za-z_<][A-Za-z_0-9]*$/);
    if (!context.explicit && !before) return null;
    const found = (await this.host.ask('completion', context.pos)) as
      {span: Span; items: CompletionItem[]} | null;
    if (!found || found.items.length === 0) return null;
    return {
      from: found.span[0],
      to: context.pos,
      validFor: /^[A-Za-z_0-9]*$/,
      options: found.items.map((item) => ({
        label: item.label,
        detail: item.detail,
        type: completionTypes[item.kind] ?? 'variable',
        boost: -item.rank,
        apply: item.snippet === '' ? item.text : snippet(snippetText(item.snippet)),
        ...(item.about === '' ? {} : {info: () => markdown(item.about)}),
      })),
    };
  }

  private async hover(place: number) {
    const found = (await this.host.ask('hover', place)) as {markdown: string; span: Span} | null;
    if (!found) return null;
    return {pos: found.span[0], end: found.span[1], above: true, create: () => {
      const dom = markdown(found.markdown);
      dom.className = 'hover';
      return {dom};
    }};
  }
}

/** Turns `$1` into what CodeMirror calls a field. */
function snippetText(text: string): string {
  return text.replace(/\$(\d)/g, (_match, digit: string) => (digit === '0' ? '${}' : '${' + digit + '}'));
}
