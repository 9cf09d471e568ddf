// The page of the studio: puts the panels together and passes messages between them.

import 'dockview-core/dist/styles/dockview.css';
import './style.css';
import {createDockview, themeDark, themeLight, type DockviewApi} from 'dockview-core';

import {cameraEdits} from './camera_text';
import {dot, subtract, unit} from './camera';
import {Connection} from './connection';
import {Editor} from './editor';
import {LiveView} from './live_view';
import {Console, Queue, Statistics} from './panels';
import {PropertySheet} from './properties';
import type {Camera, Message, Pick, Scene, TreeNode} from './protocol';
import {Tree} from './tree';

const layoutKey = 'crt-studio:layout';
/** In this interval the server is asked whether another program has written the script. */
const lookMilliseconds = 1000;
const themeKey = 'crt-studio:theme';

class Studio {
  private readonly console = new Console();
  private readonly statistics = new Statistics();
  private readonly queue = new Queue((action) => this.connection.send({type: 'render', action}));
  private readonly tree = new Tree((index) => this.chooseNode(index));
  private readonly sheet = new PropertySheet({
    begin: () => this.editor.beginGesture(),
    edit: (changes) => this.editor.edit(changes),
    select: (span) => this.editor.select(span, true),
    textOf: (span) => this.editor.text.slice(span[0], span[1]),
  });
  private readonly view = new LiveView({
    cameraMoved: (camera) => this.setCamera(camera),
    cameraReset: () => this.setCamera(null),
    picked: (x, y, focuses) => void this.pick(x, y, focuses),
  });
  private readonly editor = new Editor({
    changed: (text) => this.textChanged(text),
    moved: (place) => this.showNodeAt(place),
    ask: (what, at) => this.connection.ask({type: 'ask', what, at, revision: this.revision}),
    save: () => this.save(false),
  });
  private readonly panels = {
    editor: {title: 'Script', element: this.editor.element},
    view: {title: 'Live view', element: this.view.element},
    tree: {title: 'Scene', element: this.tree.element},
    properties: {title: 'Properties', element: this.sheet.element},
    console: {title: 'Console', element: this.console.element},
    queue: {title: 'Queue', element: this.queue.element},
    statistics: {title: 'Statistics', element: this.statistics.element},
  } as const;
  private readonly status = document.getElementById('status')!;
  private readonly scripts = document.createElement('select');
  private readonly connection: Connection;
  private readonly dock: DockviewApi;
  private revision = 0;
  private script = '';
  private folder = '';
  private savedText = '';
  private nodes: TreeNode[] = [];
  private scene: Scene | null = null;
  private camera: Camera | null = null;
  /** For tests: when the text changed last, and how long the first picture of it took. */
  readonly timing = {changed: 0, firstPicture: 0, diagnostics: 0};

  constructor(token: string) {
    this.makeBar();
    this.dock = createDockview(document.getElementById('dock')!, {
      theme: themeDark,
      createComponent: ({name}) => ({
        element: this.panels[name as keyof typeof this.panels].element,
        init: () => undefined,
      }),
    });
    this.applyTheme(localStorage.getItem(themeKey) ??
      (matchMedia('(prefers-color-scheme: light)').matches ? 'light' : 'dark'));
    this.restoreLayout();
    this.dock.onDidLayoutChange(() =>
      localStorage.setItem(layoutKey, JSON.stringify(this.dock.toJSON())));
    this.connection = new Connection(token, {
      message: (message) => this.receive(message),
      frame: (frame) => {
        this.view.show(frame);
        if (frame.isLast && frame.revision === this.revision && this.timing.firstPicture === 0)
          this.timing.firstPicture = performance.now() - this.timing.changed;
      },
      file: (format, content) => this.download(format, content),
      connected: (isConnected) => this.connected(isConnected),
    });
    setInterval(() => this.connection.send({type: 'look'}), lookMilliseconds);
    addEventListener('beforeunload', (event) => {
      if (this.isChanged) event.preventDefault();
    });
  }

