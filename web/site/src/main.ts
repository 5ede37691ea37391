// The page: hands of a pointer, a recording, a camera or a headset stroke an object, as tracked
// and as corrected.
import * as THREE from 'three';

import {load} from '../../src/index.js';
import type {Hand, Nade, Scene, Side} from '../../src/index.js';
import {mirrored, PointerHand} from '../../src/pointer.js';
import type {Aim} from '../../src/pointer.js';
import {readRecording} from '../../src/recording.js';
import {Camera, withPalmOf} from './camera.js';
import {Controls, METHODS} from './controls.js';
import {ShownHand, SIDES} from './hands.js';
import type {TrackedHands} from './hands.js';
import {FIRST_OBJECT_ID, Headset} from './headset.js';
import {hookOf} from './hook.js';
import {ball, dog, own, plane} from './objects.js';
import type {Thing} from './objects.js';
import {Replay} from './replay.js';
import type {Key} from './spacepanel.js';
import {shadeBy, Stage} from './stage.js';
import {askForCamera, replaySpeed, say, showDialogs, showFigures, showHeadsets, showReplay,
        showSource, unsay} from './words.js';

const POINTER_SIDE = 'right';
const PRESSED_M = 0.022;  // as the panel's slider begins
const LONGEST_STEP_S = 0.05;
const MOST_SPENT = 600;
const INWARD = Math.PI / 6;  // a pointer's hand comes so far from its own side, one in a picture does not

const canvas = document.querySelector<HTMLCanvasElement>('#stage')!;
const video = document.querySelector<HTMLVideoElement>('#video')!;

export class Page {
  readonly shown: Partial<Record<Side, ShownHand>> = {};
  readonly controls: Controls;
  readonly headset: Headset;
  replay: Replay | null = null;
  camera: Camera | null = null;
  /** What the latest frames took, milliseconds: correcting and flattening, and all but drawing. */
  readonly spent: {correctMs: number; allMs: number}[] = [];
  private readonly things: Record<string, Thing>;
  private readonly pointers: Record<Side, PointerHand>;
  private readonly scene: Scene;
  private readonly loading = new Set<Side>();
  private current = '';
  private source = '';
  private objectId = FIRST_OBJECT_ID;
  private wasWorn = false;
  private before = 0;
  /** Milliseconds that the correctors have been told of. */
  private clock = 0;

  constructor(private readonly nade: Nade, readonly stage: Stage, relaxed: Record<Side, Hand>,
              dogThing: Thing, first: ShownHand) {
    this.things = {dog: dogThing, ball: ball(nade), plane: plane(nade)};
    this.scene = nade.scene();
    this.pointers = {left: new PointerHand(relaxed.left, 'left'),
                     right: new PointerHand(relaxed.right, 'right')};
    this.pointers.right.settings.depth = PRESSED_M;
    this.shown[first.side] = first;
    this.headset = new Headset(nade, stage, this.scene, () => this.keys());
    this.controls = new Controls(canvas, Object.keys(this.things), {
      settings: () => this.pointers[POINTER_SIDE].settings, view: () => stage.view,
      handAt: () => this.handAt(), dropped: (file) => void this.take(file),
      pause: () => this.replay?.toggle()});
    showReplay(() => this.replay);
    showDialogs();
    void showHeadsets((mode) => this.headset.enter(mode, () => {
      this.controls.wishes.pointer = null;
    }));
  }

  get thing(): Thing { return this.things[this.current]; }

  frame(now: number, xrFrame?: XRFrame): void {
    const start = performance.now();
    const seconds = Math.min(LONGEST_STEP_S, Math.max(1e-3, (now - this.before) / 1000));
    this.before = now;
    const {wishes} = this.controls;
    const isWorn = this.headset.isWorn;
    if (wishes.object !== this.current || isWorn !== this.wasWorn) this.turnTo(wishes.object, isWorn);
    if (wishes.source !== this.source) this.follow(wishes.source);
    this.live(seconds);
    const asked = performance.now();
    const tracked = isWorn ? xrFrame ? this.headset.hands(xrFrame, seconds) : {} :
      this.tracked(seconds);
    // It is the browser that gives a headset's hands.
    const askedMs = isWorn ? performance.now() - asked : 0;
    const correctMs = this.correct(tracked, seconds);
    const drawn = SIDES.flatMap((side) => this.shown[side]?.result?.joints ?? []);
    if (isWorn) this.headset.panel.update(drawn);
    shadeBy(drawn);
    showFigures(now, {hands: Object.values(this.shown), correctMs,
                      refitMs: wishes.alive && this.thing.living ? this.thing.living.refitMs : null,
                      camera: this.camera, replay: this.replay});
    this.spent.push({correctMs, allMs: performance.now() - start - askedMs});
    if (this.spent.length > MOST_SPENT) this.spent.shift();
    this.stage.draw(seconds);
  }

