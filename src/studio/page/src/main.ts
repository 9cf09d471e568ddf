// The page of the studio: puts the panels together and passes messages between them.

import 'dockview-core/dist/styles/dockview.css';
import './style.css';

import {cameraEdits} from './camera_text';
import {focusOn} from './camera';
import {Connection} from './connection';
import {makeCopyList} from './copy_code';
import {button} from './dom';
import {Editor} from './editor';
import {makeInsertList} from './insertion';
import {makeExportList} from './export_mesh';
import {Layout} from './layout';
import {LiveView} from './live_view';
import {MeasuresSheet} from './measures';
import {Console, Statistics} from './panels';
import {PropertySheet} from './properties';
import type {Boxes, Camera, Code, Diagnostic, Measures, Message, Pick, Scene, State, TreeNode} from './protocol';
import {Queue} from './queue';
import {ScriptFile} from './script_file';
import {Ruler} from './ruler';
import {Selection} from './selection';
import {TradePlot} from './trade_plot';
import {Tree} from './tree';
import {ViewControls} from './view_controls';
import {ViewState} from './view_state';

/** In this interval the server is asked whether another program has written the script. */
const lookMilliseconds = 1000;
/** What needs the tree of the newest text looks for it in this interval. */
const pollMilliseconds = 20;

class Studio {
  private readonly console = new Console();
  private readonly statistics = new Statistics();
  private readonly trade = new TradePlot();
  private readonly queue = new Queue(
    (action) => this.connection.send({type: 'render', action}), this.trade.element);
  private readonly viewState = new ViewState(() => this.viewChanged());
  private readonly tree = new Tree((index) => this.selection.choose(index), this.viewState);
  private readonly sheet = new PropertySheet({
    begin: () => this.editor.beginGesture(),
    edit: (changes) => this.editor.edit(changes),
    select: (span) => this.editor.select(span, true),
    textOf: (span) => this.editor.text.slice(span[0], span[1]),
    ballOf: (node) => this.ballOf(node),
  });
  private readonly measures = new MeasuresSheet({
    measure: (span) => this.connection.ask({type: 'measure', span}) as Promise<Measures | null>,
  });
  private readonly selection = new Selection(this.tree, this.sheet,
                                             (span) => this.editor.select(span, false),
                                             (span) => this.measures.show(span));
  private readonly view = new LiveView({
    cameraMoved: (camera) => this.setCamera(camera),
    cameraReset: () => this.setCamera(null),
    modeChanged: () => this.viewState.nextMode(),
    picked: (x, y, focuses) => void this.pick(x, y, focuses),
    regionChosen: (region) => {
      this.controls.wantRegion(false);
      this.viewState.set({region});
    },
  });
  private readonly ruler = new Ruler(this.view.overlay, (text) => this.controls.say(text),
                                     () => this.scene?.unit ?? '');
  private readonly controls = new ViewControls(this.viewState, this.view.comparison, {
    askBoxes: async () => (await this.askBoxes()).boxes,
    viewer: () => (this.camera ?? this.scene?.camera)?.position ?? [0, 0, 0],
    countShown: () => this.view.shown,
    boundsChanged: () => void this.drawBounds(),
    regionWanted: (isWanted) => this.view.takeRegion(isWanted),
    rulerWanted: (isWanted) => this.ruler.use(isWanted),
  });
  private readonly editor = new Editor({
    changed: (text, changes) => {
      if (changes) this.viewState.follow(changes);
      else this.resetView();
      this.textChanged(text);
    },
    moved: (place) => this.selection.showAt(place),
    ask: (what, at, name) => this.ask(what, at, name),
    note: (text) => this.console.add(text, 'warning'),
    save: () => this.file.save(false),
  });
  private readonly file = new ScriptFile({
    send: (message) => this.connection.send(message),
    text: () => this.editor.text,
    show: (text) => this.editor.open(text),
    replace: (text) => this.editor.replace(text),
    resume: () => this.resume(),
    note: (text) => this.console.add(text),
    hasNone: (folder) => this.view.say(`${folder} has no script yet. `,
      button('New script…', 'Begin a script', () => this.file.begin())),
  });
  private readonly layout = new Layout({
    editor: {title: 'Script', element: this.editor.element},
    view: {title: 'Live view', element: this.view.element},
    tree: {title: 'Scene', element: this.tree.element},
    properties: {title: 'Properties', element: this.sheet.element},
    console: {title: 'Console', element: this.console.element},
    queue: {title: 'Queue', element: this.queue.element},
    statistics: {title: 'Statistics', element: this.statistics.element},
  });
  private readonly status = document.getElementById('status')!;
  private readonly progress = document.getElementById('progress')!;
  private readonly connection: Connection;
  private revision = 0;
  /** Is the revision that the tree is of. */
  private analysed = 0;
  private scene: Scene | null = null;
  private camera: Camera | null = null;
  private stats: Record<string, number> = {};
  private diagnostics: Diagnostic[] = [];
  /** Says why the newest text gives no picture, if it gives none. */
  private failure = '';
  /** For tests: when the text changed last, and how long the first picture of it took. */
  readonly timing = {changed: 0, firstPicture: 0, diagnostics: 0};