  private get isChanged(): boolean {
    return this.editor.text !== this.savedText;
  }

  private get draftKey(): string {
    return `crt-studio:text:${this.folder}/${this.script}`;
  }

  // ---- layout

  private makeBar(): void {
    const bar = document.getElementById('bar')!;
    const button = (text: string, title: string, action: () => void) => {
      const element = document.createElement('button');
      element.textContent = text;
      element.title = title;
      element.addEventListener('click', action);
      bar.append(element);
    };
    const name = document.createElement('b');
    name.textContent = 'CRT studio';
    this.scripts.setAttribute('aria-label', 'Script to open');
    this.scripts.addEventListener('change', () => this.open(this.scripts.value));
    bar.append(name, this.scripts);
    button('Save', 'Write the script to its file (Ctrl+S)', () => this.save(false));
    button('Format', 'Lay the script out (Shift+Alt+F)', () => void this.editor.format());
    button('Camera to script', 'Write this view into the script', () => this.writeCamera());
    button('Reset view', 'Look through the script’s camera (Home)', () => this.setCamera(null));
    button('PNG', 'Save the picture as PNG', () => this.savePicture('png'));
    button('EXR', 'Save the picture as EXR', () => this.savePicture('exr'));
    const panels = document.createElement('select');
    panels.setAttribute('aria-label', 'Show a panel');
    panels.append(new Option('Panels…', ''),
      ...Object.entries(this.panels).map(([id, {title}]) => new Option(title, id)));
    panels.append(new Option('Usual layout', 'usual'));
    panels.addEventListener('change', () => {
      if (panels.value === 'usual') this.usualLayout();
      else if (panels.value !== '') this.showPanel(panels.value as keyof typeof this.panels);
      panels.value = '';
    });
    bar.append(panels);
    button('Theme', 'Change between dark and light', () =>
      this.applyTheme(document.documentElement.dataset.theme === 'dark' ? 'light' : 'dark'));
  }

  private applyTheme(theme: string): void {
    document.documentElement.dataset.theme = theme;
    localStorage.setItem(themeKey, theme);
    this.dock.updateOptions({theme: theme === 'dark' ? themeDark : themeLight});
  }

  private showPanel(id: keyof typeof this.panels): void {
    const panel = this.dock.getPanel(id);
    if (panel) panel.api.setActive();
    else this.dock.addPanel({id, component: id, title: this.panels[id].title});
  }

  private restoreLayout(): void {
    try {
      const layout = localStorage.getItem(layoutKey);
      if (layout === null) return this.usualLayout();
      this.dock.fromJSON(JSON.parse(layout));
      if (this.dock.panels.length === 0) this.usualLayout();
    } catch {
      this.usualLayout();
    }
  }

  private usualLayout(): void {
    this.dock.clear();
    const {innerWidth: width, innerHeight: height} = window;
    const add = (id: keyof typeof this.panels, reference?: string,
                 direction: 'right' | 'below' | 'within' = 'right') =>
      this.dock.addPanel({
        id, component: id, title: this.panels[id].title,
        ...(reference ? {position: {referencePanel: reference, direction}} : {})});
    add('editor');
    add('view', 'editor', 'right');
    add('tree', 'view', 'right');
    add('properties', 'tree', 'below');
    add('console', 'view', 'below');
    add('queue', 'console', 'within');
    add('statistics', 'console', 'within');
    this.dock.getPanel('console')!.api.setActive();
    this.dock.getPanel('editor')!.api.setActive();
    // Sizes hold once the panels have been laid out.
    const dock = document.getElementById('dock')!;
    this.dock.layout(dock.clientWidth, dock.clientHeight, true);
    this.dock.getPanel('editor')!.group.api.setSize({width: width * 0.33});
    this.dock.getPanel('tree')!.group.api.setSize({width: width * 0.23});
    this.dock.getPanel('tree')!.group.api.setSize({height: height * 0.4});
    this.dock.getPanel('console')!.group.api.setSize({height: height * 0.22});
  }

