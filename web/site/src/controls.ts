// Mouse, fingers, keys, and the panel; all of them change the same wishes.
import type {Method} from '../../src/index.js';
import type {PointerSettings} from '../../src/pointer.js';
import type {View} from './stage.js';

export const METHODS: readonly Method[] = ['none', 'paper', 'nade'];
export const SOURCES = ['pointer', 'replay', 'camera'] as const;
export type Source = typeof SOURCES[number];
/** The lists of the panel of which one is chosen. */
export type Choice = 'methods' | 'objects' | 'sources';

/** A finger would cover the hand. */
const TOUCH_LIFT_PX = 70;
const PRESS_PER_WHEEL_M = 4e-5;
const PRESS_PER_PX_M = 1.5e-4;
const TURN_PER_PX = 0.006;
const STEP_PX = 14;
const TURN_STEP_PX = 20;

const KEYS: Record<string, [keyof PointerSettings, number]> = {
  q: ['tilt', -0.05], e: ['tilt', 0.05], a: ['turn', 0.08], d: ['turn', -0.08],
  c: ['curl', 0.08], v: ['curl', -0.08], s: ['spread', 0.1], x: ['spread', -0.1],
  r: ['roll', 0.05], f: ['roll', -0.05], w: ['depth', 0.002], z: ['depth', -0.002],
};
const ARROWS: Record<string, [number, number]> = {
  arrowleft: [-1, 0], arrowright: [1, 0], arrowup: [0, -1], arrowdown: [0, 1],
};
const RANGES: Record<keyof PointerSettings, [number, number]> = {
  depth: [-0.03, 0.05], tilt: [-0.6, 0.6], roll: [-0.8, 0.8], turn: [-3, 3], curl: [-0.4, 1],
  spread: [-0.5, 1],
};

export interface Wishes {
  method: Method;
  object: string;
  source: Source;
  ghost: boolean;
  alive: boolean;
  /** Where the pointer is, pixels; null until it has moved. */
  pointer: {x: number; y: number} | null;
}

/** What the controls ask of the page. */
export interface Listener {
  settings(): PointerSettings;
  view(): View;
  /** Where the hand is in the window, pixels. */
  handAt(): {x: number; y: number};
  dropped(file: File): void;
  pause(): void;
}

export class Controls {
  readonly wishes: Wishes = {method: 'nade', object: 'dog', source: 'pointer', ghost: false,
                             alive: false, pointer: null};
  private readonly panel = document.querySelector<HTMLFormElement>('#panel')!;
  private readonly fingers = new Map<number, PointerEvent>();

  constructor(private readonly canvas: HTMLCanvasElement, objects: readonly string[],
              private readonly listener: Listener) {
    const {wishes} = this;
    this.choices('sources', SOURCES, wishes.source, (value) => { wishes.source = value as Source; });
    this.choices('methods', METHODS, wishes.method, (value) => { wishes.method = value as Method; });
    this.choices('objects', objects, wishes.object, (value) => { wishes.object = value; });
    this.panel.addEventListener('submit', (event) => event.preventDefault());
    for (const slide of this.panel.querySelectorAll<HTMLInputElement>('.pose input[type=range]')) {
      slide.addEventListener('input', () => {
        listener.settings()[slide.name as keyof PointerSettings] = Number(slide.value);
      });
    }
    for (const name of ['ghost', 'alive'] as const) {
      const box = this.box(name);
      box.addEventListener('change', () => { wishes[name] = box.checked; });
    }
    this.listenToPointer();
    this.listenToKeys();
    this.listenToFiles();
  }

  /** Chooses in the panel, where it is one more choice if it is not there yet. */
  choose(set: Choice, value: string): void {
    if (set === 'objects' && !this.option(set, value)) {
      this.choices(set, [value], value, (chosen) => { this.wishes.object = chosen; });
    }
    const option = this.option(set, value)!;
    option.checked = true;
    option.dispatchEvent(new Event('change'));
  }

  objects(): string[] {
    return [...document.querySelectorAll<HTMLInputElement>('#objects input')].map(({value}) => value);
  }

  toggle(name: 'ghost' | 'alive'): void { this.box(name).click(); }

  private box(name: string): HTMLInputElement {
    return this.panel.elements.namedItem(name) as HTMLInputElement;
  }
  private option(set: Choice, value: string): HTMLInputElement | null {
    return document.querySelector(`#${set} [value="${value}"]`);
  }

