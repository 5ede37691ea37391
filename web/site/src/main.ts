// The page: a hand under the pointer strokes an object, as tracked and as corrected.
import {load} from '../../src/index.js';
import type {Corrector, Method, Nade} from '../../src/index.js';
import {mirrored, PointerHand} from '../../src/pointer.js';
import type {Aim} from '../../src/pointer.js';
import {readRecording} from '../../src/recording.js';
import {Controls} from './controls.js';
import {DrawnHand} from './hands.js';
import {ball, dog, own, plane} from './objects.js';
import type {Thing} from './objects.js';
import {shadeBy, Stage} from './stage.js';

const SIDE = 'right';
const PRESSED_M = 0.022;  // as the panel's slider begins
const LONGEST_STEP_S = 0.05;
const FIGURES_EACH_S = 0.25;

const canvas = document.querySelector<HTMLCanvasElement>('#stage')!;
const notice = document.querySelector<HTMLElement>('#notice')!;
const moment = document.querySelector<HTMLElement>('#moment')!;

function say(sentence: string, seconds = Infinity): void {
  notice.textContent = sentence;
  notice.hidden = false;
  if (Number.isFinite(seconds)) setTimeout(() => { notice.hidden = true; }, 1000 * seconds);
}

class Page {
  private readonly things: Record<string, Thing>;
  private readonly hand: PointerHand;
  private readonly controls: Controls;
  private current = '';
  private method: Method = 'nade';
  private corrector: Corrector;
  private before = 0;
  private figuresAt = 0;
  private spent: number[] = [];

  constructor(private readonly nade: Nade, private readonly stage: Stage,
              relaxed: ConstructorParameters<typeof PointerHand>[0], dogThing: Thing,
              private readonly skin: DrawnHand, private readonly ghost: DrawnHand) {
    this.things = {dog: dogThing, ball: ball(nade), plane: plane(nade)};
    this.hand = new PointerHand(relaxed, SIDE);
    this.hand.settings.depth = PRESSED_M;
    this.corrector = nade.corrector();
    stage.scene.add(skin.root, ghost.root);
    this.controls = new Controls(canvas, () => this.hand.settings, () => stage.view,
                                 Object.keys(this.things), (file) => void this.take(file));
  }

  frame(now: number): void {
    const seconds = Math.min(LONGEST_STEP_S, Math.max(1e-3, (now - this.before) / 1000));
    this.before = now;
    const {wishes} = this.controls;
    if (wishes.object !== this.current) this.turnTo(wishes.object, now);
    if (wishes.method !== this.method) {
      this.method = wishes.method;
      this.corrector.destroy();
      this.corrector = this.nade.corrector({method: this.method});
    }
    const thing = this.things[this.current];
    const tracked = this.hand.update(thing, this.aim(thing, now), seconds);
    const start = performance.now();
    const drawn = this.corrector.update(SIDE, tracked, thing.surface, now, thing.placement);
    this.spent.push(performance.now() - start);
    this.skin.show(drawn.joints);
    this.ghost.root.visible = wishes.ghost;
    if (wishes.ghost) this.ghost.show(tracked);
    shadeBy(drawn.joints);
    if (now - this.figuresAt > 1000 * FIGURES_EACH_S) {
      this.figuresAt = now;
      const deepest = drawn.contacts.reduce((most, {depth}) => Math.max(most, depth), 0);
      const mean = this.spent.reduce((sum, x) => sum + x, 0) / this.spent.length;
      this.spent = [];
      moment.textContent = drawn.contacts.length === 0 ?
        `${drawn.status} · ${mean.toFixed(2)} ms` :
        `${drawn.contacts.length} bones touch, ${(1000 * deepest).toFixed(0)} mm deep · ` +
        `${mean.toFixed(2)} ms`;
    }
    this.stage.draw(seconds);
  }

  private turnTo(name: string, now: number): void {
    const isFirst = this.current === '';
    if (!isFirst) this.stage.scene.remove(this.things[this.current].root);
    this.current = name;
    const thing = this.things[name];
    this.stage.scene.add(thing.root);
    this.stage.view = {...thing.view};
    if (isFirst) this.stage.settle();
    const {x, y, z} = thing.stroke(now / 1000);
    this.hand.place(thing, [x, y, z], [0, 0, -1]);
    this.corrector.reset();
  }

  /** Until a pointer comes the hand strokes by itself. */
  private aim(thing: Thing, now: number): Aim {
    const {camera} = this.stage;
    const [, upper, behind] = [0, 4, 8].map((i) => camera.matrixWorld.elements.slice(i, i + 3));
    const at = this.controls.wishes.pointer;
    const ray = at && this.stage.ray(at.x, at.y);
    const origin = ray ? ray.origin : camera.position;
    const way = ray ? ray.direction : thing.stroke(now / 1000).sub(camera.position).normalize();
    return {ray: {origin: [origin.x, origin.y, origin.z], direction: [way.x, way.y, way.z]},
            ahead: [-behind[0], -behind[1], -behind[2]], up: [upper[0], upper[1], upper[2]]};
  }

  private async take(file: File): Promise<void> {
    say(`Reading ${file.name} …`);
    try {
      const thing = await own(this.nade, file);
      if (this.current === 'own') this.stage.scene.remove(this.things.own.root);
      this.things.own?.surface.destroy();
      this.things.own = thing;
      if (this.current === 'own') this.turnTo('own', performance.now());
      this.controls.choose('own');
      notice.hidden = true;
    } catch (error) {
      say(`${file.name}: ${(error as Error).message}`, 6);
    }
  }
}

async function start(): Promise<void> {
  const stage = new Stage(canvas);
  const nade = await load('nade.wasm');
  const [recording, dogThing, skin, ghost] = await Promise.all([
    fetch('relaxed.jsonl').then((response) => response.text()).then(readRecording), dog(nade),
    DrawnHand.skin(), DrawnHand.ghost()]);
  const [first] = recording.frames;
  const relaxed = first.right?.joints ?? (first.left && mirrored(first.left.joints));
  const page = new Page(nade, stage, relaxed ?? nade.restHand(SIDE), dogThing, skin, ghost);
  const frame = (now: number) => {
    page.frame(now);
    requestAnimationFrame(frame);
  };
  requestAnimationFrame(frame);
}

start().catch((error: Error) => say(`This browser cannot show it: ${error.message}`));
