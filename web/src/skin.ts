import {badArgument} from './error.js';
import {HAND_FLOATS, HAND_MESH_BYTES, JOINT_COUNT, PLACEMENT_BYTES} from './layout.js';
import {Scene} from './scene.js';
import {expectLength, sideNumber, writePlacement} from './structs.js';
import {create} from './surface.js';
import type {Surface} from './surface.js';
import type {Hand, HandMesh, SkinOptions} from './types.js';
import type {Address, Wasm} from './wasm.js';

/** The skin of a hand as it is drawn, flattened where its flesh is sunk: one for each hand. */
export class Skin {
  readonly vertexCount: number;
  /** Of the last frame, x y z each: the same arrays every time. */
  readonly vertices: Float32Array;
  readonly normals: Float32Array;
  private readonly handle: Address;
  private readonly joints: Address;
  private readonly placement: Address;
  private readonly points: Address;

  /** @internal */
  constructor(private readonly wasm: Wasm, mesh: HandMesh) {
    this.vertexCount = Math.floor(mesh.vertices.length / 3);
    this.handle = createSkin(wasm, mesh, this.vertexCount);
    this.joints = wasm.allocate(4 * HAND_FLOATS);
    this.placement = wasm.allocate(PLACEMENT_BYTES);
    this.points = wasm.allocate(24 * this.vertexCount);
    this.vertices = new Float32Array(3 * this.vertexCount);
    this.normals = new Float32Array(3 * this.vertexCount);
  }

  /**
   * Puts `vertices` and `normals` where the joints of a hand that is drawn carry them, and out of
   * what is touched; null where nothing is near, and for hands of another method than `nade`.
   */
  update(joints: Hand, touching: Surface | Scene | null, options: SkinOptions = {}): void {
    const {wasm, handle, placement, points, vertexCount: count} = this;
    const {placement: placed, scale = 1, give = 0} = options;
    expectLength(joints, HAND_FLOATS, 'joints');
    wasm.floats.set(joints, this.joints / 4);
    const normals = points + 12 * count;
    wasm.call('nade_skin_pose', handle, this.joints, scale, points, normals, count);
    if (touching instanceof Scene) {
      wasm.call('nade_skin_flatten_scene', handle, this.joints, scale, touching.handle, give, points,
                normals, count);
    } else if (touching) {
      if (placed) writePlacement(wasm, placement, placed);
      wasm.call('nade_skin_flatten', handle, this.joints, scale, touching.handle,
                placed ? placement : 0, give, points, normals, count);
    }
    const at = points / 4;
    this.vertices.set(wasm.floats.subarray(at, at + 3 * count));
    this.normals.set(wasm.floats.subarray(at + 3 * count, at + 6 * count));
  }

  destroy(): void {
    this.wasm.call('nade_skin_destroy', this.handle);
    for (const address of [this.joints, this.placement, this.points]) this.wasm.free(address);
  }
}

function createSkin(wasm: Wasm, mesh: HandMesh, count: number): Address {
  const {side, vertices, normals, triangles, bones, weights, bind} = mesh;
  expectLength(normals, vertices.length, 'normals');
  expectLength(bones, 4 * count, 'bones');
  expectLength(weights, 4 * count, 'weights');
  expectLength(bind, HAND_FLOATS, 'bind');
  if (Array.prototype.some.call(bones, (bone: number) => !(bone >= 0 && bone < JOINT_COUNT))) {
    throw badArgument('bones: expected joints, 0 to 25');
  }
  return wasm.withFloats(vertices, (at) => wasm.withFloats(normals, (up) =>
    wasm.withFloats(weights, (shares) => wasm.withFloats(bind, (pose) =>
      wasm.with(4 * triangles.length, (corners) => wasm.with(bones.length, (on) =>
        wasm.with(HAND_MESH_BYTES, (address) => {
          new Uint32Array(wasm.bytes.buffer).set(triangles, corners / 4);
          wasm.bytes.set(bones, on);
          [HAND_MESH_BYTES, sideNumber(side), count, Math.floor(triangles.length / 3), at, up,
           corners, on, shares, pose].forEach((value, i) => {
            wasm.data.setUint32(address + 4 * i, value, true);
          });
          return create(wasm, 'nade_skin_create', address);
        })))))));
}