  // ---- messages

  private receive(message: Message): void {
    switch (message.type) {
      case 'hello':
        this.folder = message.folder;
        this.sheet.describe(message.objects);
        this.listScripts(message.scripts);
        this.console.add(`CRT ${message.version}, folder ${message.folder}`);
        // After a lost connection the server gets what was typed meanwhile.
        if (this.revision > 0) return this.resume();
        if (message.script !== '') this.open(message.script);
        else if (message.scripts[0] !== undefined) this.open(message.scripts[0]);
        break;
      case 'opened':
        this.opened(message.script, message.text);
        break;
      case 'analysis':
        if (message.revision !== this.revision) break;
        this.editor.setTokens(message.tokens);
        this.nodes = message.tree;
        this.tree.set(message.tree);
        this.showNodeAt(this.editor.view.state.selection.main.head);
        break;
      case 'diagnostics':
        if (message.revision !== this.revision) break;
        this.timing.diagnostics = performance.now() - this.timing.changed;
        this.editor.setDiagnostics(message.diagnostics);
        this.showDiagnostics(message.diagnostics);
        break;
      case 'scene':
        this.scene = message;
        this.view.setCamera(message.camera);
        if (!message.isOverridden) this.camera = null;
        this.statistics.setScene(message);
        for (const warning of message.warnings) this.console.add(warning, 'warning');
        break;
      case 'state':
        this.queue.set(message);
        if (message.phase === 'failed' && message.message !== 'the script has errors')
          this.console.add(message.message, 'error');
        break;
      case 'finished':
        this.statistics.setStats(message.stats);
        break;
      case 'print':
        this.console.add(message.line, 'print');
        break;
      case 'changed':
        if (message.script === this.script) this.changedOutside(message.text);
        break;
      case 'saved':
        this.saved(message.script, message.scripts);
        break;
      case 'conflict':
        if (confirm(`${message.message}. Write over it?`)) this.save(true);
        break;
      case 'error':
        this.console.add(message.message, 'error');
        break;
      default:
        break;
    }
  }

  private connected(isConnected: boolean): void {
    document.body.classList.toggle('lost', !isConnected);
    this.status.textContent = isConnected ? '' :
      'The connection is lost. What you type is kept in this browser.';
  }

  private resume(): void {
    this.connection.send({type: 'open', script: this.script});
  }

  private showDiagnostics(diagnostics: {severity: string; message: string; line: number}[]): void {
    const first = diagnostics.find(({severity}) => severity === 'error') ?? diagnostics[0];
    this.status.textContent = first ? `Line ${first.line}: ${first.message}` : '';
    this.status.className = first?.severity ?? '';
  }

  // ---- the script

  private open(script: string): void {
    if (this.isChanged && this.revision > 0 &&
        !confirm('The script has changes that are not saved. They are kept in this browser.')) {
      this.scripts.value = this.script;
      return;
    }
    this.script = '';
    this.connection.send({type: 'open', script});
  }

  private opened(script: string, text: string): void {
    if (script === this.script && this.revision > 0) {  // the connection came back
      this.savedText = text;
      this.sendText();
      if (this.camera) this.setCamera(this.camera);
      return;
    }
    this.script = script;
    this.scripts.value = script;
    document.title = `${script} – CRT studio`;
    const kept = localStorage.getItem(this.draftKey);
    this.savedText = text;
    this.editor.open(kept ?? text);
    if (kept !== null && kept !== text)
      this.console.add('What you had typed and not saved is here again.', 'note');
  }

  private textChanged(text: string): void {
    this.revision += 1;
    this.timing.changed = performance.now();
    this.timing.firstPicture = 0;
    this.sendText();
    document.body.classList.toggle('changed', this.isChanged);
    if (this.isChanged) localStorage.setItem(this.draftKey, text);
    else localStorage.removeItem(this.draftKey);
  }

  private sendText(): void {
    this.connection.send({type: 'text', revision: this.revision, text: this.editor.text});
  }