  constructor(token: string, only?: string) {
    this.makeBar();
    this.sheet.element.append(this.measures.element);
    document.body.classList.toggle('only-view', only !== undefined);
    this.layout.start(only);
    this.view.element.append(this.controls.element);
    this.connection = new Connection(token, {
      message: (message) => this.receive(message),
      frame: (frame) => {
        this.view.show(frame);
        this.statistics.setDenoised(this.view.isDenoised);
        this.trade.add(frame, this.queue.seconds);
        if (frame.isLast && frame.revision === this.revision && this.timing.firstPicture === 0)
          this.timing.firstPicture = performance.now() - this.timing.changed;
      },
      file: (format, content) => this.download(format, content),
      connected: (isConnected) => this.connected(isConnected),
    });
    setInterval(() => {
      this.connection.send({type: 'look'});
      this.connection.send({type: 'machine'});
    }, lookMilliseconds);
    addEventListener('keydown', (event) => {
      if (event.key !== 's' || !(event.ctrlKey || event.metaKey) || event.defaultPrevented) return;
      event.preventDefault();
      this.file.save(false);
    });
    addEventListener('beforeunload', (event) => {
      if (this.file.isChanged) event.preventDefault();
    });
  }

  private makeBar(): void {
    const bar = document.getElementById('bar')!;
    const add = (text: string, title: string, action: () => void) =>
      bar.append(button(text, title, action));
    const addWriting = (text: string, title: string, action: () => void) => {
      add(text, title, action);
      bar.lastElementChild!.className = 'writes';
    };
    const name = document.createElement('b');
    name.textContent = 'CRT studio';
    const sign = document.createElement('span');
    sign.className = 'unsaved';
    sign.textContent = '•';
    sign.title = 'What was typed is not saved';
    bar.append(name, sign, this.file.list);
    addWriting('Save', 'Write the script to its file (Ctrl+S)', () => this.file.save(false));
    addWriting('Format', 'Lay the script out (Shift+Alt+F)', () => void this.editor.format());
    bar.append(this.insertList());
    addWriting('Camera to script', 'Write this view into the script', () => this.writeCamera());
    add('Reset view', 'Look through the script’s camera (Home)', () => this.setCamera(null));
    add('PNG', 'Save the picture as PNG', () => this.savePicture('png'));
    add('EXR', 'Save the picture as EXR', () => this.savePicture('exr'));
    bar.append(this.exportList(), this.copyList(), this.layout.makeList());
    add('Theme', 'Change between dark and light', () => this.layout.toggleTheme());
  }

  // ---- messages

