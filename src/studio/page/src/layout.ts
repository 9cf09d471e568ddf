// Where the panels are, and the theme. The browser keeps both.

import {createDockview, themeDark, themeLight, type DockviewApi} from 'dockview-core';
import {storage} from './storage';

export interface PanelContent {
  title: string;
  element: HTMLElement;
}

type Direction = 'right' | 'below' | 'within';

const layoutKey = 'crt-studio:layout';
const themeKey = 'crt-studio:theme';

export class Layout {
  readonly dock: DockviewApi;

  constructor(private readonly panels: Record<string, PanelContent>) {
    this.dock = createDockview(document.getElementById('dock')!, {
      theme: themeDark,
      createComponent: ({name}) => ({element: this.panels[name]!.element, init: () => undefined}),
    });
    this.applyTheme(storage.getItem(themeKey) ??
      (matchMedia('(prefers-color-scheme: light)').matches ? 'light' : 'dark'));
  }

  /** Puts the panels where they were, or `only` one, once the page has its other parts. */
  start(only?: string): void {
    const {clientWidth, clientHeight} = document.getElementById('dock')!;
    this.dock.layout(clientWidth, clientHeight);
    if (only !== undefined && this.panels[only]) {
      this.show(only);
      this.dock.getPanel(only)!.group.header.hidden = true;
      return;
    }
    this.restore();
    this.dock.onDidLayoutChange(() =>
      storage.setItem(layoutKey, JSON.stringify(this.dock.toJSON())));
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
      const layout = storage.getItem(layoutKey);
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
    const {innerWidth: width, innerHeight: height} = window;
    const add = (id: string, reference?: string, direction: Direction = 'right') =>
      this.dock.addPanel({
        id, component: id, title: this.panels[id]!.title,
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
    this.dock.getPanel('editor')!.group.api.setSize({width: width * 0.33});
    this.dock.getPanel('tree')!.group.api.setSize({width: width * 0.23});
    this.dock.getPanel('tree')!.group.api.setSize({height: height * 0.4});
    this.dock.getPanel('console')!.group.api.setSize({height: height * 0.22});
  }
}