  private correct(tracked: TrackedHands, seconds: number): number {
    const {wishes} = this.controls;
    // Slow motion is slow for the hand alone: the correction is that of the recording's speed.
    const {replay} = this;
    this.clock += 1000 * seconds * (replay?.playing && !this.headset.isWorn ? replay.speed : 1);
    let spent = 0;
    for (const side of SIDES) {
      if (tracked[side]) this.need(side);
      const hand = this.shown[side];
      if (!hand) continue;
      hand.correctBy(wishes.method);
      spent += hand.update(tracked[side], this.scene, this.clock);
      hand.draw(wishes.ghost);
    }
    return spent;
  }

  /** A side's model is loaded when it is seen for the first time. */
  private need(side: Side): void {
    if (this.shown[side] || this.loading.has(side)) return;
    this.loading.add(side);
    ShownHand.load(this.nade, side, this.stage.scene).then(
      (hand) => { this.shown[side] = hand; },
      () => {
        this.loading.delete(side);
        say(`The ${side} hand could not be loaded.`, 6);
      });
  }

  private live(seconds: number): void {
    if (this.thing.living?.update(seconds, this.controls.wishes.alive) && this.isInScene()) {
      this.scene.deformed(this.objectId);
    }
  }

  /** In a headset the plane is the table's top, which is there anyway. */
  private isInScene(): boolean { return !(this.wasWorn && this.current === 'plane'); }

  private turnTo(name: string, isWorn: boolean): void {
    const isFirst = this.current === '';
    if (!isFirst) {
      this.stage.scene.remove(this.thing.root);
      if (this.isInScene()) this.scene.remove(this.objectId);
    }
    this.current = name;
    this.wasWorn = isWorn;
    const {thing} = this;
    this.stage.scene.add(thing.root);
    if (this.isInScene()) this.scene.add(++this.objectId, thing.surface, thing.placement);
    if (isWorn) return;
    this.stage.view = {...thing.view};
    if (isFirst) this.stage.settle();
    this.placePointers();
    this.replay?.placeOn(thing, name);
    for (const hand of Object.values(this.shown)) hand.reset();
  }

  private placePointers(): void {
    const {x, y, z} = this.thing.stroke(this.clock / 1000);
    for (const side of SIDES) this.pointers[side].place(this.thing, [x, y, z], [0, 0, -1]);
  }

  private follow(source: string): void {
    this.source = source;
    this.camera?.close();
    this.camera = null;
    showSource(source);
    if (source !== 'replay') this.replay = null;
    if (source === 'pointer') this.placePointers();
    if (source === 'replay' && !this.replay) void this.playStroke();
    if (source === 'camera') void this.openCamera();
  }

  private tracked(seconds: number): TrackedHands {
    if (this.replay) {
      if (this.replay.advance(seconds)) for (const hand of Object.values(this.shown)) hand.reset();
      return this.replay.hands();
    }
    if (this.camera) return this.seen(this.camera, seconds);
    if (this.source !== 'pointer') return {};
    const at = this.controls.wishes.pointer;
    const ray = at ? this.stage.ray(at.x, at.y) : this.ownStroke();
    return {[POINTER_SIDE]: this.pointers[POINTER_SIDE].update(this.thing, this.aim(ray), seconds)};
  }

  private seen(camera: Camera, seconds: number): TrackedHands {
    const hands: TrackedHands = {};
    for (const side of SIDES) {
      const seen = camera.seen[side];
      if (!seen) continue;
      const pointer = this.pointers[side];
      pointer.settings.depth = this.pointers[POINTER_SIDE].settings.depth;
      const ray = this.stage.ray(seen.place.x * canvas.clientWidth,
                                 seen.place.y * canvas.clientHeight);
      const {turn} = pointer.settings;
      pointer.settings.turn = seen.turn + (side === 'right' ? -INWARD : INWARD);
      hands[side] = withPalmOf(seen.hand, pointer.update(this.thing, this.aim(ray), seconds));
      pointer.settings.turn = turn;
    }
    return hands;
  }

  private aim({origin, direction}: THREE.Ray): Aim {
    const {elements} = this.stage.camera.matrixWorld;
    return {ray: {origin: origin.toArray(), direction: direction.toArray()},
            ahead: [-elements[8], -elements[9], -elements[10]],
            up: [elements[4], elements[5], elements[6]]};
  }