  /** Another program has written the file. What was typed here is replaced only if one says so. */
  private changedOutside(text: string): void {
    if (text === this.editor.text || !this.isChanged) {
      this.takeFile(text);
      return this.console.add(`${this.script} was changed by another program, and is shown so.`);
    }
    this.savedText = text;
    this.ask(`${this.script} was changed by another program, and here, too.`, {
      'Take the file': () => this.takeFile(text),
      'Keep what is here': () => undefined,
    });
  }

  private takeFile(text: string): void {
    this.savedText = text;
    this.editor.replace(text);
  }

  /** Asks by a bar that keeps nobody from going on. */
  private ask(question: string, answers: Record<string, () => void>): void {
    const bar = document.getElementById('question')!;
    const buttons = Object.entries(answers).map(([text, action]) => {
      const button = document.createElement('button');
      button.textContent = text;
      button.addEventListener('click', () => {
        bar.replaceChildren();
        action();
      });
      return button;
    });
    bar.replaceChildren(question, ...buttons);
  }

  private save(force: boolean): void {
    if (this.script !== '')
      this.connection.send({type: 'save', script: this.script, text: this.editor.text, force});
  }

  private saved(script: string, scripts: string[]): void {
    this.savedText = this.editor.text;
    localStorage.removeItem(this.draftKey);
    document.body.classList.remove('changed');
    this.listScripts(scripts);
    this.console.add(`Saved ${script}`);
  }

  private listScripts(scripts: string[]): void {
    this.scripts.replaceChildren(...scripts.map((script) => new Option(script, script)));
    this.scripts.value = this.script;
  }

  // ---- what is selected

  private chooseNode(index: number): void {
    const node = this.nodes[index];
    if (node) this.editor.select(node.span, false);
    this.showNode(index);
  }

  /** Shows the innermost object around a place, or the innermost node. */
  private showNodeAt(place: number): void {
    let found = -1;
    this.nodes.forEach((node, index) => {
      if (node.span[0] <= place && place <= node.span[1]) found = index;
    });
    this.showNode(found);
  }

  private showNode(index: number): void {
    this.tree.select(index);
    let object = index;
    while (object >= 0 && !['object', 'settings'].includes(this.nodes[object]!.kind))
      object = this.nodes[object]!.parent;
    if (object < 0 && index >= 0) object = this.firstObjectIn(index, new Set());
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

  private async pick(x: number, y: number, focuses: boolean): Promise<void> {
    const pick = (await this.connection.ask({type: 'pick', x, y})) as Pick | null;
    if (!pick || !this.scene) return;
    if (focuses) {
      const camera = this.camera ?? this.scene.camera;
      const axis = unit(subtract(camera.pointing, camera.position));
      const depth = dot(axis, subtract(pick.position, camera.position));
      if (depth > 0) this.setCamera({...camera, focalDistance: depth});
      return;
    }
    if (pick.revision === this.revision) this.editor.select(pick.origin, false);
  }

  // ---- the camera and the picture

  private setCamera(camera: Camera | null): void {
    this.camera = camera;
    if (camera) this.view.setCamera(camera);
    this.connection.send({type: 'camera', camera});
  }

  private writeCamera(): void {
    if (!this.camera) return this.console.add('The view is that of the script’s camera.');
    const {changes, refused} = cameraEdits(this.nodes, this.camera);
    for (const reason of refused)
      this.console.add(`The camera is not written into the script: ${reason}`, 'warning');
    if (changes.length === 0) return;
    this.editor.beginGesture();
    this.editor.edit(changes);
  }

  private savePicture(format: string): void {
    this.connection.send({type: 'picture', format});
  }

  private download(format: string, content: ArrayBuffer): void {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([content]));
    link.download = this.script.replace(/^.*\//, '').replace(/\.crt$/, '') + '.' + format;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
  }
}

const token = /token=([0-9a-f]+)/.exec(location.hash)?.[1] ?? '';
Object.assign(window, {studio: new Studio(token)});
