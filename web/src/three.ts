/** nade with three.js. */
import {Box3, Group, Quaternion, Vector3} from 'three';
import type {Object3D, SkinnedMesh, WebXRSpaceEventMap, XRHandSpace, XRJointSpace} from 'three';
import type {Corrector, Result} from './corrector.js';
import {DrawnVertices} from './drawn_vertices.js';
import {badArgument} from './error.js';
import {FlattenedSkin, isHandMesh} from './flattened_skin.js';
import {fillPalm} from './joints.js';
import {HAND_FLOATS, JOINT_FLOATS} from './layout.js';
import type {Nade} from './nade.js';
import type {Scene} from './scene.js';
import type {MeshSurface, Surface} from './surface.js';
import {JOINT_NAMES} from './types.js';
import type {CorrectorOptions, Feel, Hand, Placement, Side} from './types.js';

export {FlattenedSkin} from './flattened_skin.js';

const WRIST = 1;

/** The joints of three's hand, in the frame of its parent; false where it is not tracked. */
export function readHand(from: XRHandSpace, into: Hand): boolean {
  for (let j = WRIST; j < JOINT_NAMES.length; ++j) {
    const joint = from.joints[JOINT_NAMES[j] as XRHandJoint];
    if (!joint?.visible) return false;
    const {position, quaternion, jointRadius} = joint;
    into.set([quaternion.x, quaternion.y, quaternion.z, quaternion.w,
              position.x, position.y, position.z, jointRadius ?? 0], JOINT_FLOATS * j);
  }
  fillPalm(into);
  return true;
}

/**
 * A corrected hand for a hand of `renderer.xr.getHand(i)`: it has that one's `joints` and events,
 * so that what draws the one, as XRHandModelFactory does, draws the other. Put it where that hand
 * would go, as into the scene.
 */
export class CorrectedHand extends Group<WebXRSpaceEventMap> {
  readonly joints: Partial<Record<XRHandJoint, XRJointSpace>> = {};
  readonly inputState = {pinching: false};
  readonly corrector: Corrector;
  /** Of the last frame; null where the hand was not tracked. */
  result: Result | null = null;
  private readonly pose: Hand = new Float32Array(HAND_FLOATS);
  private side: Side | null = null;
  private skin: FlattenedSkin | null = null;
  private readonly flattens: boolean;

  /**
   * A skinned mesh that is put into it, as XRHandModelFactory does, is drawn with its skin flattened
   * where it is sunk; not with `flatten: false`, nor by another method than `nade`.
   */
  constructor(private readonly nade: Nade, readonly tracked: XRHandSpace,
              options: CorrectorOptions & {flatten?: boolean} = {}) {
    super();
    this.flattens = (options.flatten ?? true) && (options.method ?? 'nade') === 'nade';
    this.corrector = nade.corrector(options);
    this.matrixAutoUpdate = false;
    this.visible = false;
    for (const name of JOINT_NAMES.slice(WRIST)) {
      const joint = new Group() as unknown as XRJointSpace;
      joint.matrixAutoUpdate = false;
      joint.visible = false;
      this.joints[name as XRHandJoint] = joint;
      this.add(joint);
    }
    tracked.addEventListener('connected', (event) => {
      this.side = event.data.handedness === 'none' ? null : event.data.handedness;
      this.dispatchEvent({type: 'connected', data: event.data, target: this} as never);
    });
    tracked.addEventListener('disconnected', (event) => {
      this.side = null;
      this.dispatchEvent({type: 'disconnected', data: event.data, target: this} as never);
    });
  }

  /** Once a frame, after three has updated the tracked hand: in the animation loop, at its time. */
  update(touching: Scene | Surface | null, timeMs: number): Result | null {
    this.visible = this.side !== null && this.tracked.visible && readHand(this.tracked, this.pose);
    if (!this.visible || this.side === null) return this.result = null;
    const result = this.corrector.update(this.side, this.pose, touching, timeMs);
    JOINT_NAMES.forEach((name, j) => {
      const joint = this.joints[name as XRHandJoint] as (XRJointSpace & Object3D) | undefined;
      if (!joint) return;
      const at = JOINT_FLOATS * j;
      joint.quaternion.fromArray(result.joints, at);
      joint.position.fromArray(result.joints, at + 4);
      (joint as {jointRadius: number | undefined}).jointRadius = result.joints[at + 7];
      joint.updateMatrix();
      joint.matrixWorldNeedsUpdate = true;
      joint.visible = true;
    });
    if (this.flattens && result.status !== 'untracked') this.flatten(this.side, result.joints, touching);
    return this.result = result;
  }