  private choices(set: Choice, values: readonly string[], chosen: string,
                  choose: (value: string) => void): void {
    for (const value of values) {
      const label = document.createElement('label');
      const input = Object.assign(document.createElement('input'), {
        type: 'radio', name: set, value, checked: value === chosen});
      const text = document.createElement('span');
      text.textContent = value;
      input.addEventListener('change', () => choose(value));
      label.append(input, text);
      document.querySelector(`#${set}`)!.append(label);
    }
  }

  private change(name: keyof PointerSettings, by: number): void {
    const [low, high] = RANGES[name];
    const settings = this.listener.settings();
    settings[name] = Math.min(high, Math.max(low, settings[name] + by));
    const slide = this.panel.elements.namedItem(name) as HTMLInputElement | null;
    if (slide) slide.value = String(settings[name]);
  }

  private orbit(x: number, y: number): void {
    const view = this.listener.view();
    view.around -= TURN_PER_PX * x;
    view.up = Math.min(1.4, Math.max(0.02, view.up + TURN_PER_PX * y));
  }

  private listenToPointer(): void {
    const {canvas, fingers} = this;
    canvas.addEventListener('pointerdown', (event) => {
      canvas.setPointerCapture(event.pointerId);
      fingers.set(event.pointerId, event);
      this.pointerMoved(event);
    });
    canvas.addEventListener('pointermove', (event) => this.pointerMoved(event));
    for (const name of ['pointerup', 'pointercancel'] as const) {
      canvas.addEventListener(name, (event) => fingers.delete(event.pointerId));
    }
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.change('depth', PRESS_PER_WHEEL_M * event.deltaY);
    }, {passive: false});
  }

  private listenToKeys(): void {
    addEventListener('keydown', (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      if (document.querySelector('dialog[open]')) return;
      const inControl = event.target instanceof HTMLInputElement ||
                        event.target instanceof HTMLButtonElement;
      const key = event.key.toLowerCase();
      const arrow = ARROWS[key];
      if (inControl && (arrow || key === ' ')) return;
      if (arrow) {
        event.preventDefault();
        if (event.shiftKey) this.orbit(TURN_STEP_PX * -arrow[0], TURN_STEP_PX * -arrow[1]);
        else this.step(...arrow);
      }
      if (key === ' ') this.listener.pause();
      if (KEYS[key]) this.change(...KEYS[key]);
      if (key === 'g') this.toggle('ghost');
      if (key === 'b') this.toggle('alive');
      const method = METHODS[Number(key) - 1];
      if (method) this.choose('methods', method);
    });
  }

  private listenToFiles(): void {
    const file = document.querySelector<HTMLInputElement>('#own')!;
    file.addEventListener('change', () => {
      if (file.files?.[0]) this.listener.dropped(file.files[0]);
      file.value = '';
    });
    addEventListener('dragover', (event) => event.preventDefault());
    addEventListener('drop', (event) => {
      event.preventDefault();
      const first = event.dataTransfer?.files[0];
      if (first) this.listener.dropped(first);
    });
  }

  /** Moves the hand by a step of the keys. */
  private step(right: number, down: number): void {
    const {x, y} = this.wishes.pointer ?? this.listener.handAt();
    const {clientWidth, clientHeight} = this.canvas;
    this.wishes.pointer = {x: Math.min(clientWidth, Math.max(0, x + STEP_PX * right)),
                           y: Math.min(clientHeight, Math.max(0, y + STEP_PX * down))};
  }

  private pointerMoved(event: PointerEvent): void {
    const before = this.fingers.get(event.pointerId);
    if (before) this.fingers.set(event.pointerId, event);
    const [x, y] = before ? [event.clientX - before.clientX, event.clientY - before.clientY] : [0, 0];
    if (event.pointerType !== 'touch') {
      if (event.buttons & 2) return this.orbit(x, y);
      this.wishes.pointer = {x: event.clientX, y: event.clientY};
    } else if (event.isPrimary) {
      this.wishes.pointer = {x: event.clientX, y: event.clientY - TOUCH_LIFT_PX};
    } else {
      this.change('depth', PRESS_PER_PX_M * y);
      this.orbit(x, 0);
    }
  }
}
