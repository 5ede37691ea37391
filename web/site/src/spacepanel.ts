// The panel in a headset: what the page's panel has, touched with the tip of an index finger.
import * as THREE from 'three';

import {JOINT_FLOATS, JOINT_NAMES} from '../../src/index.js';
import type {Hand} from '../../src/index.js';

const WIDTH_M = 0.3;
const HEIGHT_M = 0.21;
const PX_PER_M = 3200;
/** A tip that has come so near has touched; it has to go so far before it touches again. */
const TOUCHED_M = 0.006;
const LET_GO_M = 0.02;
/** So far behind it a tip is somewhere else. */
const THROUGH_M = 0.05;
const INDEX_TIP = JOINT_NAMES.indexOf('index-finger-tip');
const FONT = 'system-ui, "DejaVu Sans", sans-serif';

export interface Key {
  text: string;
  isChosen(): boolean;
  press(): void;
}

export class SpacePanel {
  readonly mesh: THREE.Mesh;
  /** A sentence below the keys. */
  sentence = '';
  private readonly pixels = document.createElement('canvas').getContext('2d')!;
  private readonly texture: THREE.CanvasTexture;
  private drawn = '';
  private touching: (Key | null)[] = [];
  private readonly tip = new THREE.Vector3();

  constructor(private readonly rows: () => Key[][]) {
    const {canvas} = this.pixels;
    [canvas.width, canvas.height] = [WIDTH_M * PX_PER_M, HEIGHT_M * PX_PER_M];
    this.texture = new THREE.CanvasTexture(canvas);
    this.texture.colorSpace = THREE.SRGBColorSpace;
    this.texture.anisotropy = 8;
    this.mesh = new THREE.Mesh(new THREE.PlaneGeometry(WIDTH_M, HEIGHT_M), new THREE.MeshBasicMaterial(
      {map: this.texture, transparent: true, toneMapped: false, fog: false}));
  }

  /** Where the key is that is the `which`-th of a row, in the panel's frame. */
  centerOf(row: number, which: number): THREE.Vector3 {
    const {x, y, width, height} = this.place(this.rows()[row].length, row, which);
    return new THREE.Vector3((x + width / 2) / PX_PER_M - WIDTH_M / 2,
                             HEIGHT_M / 2 - (y + height / 2) / PX_PER_M, 0);
  }

  /** Once a frame, with the hands that are drawn. */
  update(hands: readonly Hand[]): void {
    const rows = this.rows();
    this.mesh.updateWorldMatrix(true, false);
    hands.forEach((hand, which) => {
      this.tip.fromArray(hand, JOINT_FLOATS * INDEX_TIP + 4);
      this.mesh.worldToLocal(this.tip);
      const away = this.tip.z - (hand[JOINT_FLOATS * INDEX_TIP + 7] || 0);
      if (away > LET_GO_M || this.tip.z < -THROUGH_M) this.touching[which] = null;
      if (away > TOUCHED_M || this.tip.z < -THROUGH_M || this.touching[which]) return;
      const key = this.keyAt(rows, this.tip);
      if (!key) return;
      this.touching[which] = key;
      key.press();
    });
    this.draw(rows);
  }

  private keyAt(rows: Key[][], {x, y}: THREE.Vector3): Key | null {
    const px = (x + WIDTH_M / 2) * PX_PER_M;
    const py = (HEIGHT_M / 2 - y) * PX_PER_M;
    for (const [row, keys] of rows.entries()) {
      for (const [which, key] of keys.entries()) {
        const at = this.place(keys.length, row, which);
        if (px >= at.x && px <= at.x + at.width && py >= at.y && py <= at.y + at.height) return key;
      }
    }
    return null;
  }

  private place(count: number, row: number, which: number) {
    const {width} = this.pixels.canvas;
    const [edge, gap, height] = [40, 16, 130];
    const wide = (width - 2 * edge - gap * (count - 1)) / count;
    return {x: edge + which * (wide + gap), y: edge + row * (height + gap), width: wide, height};
  }

  private draw(rows: Key[][]): void {
    const shown = JSON.stringify([this.sentence, rows.map((keys) => keys.map((key) => (
      [key.text, key.isChosen()])))]);
    if (shown === this.drawn) return;
    this.drawn = shown;
    const {pixels} = this;
    const {width, height} = pixels.canvas;
    const box = (x: number, y: number, w: number, h: number, round: number, colour: string) => {
      pixels.fillStyle = colour;
      pixels.beginPath();
      pixels.roundRect(x, y, w, h, round);
      pixels.fill();
    };
    pixels.clearRect(0, 0, width, height);
    box(0, 0, width, height, 56, 'rgb(252 249 245 / 0.94)');
    pixels.textAlign = 'center';
    pixels.textBaseline = 'middle';
    rows.forEach((keys, row) => keys.forEach((key, which) => {
      const at = this.place(keys.length, row, which);
      const chosen = key.isChosen();
      box(at.x, at.y, at.width, at.height, 30, chosen ? '#a2603f' : 'rgb(70 55 40 / 0.1)');
      pixels.fillStyle = chosen ? '#fff' : '#2e2823';
      pixels.font = `${chosen ? 600 : 400} 50px ${FONT}`;
      pixels.fillText(key.text, at.x + at.width / 2, at.y + at.height / 2, at.width - 20);
    }));
    pixels.fillStyle = '#75695f';
    pixels.font = `36px ${FONT}`;
    pixels.fillText(this.sentence, width / 2, height - 58, width - 80);
    this.texture.needsUpdate = true;
  }
}