  /** Until a pointer comes the hand strokes by itself. */
  private ownStroke(): THREE.Ray {
    const origin = this.stage.camera.position;
    return new THREE.Ray(origin, this.thing.stroke(this.clock / 1000).sub(origin).normalize());
  }

  private handAt(): {x: number; y: number} {
    const joints = this.shown[POINTER_SIDE]?.result?.joints;
    const point = joints ? new THREE.Vector3().fromArray(joints, 4) : this.thing.stroke(0);
    point.project(this.stage.camera);
    return {x: (point.x + 1) / 2 * canvas.clientWidth, y: (1 - point.y) / 2 * canvas.clientHeight};
  }

  /** The panel in a headset. */
  private keys(): Key[][] {
    const {controls} = this;
    const {wishes} = controls;
    return [
      METHODS.map((text) => ({text, isChosen: () => wishes.method === text,
                              press: () => controls.choose('methods', text)})),
      controls.objects().map((text) => ({text, isChosen: () => wishes.object === text,
                                         press: () => controls.choose('objects', text)})),
      [{text: 'tracked hand', isChosen: () => wishes.ghost, press: () => controls.toggle('ghost')},
       {text: 'breathing', isChosen: () => wishes.alive, press: () => controls.toggle('alive')},
       {text: 'leave', isChosen: () => false, press: () => this.headset.leave()}],
    ];
  }

  private async playStroke(): Promise<void> {
    try {
      const response = await fetch('stroke.jsonl.gz');
      if (!response.ok) throw new Error(`stroke.jsonl.gz: ${response.status}`);
      const recording = await readRecording(await response.arrayBuffer());
      if (this.source === 'replay' && !this.replay) this.play(new Replay(recording));
    } catch (error) {
      this.failed(error as Error);
    }
  }

  private play(replay: Replay): void {
    this.replay = replay;
    replay.speed = replaySpeed();
    replay.placeOn(this.thing, this.current);
    for (const hand of Object.values(this.shown)) hand.reset();
  }

  private async openCamera(): Promise<void> {
    if (!await askForCamera()) {
      this.controls.choose('sources', 'pointer');
      return;
    }
    say('Starting the camera …');
    try {
      const camera = await Camera.open(video, (error) => {
        if (this.source === 'camera') this.failed(error);
      });
      unsay();
      if (this.source === 'camera') this.camera = camera;
      else camera.close();
    } catch (error) {
      this.failed(error as Error);
    }
  }

  private failed(error: Error): void {
    say(`${error.message}.`, 6);
    this.controls.choose('sources', 'pointer');
  }

  /** A file that was dropped: an object, or a recording. */
  private async take(file: File): Promise<void> {
    say(`Reading ${file.name} …`);
    try {
      if (/\.jsonl(\.gz)?$/i.test(file.name)) await this.takeRecording(file);
      else await this.takeObject(file);
      unsay();
    } catch (error) {
      say(`${file.name}: ${(error as Error).message}`, 6);
    }
  }

  private async takeRecording(file: File): Promise<void> {
    this.play(new Replay(await readRecording(await file.arrayBuffer())));
    this.controls.choose('sources', 'replay');
  }

  private async takeObject(file: File): Promise<void> {
    const thing = await own(this.nade, file);
    const before = this.things.own;
    if (this.current === 'own') {
      this.stage.scene.remove(before.root);
      this.scene.remove(this.objectId);
      this.current = '';
    }
    this.things.own = thing;
    before?.surface.destroy();
    this.controls.choose('objects', 'own');
  }
}

async function start(): Promise<void> {
  const stage = new Stage(canvas);
  const nade = await load('nade.wasm');
  const [recording, dogThing, first] = await Promise.all([
    fetch('relaxed.jsonl').then((response) => response.text()).then(readRecording), dog(nade),
    ShownHand.load(nade, POINTER_SIDE, stage.scene)]);
  const [{left, right}] = recording.frames;
  const relaxed = right?.joints ?? (left ? mirrored(left.joints) : nade.restHand('right'));
  const page = new Page(nade, stage, {left: left?.joints ?? mirrored(relaxed), right: relaxed},
                        dogThing, first);
  window.nadePage = hookOf(page);
  stage.renderer.setAnimationLoop((now, frame) => page.frame(now, frame));
  await navigator.serviceWorker?.register('sw.js').catch(() => null);  // without it: online only
}

start().catch((error: Error) => say(`This browser cannot show it: ${error.message}`));