  private receive(message: Message): void {
    switch (message.type) {
      case 'hello':
        this.sheet.describe(message.objects);
        this.console.add(`CRT ${message.version}` + (message.folder && `, folder ${message.folder}`));
        this.file.beginning = message.beginning ?? '';
        this.file.start(message.folder, message.script, message.scripts);
        break;
      case 'opened':
        this.setReadOnly(message.readOnly ?? false);
        this.file.opened(message.script, message.text, message.typed);
        break;
      case 'analysis':
        if (message.revision !== this.revision) break;
        this.editor.setTokens(message.tokens);
        this.analysed = message.revision;
        this.selection.set(message.tree, this.editor.view.state.selection.main.head);
        this.viewState.fit(this.tree.statements());
        break;
      case 'diagnostics':
        if (message.revision !== this.revision) break;
        this.timing.diagnostics = performance.now() - this.timing.changed;
        this.editor.setDiagnostics(message.diagnostics);
        this.diagnostics = message.diagnostics;
        this.showStatus();
        break;
      case 'scene':
        this.scene = message;
        this.view.setCamera(message.camera);
        if (!message.isOverridden) this.camera = null;
        this.statistics.setScene(message);
        this.controls.setTime(message.readsTime, message.frames);
        void this.drawBounds();
        this.measures.update();
        this.console.setWarnings(message.warnings);
        break;
      case 'state':
        this.showState(message);
        break;
      case 'machine':
        this.queue.setMachine(message);
        break;
      case 'finished':
        this.stats = message.stats;
        this.statistics.setStats(message.stats);
        break;
      case 'print':
        this.console.addOfRun(message.line, 'print');
        break;
      case 'changed':
        this.file.changedOutside(message.script, message.text);
        break;
      case 'saved':
        this.file.saved(message.script, message.scripts);
        break;
      case 'conflict':
        if (confirm(`${message.message}. Write over it?`)) this.file.save(true);
        break;
      case 'error':
        this.console.add(message.message, 'error');
        this.say(message.message, 'error');
        break;
      default:
        break;
    }
  }

  /** A scene of a program is listed, and cannot be changed here. */
  private setReadOnly(isReadOnly: boolean): void {
    this.editor.isReadOnly = isReadOnly;
    document.body.classList.toggle('read-only', isReadOnly);
  }

  private connected(isConnected: boolean): void {
    document.body.classList.toggle('lost', !isConnected);
    this.status.textContent = isConnected ? '' :
      'The connection is lost. What you type is kept in this browser.';
  }

  /** Tells a server that has come back what it should know. */
  private resume(): void {
    this.sendText();
    if (this.camera) this.setCamera(this.camera);
  }

  private showState(state: State): void {
    this.queue.set(state);
    this.progress.textContent = this.queue.summary;
    if (state.phase === 'script') this.console.beginRun();
    if (state.phase === 'done') this.trade.end(this.stats, state.seconds);
    if (state.revision !== this.revision) return;
    const failure = state.phase === 'failed' ? state.message : '';
    if (failure === this.failure) return;
    this.failure = failure;
    this.showStatus();
    if (failure === '') return;
    this.console.addOfRun(failure, 'error');
    this.view.say(`There is no picture: ${failure}`);
  }

  /** Shows what is wrong: what stands in the text, or else what came out when it was run. */
  private showStatus(): void {
    const error = this.diagnostics.find(({severity}) => severity === 'error');
    const first = error ?? (this.failure === '' ? this.diagnostics[0] : undefined);
    if (first) this.say(first.line > 0 ? `Line ${first.line}: ${first.message}` : first.message,
                        first.severity);
    else this.say(this.failure.replace(/^line/, 'Line'), this.failure === '' ? '' : 'error');
  }

  private say(text: string, kind: string): void {
    this.status.textContent = text;
    this.status.title = text;
    this.status.className = kind;
  }

  private textChanged(text: string): void {
    this.revision += 1;
    this.timing.changed = performance.now();
    this.timing.firstPicture = 0;
    this.failure = '';
    this.sendText();
    this.file.keep(text);
  }

  private sendText(): void {
    this.connection.send({type: 'text', revision: this.revision, text: this.editor.text,
                          script: this.file.name, view: this.viewState.options});
  }

  private ask(what: string, at: number, name?: string): Promise<unknown> {
    return this.connection.ask({type: 'ask', what, at, name, revision: this.revision});
  }

  private async ballOf(node: TreeNode): Promise<string | null> {
    const place = this.selection.materialOf(node);
    const file = place === null ? null : await this.ask('preview', place);
    return typeof file === 'string' ? `data:image/png;base64,${file}` : null;
  }

