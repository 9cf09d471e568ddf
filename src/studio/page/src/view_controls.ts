// The bar below the picture: what of the scene the view shows, and how.

import type {Comparison} from './comparison';
import {DisplayControls} from './display_controls';
import {button, choice, input, labelled} from './dom';
import type {Box, Pick, Vector} from './protocol';
import {SectionControls} from './section_controls';
import {TimeControls} from './time_controls';
import {modes, type ViewState} from './view_state';

const channels = [
  ['color', 'Picture'], ['depth', 'Depth'], ['normal', 'Normals'], ['id', 'Entities'],
  ['part', 'Parts'], ['albedo', 'Colours of materials'], ['samples', 'Samples'],
  ['error', 'Error']] as const;

const short = (value: number): string => String(Number(value.toPrecision(4)));

export interface ControlsHost {
  askBoxes(): Promise<Box[]>;
  /** Returns where the camera is. */
  viewer(): Vector;
  /** Counts the pictures that were shown. */
  countShown(): number;
  boundsChanged(): void;
  /** Says whether the next drag in the picture chooses a region. */
  regionWanted(isWanted: boolean): void;
  /** Says whether clicks measure how far places are apart. */
  rulerWanted(isWanted: boolean): void;
}

export class ViewControls {
  readonly element = document.createElement('div');
  private readonly section: SectionControls;
  private readonly time: TimeControls;
  private readonly display: DisplayControls;
  private readonly mode: HTMLSelectElement;
  private readonly channel: HTMLSelectElement;
  private readonly region: HTMLButtonElement;
  private readonly whole: HTMLButtonElement;
  private readonly all: HTMLButtonElement;
  private readonly ruler: HTMLButtonElement;
  private readonly bounds: HTMLInputElement;
  private readonly cutters: HTMLInputElement;
  private readonly place = document.createElement('output');

  constructor(private readonly state: ViewState, comparison: Comparison,
              private readonly host: ControlsHost) {
    this.element.className = 'controls';
    this.element.setAttribute('role', 'toolbar');
    this.element.setAttribute('aria-label', 'What the view shows');
    this.mode = choice('Mode', modes, (mode) => state.setMode(mode));
    this.mode.title = 'The scene as it is, its materials in a studio, or its shapes in clay (M)';
    this.channel = choice('Channel', channels, (channel) => state.set({channel}));
    this.section = new SectionControls((section) => state.set({section}), () => host.askBoxes(),
                                       () => host.viewer());
    this.time = new TimeControls((t) => state.set({t}), () => host.countShown());
    this.display = new DisplayControls((options) => state.set(options),
                                       (isWanted) => state.setDenoise(isWanted));
    this.bounds = input('checkbox', 'Bounds', '', () => host.boundsChanged());
    this.region = button('Region', 'Drag a part of the picture, to refine it alone (Ctrl and drag)',
                         () => this.wantRegion(!this.wantsRegion));
    this.whole = button('Whole picture', 'Refine all of the picture again (Escape)', () =>
      state.set({region: null}));
    this.all = button('Show all', 'Show what was hidden in the scene tree', () =>
      state.set({hidden: []}));
    this.ruler = button('Measure', 'Click two places, to see how far they are apart', () =>
      this.wantRuler(this.ruler.getAttribute('aria-pressed') !== 'true'));
    this.cutters = input('checkbox', 'Cutters', '', () => host.boundsChanged());
    const bounds = labelled('Bounds');
    bounds.title = 'Draw the boxes around entities';
    bounds.prepend(this.bounds);
    const cutters = labelled('Cutters');
    cutters.title = 'Draw the boxes around what is cut away';
    cutters.prepend(this.cutters);
    this.element.append(this.mode, this.channel, bounds, cutters, this.section.element, comparison.controls,
                        this.region, this.whole, this.all, this.ruler, this.display.element,
                        this.time.element, this.place);
    this.place.title = 'Where the picture was clicked last';
    this.region.setAttribute('aria-pressed', 'false');
    this.ruler.setAttribute('aria-pressed', 'false');
    this.update();
  }

  /** Lets clicks measure how far places are apart, or not. */
  wantRuler(isWanted: boolean): void {
    this.ruler.setAttribute('aria-pressed', String(isWanted));
    this.host.rulerWanted(isWanted);
  }

  /** Shows a text where that of the last click stands. */
  say(text: string): void {
    this.place.textContent = text;
  }

  private get wantsRegion(): boolean {
    return this.region.getAttribute('aria-pressed') === 'true';
  }

  /** Lets the next drag choose a region, or not. */
  wantRegion(isWanted: boolean): void {
    this.region.setAttribute('aria-pressed', String(isWanted));
    this.host.regionWanted(isWanted);
  }

  get showsCutters(): boolean {
    return this.cutters.checked;
  }

  get showsBounds(): boolean {
    return this.bounds.checked;
  }

  /** Shows where the picture was clicked. */
  showPick(pick: Pick | null): void {
    this.place.textContent = pick === null ? '' :
      `${short(pick.distance)} away, at ${pick.position.map(short).join(', ')}`;
  }

  setTime(readsTime: boolean, frames: number): void {
    this.time.setUsed(readsTime);
    this.time.setFrames(frames);
  }

  /** Shows the mode and the exposure, and the controls that undo what is in effect. */
  update(): void {
    this.mode.value = this.state.options.mode;
    this.display.update(this.state.options);
    this.whole.hidden = this.state.options.region === null;
    this.region.hidden = !this.whole.hidden;
    this.all.hidden = this.state.options.hidden.length === 0;
  }

  /** Shows all of another script. */
  reset(): void {
    this.state.reset();
    this.section.reset();
    this.time.reset();
    this.update();
  }
}