  /** Models come when they are loaded, and go with the tracked hand. */
  private flatten(side: Side, joints: Hand, touching: Scene | Surface | null): void {
    const mesh = this.getObjectByProperty('isSkinnedMesh', true) as SkinnedMesh | undefined;
    if (mesh !== this.skin?.original) {
      this.skin?.destroy();
      this.skin = mesh && isHandMesh(mesh) ? new FlattenedSkin(this.nade, mesh, side) : null;
      if (this.skin) this.add(this.skin);
    }
    this.skin?.update(joints, touching);
  }
}

/** The triangles of all meshes in an object, in its frame, as they stand now. */
export function trianglesOf(object: Object3D): {vertices: Float32Array; triangles: Uint32Array} {
  return trianglesNow(new DrawnVertices(object));
}

function trianglesNow(drawn: DrawnVertices) {
  const vertices = drawn.read() ?? new Float32Array();
  const triangles = drawn.triangles();
  if (triangles.length === 0) throw badArgument('object: expected meshes with triangles, found none');
  return {vertices, triangles};
}

/** An object, and its vertices where they move. */
interface Touchable {
  id: number;
  surface: Surface;
  drawn: DrawnVertices | null;
}

/** Keeps the objects of a three.js scene in one of nade's. */
export class TouchableObjects {
  readonly scene: Scene;
  private readonly objects = new Map<Object3D, Touchable>();
  private next = 1;

  constructor(private readonly nade: Nade) { this.scene = nade.scene(); }

  /**
   * An object may be touched from now on, and gives its id. Without a `surface` of yours its
   * triangles are, as bones and morph targets move them. `deforms`: false where they need not be
   * followed, true where parts of the object move against each other.
   */
  add(object: Object3D, options: {surface?: Surface; feel?: Feel; deforms?: boolean} = {}): number {
    const id = this.next++;
    let {surface} = options;
    let drawn: DrawnVertices | null = null;
    if (!surface) {
      drawn = new DrawnVertices(object);
      const {vertices, triangles} = trianglesNow(drawn);
      surface = this.nade.mesh(vertices, triangles);
    }
    this.scene.add(id, surface, placementOf(object), options.feel);
    const follows = options.deforms ?? drawn?.deforms ?? false;
    this.objects.set(object, {id, surface, drawn: follows ? drawn : null});
    return id;
  }

  remove(object: Object3D): void {
    const entry = this.objects.get(object);
    if (!entry) return;
    this.scene.remove(entry.id);
    this.objects.delete(object);
  }

  /** Once a frame, before the hands: objects stand where three has them, in the shape they have. */
  update(): void {
    for (const [object, {id, surface, drawn}] of this.objects) {
      const vertices = drawn?.read();
      if (vertices) {
        (surface as MeshSurface).refit(vertices);
        this.scene.deformed(id);
      }
      this.scene.place(id, placementOf(object));
    }
  }
}

/** Where an object stands in the world. Its scale must be the same along all axes. */
export function placementOf(object: Object3D): Placement {
  object.updateWorldMatrix(true, false);
  const position = new Vector3();
  const rotation = new Quaternion();
  const scale = new Vector3();
  object.matrixWorld.decompose(position, rotation, scale);
  if (Math.max(Math.abs(scale.x - scale.y), Math.abs(scale.x - scale.z)) > 1e-3 * scale.x) {
    throw badArgument(`${object.name || 'object'}: expected one scale along all axes, found ` +
                      scale.toArray().join(', '));
  }
  return {position: position.toArray(), rotation: rotation.toArray(), scale: scale.x};
}

/** The size of an object in the world, metres. */
export function sizeOf(object: Object3D): Vector3 {
  return new Box3().setFromObject(object).getSize(new Vector3());
}