  // ---- what the view shows

  private viewChanged(): void {
    this.connection.send({type: 'view', view: this.viewState.options});
    this.controls.update();
    this.view.overlay.setRegion(this.viewState.options.region);
    this.tree.draw();
  }

  /** Shows all of another script. */
  private resetView(): void {
    this.controls.reset();
    this.view.overlay.setRegion(null);
    this.view.clear(this.revision + 1);
    if (this.camera) this.setCamera(null);
  }

  private async askBoxes(): Promise<Boxes> {
    const answer = await this.connection.ask({type: 'boxes'}) as Boxes | null;
    return answer ?? {boxes: [], cutters: []};
  }

  private async drawBounds(): Promise<void> {
    const {showsBounds, showsCutters} = this.controls;
    if (!showsBounds && !showsCutters) return this.view.overlay.setBoxes([], []);
    const {boxes, cutters} = await this.askBoxes();
    this.view.overlay.setBoxes(showsBounds ? boxes : [], showsCutters ? cutters : []);
  }

  // ---- the camera and the picture

  private async pick(x: number, y: number, focuses: boolean): Promise<void> {
    const pick = (await this.connection.ask({type: 'pick', x, y})) as Pick | null;
    if (this.ruler.isUsed && !focuses) {
      if (pick) this.ruler.add(pick.position);
      return;
    }
    this.controls.showPick(pick);
    if (!pick || !this.scene) return;
    if (focuses) {
      this.setCamera(focusOn(this.camera ?? this.scene.camera, pick.position));
      return;
    }
    if (pick.revision === this.revision) this.editor.select(pick.origin, false);
  }

  private setCamera(camera: Camera | null): void {
    this.camera = camera;
    if (camera) this.view.setCamera(camera);
    this.connection.send({type: 'camera', camera});
  }

  private writeCamera(): void {
    if (!this.camera) return this.console.add('The view is that of the script’s camera.');
    const {changes, refused} = cameraEdits(this.selection.nodes, this.camera);
    for (const reason of refused)
      this.console.add(`The camera is not written into the script: ${reason}`, 'warning');
    if (changes.length === 0) return;
    this.editor.beginGesture();
    this.editor.edit(changes);
  }

  private insertList(): HTMLSelectElement {
    return makeInsertList({
      text: () => this.editor.text,
      nodes: async () => {
        while (this.analysed !== this.revision)
          await new Promise((resolve) => setTimeout(resolve, pollMilliseconds));
        return this.selection.nodes;
      },
      camera: () => this.camera ?? this.scene?.camera ?? null,
      insert: (place, text, selected) => {
        this.editor.beginGesture();
        this.editor.edit([{from: place, to: place, insert: text}]);
        this.editor.select(selected, true);
      },
      note: (text) => this.console.add(text, 'warning'),
    });
  }

  private copyList(): HTMLSelectElement {
    return makeCopyList({
      ask: (language, span) => this.connection.ask(
        {type: 'code', language, ...(span ? {span} : {})}) as Promise<Code | null>,
      selected: () => this.selection.selected,
      note: (text, kind) => this.console.add(text, kind),
    });
  }

  private exportList(): HTMLElement {
    return makeExportList({
      ask: (format, deviation, span) => this.connection.ask(
        {type: 'surface', format, deviation, ...(span ? {span} : {})}) as Promise<boolean | null>,
      selected: () => this.selection.selected,
      note: (text, kind) => this.console.add(text, kind),
    });
  }

  private savePicture(format: string): void {
    this.connection.send({type: 'picture', format});
  }

  private download(format: string, content: ArrayBuffer): void {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([content]));
    link.download = this.file.name.replace(/^.*\//, '').replace(/\.crt$/, '') + '.' + format;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
  }
}

const token = /token=([0-9a-f]+)/.exec(location.hash)?.[1] ?? '';
/** A page in a frame may show one panel alone: #token=...&only=view. */
const only = /only=([a-z]+)/.exec(location.hash)?.[1];
Object.assign(window, {studio: new Studio(token, only)});
