// The page in a headset: the object on a table before the person, stroked with real hands.
import * as THREE from 'three';

import {HAND_FLOATS} from '../../src/index.js';
import type {Hand, Nade, Scene} from '../../src/index.js';
import {readXRHand} from '../../src/webxr.js';
import type {TrackedHands} from './hands.js';
import {SpacePanel} from './spacepanel.js';
import type {Key} from './spacepanel.js';
import {shadeByHand} from './stage.js';
import type {Stage} from './stage.js';

/** In the scene of what may be touched; ids from here on are the objects'. */
export const FIRST_OBJECT_ID = 2;
const TABLE_ID = 1;

export type Immersion = 'immersive-vr' | 'immersive-ar';

const TABLE_RADIUS_M = 0.55;
const TABLE_THICK_M = 0.03;
const TABLE_HIGH_M = 0.7;
/** From the person to the table's middle. */
const BEFORE_M = 0.55;
const TABLE_CORNERS = 48;
const PATIENCE_S = 4;

/** What this browser has a headset for, at this moment. */
export async function offered(): Promise<Immersion[]> {
  const all: Immersion[] = ['immersive-vr', 'immersive-ar'];
  const found = await Promise.all(all.map((mode) => (
    navigator.xr?.isSessionSupported(mode).catch(() => false))));
  return all.filter((_, i) => found[i]);
}

export class Headset {
  readonly panel: SpacePanel;
  private readonly table = new THREE.Group();
  private readonly top: THREE.Mesh;
  private readonly ground: THREE.Mesh;
  private readonly plate;
  private readonly poses: Record<'left' | 'right', Hand> = {
    left: new Float32Array(HAND_FLOATS), right: new Float32Array(HAND_FLOATS)};
  /** From the scene to the headset's own space; null until it is known where the person is. */
  tableMatrix: THREE.Matrix4 | null = null;
  private withoutHands = 0;

  constructor(nade: Nade, private readonly stage: Stage, private readonly scene: Scene,
              rows: () => Key[][]) {
    const outline = Array.from({length: TABLE_CORNERS}, (_, i) => {
      const angle = 2 * Math.PI * i / TABLE_CORNERS;
      return [TABLE_RADIUS_M * Math.cos(angle), TABLE_RADIUS_M * Math.sin(angle)];
    });
    this.plate = nade.plate(outline.flat(), TABLE_THICK_M);
    this.top = new THREE.Mesh(
      new THREE.CylinderGeometry(TABLE_RADIUS_M, TABLE_RADIUS_M, TABLE_THICK_M, TABLE_CORNERS)
        .translate(0, -TABLE_THICK_M / 2, 0));
    this.top.receiveShadow = true;
    this.ground = new THREE.Mesh(new THREE.CircleGeometry(8, 64).rotateX(-Math.PI / 2),
                                 new THREE.MeshStandardMaterial({color: '#cfc9c2', roughness: 1}));
    this.ground.position.y = -TABLE_HIGH_M;
    this.panel = new SpacePanel(rows);
    // Beside the object, turned to the person's eyes.
    this.panel.mesh.position.set(-0.36, 0.17, 0.2);
    this.panel.mesh.rotation.set(-0.6, 0.5, 0, 'YXZ');
    this.table.add(this.top, this.ground, this.panel.mesh);
  }

  get isWorn(): boolean { return this.stage.renderer.xr.isPresenting; }

  /** Starts a session; `left` is called when it has ended. */
  async enter(mode: Immersion, left: () => void): Promise<void> {
    const {xr} = this.stage.renderer;
    const session = await navigator.xr!.requestSession(mode, {
      requiredFeatures: ['local-floor'], optionalFeatures: ['hand-tracking']});
    this.tableMatrix = null;
    this.withoutHands = 0;
    this.panel.sentence = '';
    xr.enabled = true;
    xr.setReferenceSpaceType('local-floor');
    session.addEventListener('end', () => {
      xr.enabled = false;
      this.stage.surround('page', this.table);
      this.scene.remove(TABLE_ID);
      left();
    });
    await xr.setSession(session);
    this.top.material = mode === 'immersive-vr' ?
      shadeByHand(new THREE.MeshStandardMaterial({color: '#cdb193', roughness: 0.75})) :
      new THREE.ShadowMaterial({opacity: 0.35});
    this.ground.visible = mode === 'immersive-vr';
    this.stage.surround(mode === 'immersive-vr' ? 'nothing' : 'room', this.table);
    this.scene.add(TABLE_ID, this.plate);
  }

  leave(): void { void this.stage.renderer.xr.getSession()?.end(); }

  /** The hands of a frame, as they are tracked. */
  hands(frame: XRFrame, seconds: number): TrackedHands {
    const {xr} = this.stage.renderer;
    const space = xr.getReferenceSpace();
    const hands: TrackedHands = {};
    if (!space || !this.stand(frame, space)) return hands;
    let isAny = false;
    for (const {hand, handedness} of frame.session.inputSources) {
      if (!hand || handedness === 'none') continue;
      isAny = true;
      if (readXRHand(frame, hand, space, this.poses[handedness])) {
        hands[handedness] = this.poses[handedness];
      }
    }
    this.withoutHands = isAny ? 0 : this.withoutHands + seconds;
    this.panel.sentence = this.withoutHands > PATIENCE_S ?
      'No hands: put the controllers down, allow hand tracking' : '';
    return hands;
  }

  /** Puts the table before the person, once it is known where that is: the scene's floor is its top. */
  private stand(frame: XRFrame, space: XRReferenceSpace): boolean {
    if (this.tableMatrix) return true;
    const viewer = frame.getViewerPose(space)?.transform;
    if (!viewer) return false;
    const {x, y, z, w} = viewer.orientation;
    const ahead = new THREE.Vector3(0, 0, -1).applyQuaternion(new THREE.Quaternion(x, y, z, w));
    const around = Math.atan2(-ahead.x, -ahead.z);
    const position = {x: viewer.position.x - BEFORE_M * Math.sin(around), y: TABLE_HIGH_M,
                      z: viewer.position.z - BEFORE_M * Math.cos(around)};
    const orientation = {x: 0, y: Math.sin(around / 2), z: 0, w: Math.cos(around / 2)};
    this.stage.renderer.xr.setReferenceSpace(space.getOffsetReferenceSpace(
      new XRRigidTransform(position, orientation)));
    this.tableMatrix = new THREE.Matrix4().makeRotationY(around)
      .setPosition(position.x, position.y, position.z);
    return false;
  }
}
