// Mouse, fingers, keys, and the panel; all of them change the same settings.
import type {Method} from '../../src/index.js';
import type {PointerSettings} from '../../src/pointer.js';
import type {View} from './stage.js';

const METHODS: readonly Method[] = ['none', 'paper', 'nade'];
/** A finger would cover the hand. */
const TOUCH_LIFT_PX = 70;
const PRESS_PER_WHEEL_M = 4e-5;
const PRESS_PER_PX_M = 1.5e-4;
const TURN_PER_PX = 0.006;

const KEYS: Record<string, [keyof PointerSettings, number]> = {
  q: ['tilt', -0.05], e: ['tilt', 0.05], a: ['turn', 0.08], d: ['turn', -0.08],
  c: ['curl', 0.08], v: ['curl', -0.08], s: ['spread', 0.1], x: ['spread', -0.1],
  r: ['roll', 0.05], f: ['roll', -0.05], w: ['depth', 0.002], z: ['depth', -0.002],
};
const RANGES: Record<keyof PointerSettings, [number, number]> = {
  depth: [-0.03, 0.05], tilt: [-0.6, 0.6], roll: [-0.8, 0.8], turn: [-3, 3], curl: [-0.4, 1],
  spread: [-0.5, 1],
};

export interface Wishes {
  method: Method;
  object: string;
  ghost: boolean;
  /** Where the pointer is, pixels; null until it has moved. */
  pointer: {x: number; y: number} | null;
}

export class Controls {
  readonly wishes: Wishes = {method: 'nade', object: 'dog', ghost: false, pointer: null};
  private readonly panel = document.querySelector<HTMLFormElement>('#panel')!;
  private readonly fingers = new Map<number, PointerEvent>();

  constructor(private readonly canvas: HTMLCanvasElement,
              private readonly settings: () => PointerSettings, private readonly view: () => View,
              objects: readonly string[], private readonly dropped: (file: File) => void) {
    this.choices('methods', METHODS, this.wishes.method, (value) => {
      this.wishes.method = value as Method;
    });
    this.choices('objects', objects, this.wishes.object, (value) => { this.wishes.object = value; });
    this.panel.addEventListener('submit', (event) => event.preventDefault());
    for (const slide of this.panel.querySelectorAll<HTMLInputElement>('input[type=range]')) {
      slide.addEventListener('input', () => {
        this.settings()[slide.name as keyof PointerSettings] = Number(slide.value);
      });
    }
    const ghost = this.panel.elements.namedItem('ghost') as HTMLInputElement;
    ghost.addEventListener('change', () => { this.wishes.ghost = ghost.checked; });
    this.listen(ghost);
  }

  /** One more object to choose, chosen. */
  choose(object: string): void {
    const list = document.querySelector('#objects')!;
    if (!list.querySelector(`[value="${object}"]`)) {
      this.choices('objects', [object], object, (value) => { this.wishes.object = value; });
    }
    list.querySelector<HTMLInputElement>(`[value="${object}"]`)!.checked = true;
    this.wishes.object = object;
  }

  private choices(set: string, values: readonly string[], chosen: string,
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
    const value = Math.min(high, Math.max(low, this.settings()[name] + by));
    this.settings()[name] = value;
    const slide = this.panel.elements.namedItem(name) as HTMLInputElement | null;
    if (slide) slide.value = String(value);
  }

  private orbit(x: number, y: number): void {
    const view = this.view();
    view.around -= TURN_PER_PX * x;
    view.up = Math.min(1.4, Math.max(0.02, view.up + TURN_PER_PX * y));
  }

  private listen(ghost: HTMLInputElement): void {
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
    addEventListener('keydown', (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      if (event.target instanceof HTMLInputElement && event.key.startsWith('Arrow')) return;
      const key = event.key.toLowerCase();
      const change = KEYS[key];
      if (change) this.change(...change);
      if (key === 'g') ghost.click();
      if (key === 'arrowleft') this.orbit(20, 0);
      if (key === 'arrowright') this.orbit(-20, 0);
      if (key === 'arrowup') this.orbit(0, 20);
      if (key === 'arrowdown') this.orbit(0, -20);
      const method = METHODS[Number(key) - 1];
      if (method) this.panel.querySelector<HTMLInputElement>(`[value=${method}]`)!.click();
    });
    const file = document.querySelector<HTMLInputElement>('#own')!;
    file.addEventListener('change', () => { if (file.files?.[0]) this.dropped(file.files[0]); });
    addEventListener('dragover', (event) => event.preventDefault());
    addEventListener('drop', (event) => {
      event.preventDefault();
      const first = event.dataTransfer?.files[0];
      if (first) this.dropped(first);
    });
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
