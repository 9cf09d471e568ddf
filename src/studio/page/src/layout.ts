// Where the panels are, and the theme. The browser keeps both.

import {createDockview, themeDark, themeLight, type DockviewApi} from 'dockview-core';
import {storage} from './storage';
import {nameTabs} from './tabs';

export interface PanelContent {
  title: string;
  element: HTMLElement;
}

type Direction = 'right' | 'below' | 'within';
/** Says what room there is. Each has a layout of its own. */
type Room = 'wide' | 'upright' | 'small';

const layoutKeys: Record<Room, string> = {
  wide: 'crt-studio:layout', upright: 'crt-studio:layout:upright',
  small: 'crt-studio:layout:small'};
const leastWide = 1000;
const leastUpright = 640;
const themeKey = 'crt-studio:theme';

export class Layout {
  readonly dock: DockviewApi;
  private readonly root = document.getElementById('dock')!;
  private room: Room = 'wide';

  constructor(private readonly panels: Record<string, PanelContent>) {
    for (const {title, element} of Object.values(panels)) {
      if (!element.hasAttribute('role')) element.setAttribute('role', 'region');
      element.setAttribute('aria-label', title);
    }
    this.dock = createDockview(this.root, {
      theme: themeDark,
      createComponent: ({name}) => ({element: this.panels[name]!.element, init: () => undefined}),
    });
    this.applyTheme(storage.getItem(themeKey) ??
      (matchMedia('(prefers-color-scheme: light)').matches ? 'light' : 'dark'));
  }

  /** Puts the panels where they were, or `only` one, once the page has its other parts. */
  start(only?: string): void {
    const {clientWidth, clientHeight} = this.root;
    this.dock.layout(clientWidth, clientHeight);
    nameTabs(this.root, this.dock);
    if (only !== undefined && this.panels[only]) {
      this.show(only);
      this.dock.getPanel(only)!.group.header.hidden = true;
      return;
    }
    this.room = this.roomNow();
    this.restore();
    this.dock.onDidLayoutChange(() =>
      storage.setItem(layoutKeys[this.room], JSON.stringify(this.dock.toJSON())));
    addEventListener('resize', () => this.fit());
  }

  private roomNow(): Room {
    return innerWidth >= leastWide ? 'wide' : innerWidth >= leastUpright ? 'upright' : 'small';
  }

  /** Takes the layout of the room there is: a tablet may be turned. */
  private fit(): void {
    if (this.roomNow() === this.room) return;
    this.room = this.roomNow();
    this.dock.layout(this.root.clientWidth, this.root.clientHeight);
    this.restore();
  }

  /** Makes the list that brings closed panels back. */
  makeList(): HTMLSelectElement {
    const list = document.createElement('select');
    list.setAttribute('aria-label', 'Show a panel');
    list.append(new Option('Panels…', ''),
      ...Object.entries(this.panels).map(([id, {title}]) => new Option(title, id)));
    list.append(new Option('Usual layout', 'usual'));
    list.addEventListener('change', () => {
      if (list.value === 'usual') this.arrange();
      else if (list.value !== '') this.show(list.value);
      list.value = '';
    });
    return list;
  }

  applyTheme(theme: string): void {
    document.documentElement.dataset.theme = theme;
    storage.setItem(themeKey, theme);
    this.dock.updateOptions({theme: theme === 'dark' ? themeDark : themeLight});
  }

  toggleTheme(): void {
    this.applyTheme(document.documentElement.dataset.theme === 'dark' ? 'light' : 'dark');
  }

  private show(id: string): void {
    const panel = this.dock.getPanel(id);
    if (panel) panel.api.setActive();
    else this.dock.addPanel({id, component: id, title: this.panels[id]!.title});
  }

  private restore(): void {
    try {
      const layout = storage.getItem(layoutKeys[this.room]);
      if (layout === null) return this.arrange();
      this.dock.fromJSON(JSON.parse(layout));
      if (this.dock.panels.length === 0) this.arrange();
    } catch {
      this.arrange();
    }
  }

  /** Puts all panels where they usually are. */
  private arrange(): void {
    this.dock.clear();
    if (this.room === 'wide') this.arrangeWide();
    else this.arrangeNarrow();
    for (const id of ['console', 'tree', 'properties', 'editor'])
      this.dock.getPanel(id)!.api.setActive();
  }

  private add(id: string, reference?: string, direction: Direction = 'right'): void {
    this.dock.addPanel({
      id, component: id, title: this.panels[id]!.title,
      ...(reference ? {position: {referencePanel: reference, direction}} : {})});
  }

  /** Sizes hold once the panels have been laid out. */
  private size(id: string, size: {width?: number; height?: number}): void {
    this.dock.getPanel(id)!.group.api.setSize(size);
  }

  private arrangeWide(): void {
    const {innerWidth: width, innerHeight: height} = window;
    this.add('editor');
    this.add('view', 'editor', 'right');
    this.add('tree', 'view', 'right');
    this.add('properties', 'tree', 'below');
    this.add('console', 'view', 'below');
    this.add('queue', 'console', 'within');
    this.add('statistics', 'console', 'within');
    this.size('editor', {width: width * 0.32});
    this.size('tree', {width: width * 0.24});
    this.size('tree', {height: height * 0.4});
    this.size('console', {height: height * 0.22});
  }

  /** The picture has all of the width. The other panels are below, side by side if they can be. */
  private arrangeNarrow(): void {
    this.add('view');
    this.add('editor', 'view', 'below');
    if (this.room === 'upright') {
      this.add('tree', 'editor', 'right');
      this.add('properties', 'tree', 'within');
    } else {
      this.add('tree', 'editor', 'within');
      this.add('properties', 'editor', 'within');
    }
    for (const id of ['console', 'queue', 'statistics']) this.add(id, 'editor', 'within');
    this.size('view', {height: window.innerHeight * 0.48});
    if (this.room === 'upright') this.size('tree', {width: window.innerWidth * 0.42});
  }
}
