// An object that moves by itself: drawn by its bones, and refitted for the hand.
import * as THREE from 'three';

import type {MeshSurface} from '../../src/index.js';

/** One skinned mesh whose surface has the same vertices. */
export class Living {
  /** Milliseconds that the last refit took: bones, vertices, tree. */
  refitMs = 0;
  private readonly mixer: THREE.AnimationMixer;
  private readonly mesh: THREE.SkinnedMesh;
  private readonly rest: Float32Array;
  private readonly bones: Uint8Array;
  private readonly weights: Float32Array;
  private readonly vertices: Float32Array;
  private moved = false;

  constructor(private readonly root: THREE.Object3D, animations: THREE.AnimationClip[],
              private readonly surface: MeshSurface) {
    this.mixer = new THREE.AnimationMixer(root);
    for (const clip of animations) this.mixer.clipAction(clip).play();
    this.mesh = root.getObjectByProperty('isSkinnedMesh', true) as THREE.SkinnedMesh;
    this.mesh.frustumCulled = false;
    const {position, skinIndex, skinWeight} = this.mesh.geometry.attributes;
    const all = (from: THREE.BufferAttribute | THREE.InterleavedBufferAttribute) =>
      Array.from({length: from.count * from.itemSize}, (_, i) =>
        from.getComponent(Math.floor(i / from.itemSize), i % from.itemSize));
    this.rest = Float32Array.from(all(position));
    this.bones = Uint8Array.from(all(skinIndex));
    this.weights = Float32Array.from(all(skinWeight));
    this.vertices = new Float32Array(this.rest.length);
  }

  /** Moves on, or back to rest; false where nothing has moved. */
  update(seconds: number, lives: boolean): boolean {
    if (!lives && !this.moved) return false;
    if (lives) this.mixer.update(seconds);
    else this.mixer.setTime(0);
    this.moved = lives;
    const start = performance.now();
    this.root.updateMatrixWorld(true);
    this.bend();
    this.surface.refit(this.vertices);
    this.refitMs = performance.now() - start;
    return true;
  }

  /** three.js does the same on the graphics card, from where it does not come back. */
  private bend(): void {
    const {bones, boneInverses} = this.mesh.skeleton;
    const matrices = bones.map((bone, i) => new THREE.Matrix4()
      .multiplyMatrices(bone.matrixWorld, boneInverses[i]).elements);
    const {rest, vertices, weights} = this;
    for (let at = 0, four = 0; at < rest.length; at += 3, four += 4) {
      const x = rest[at], y = rest[at + 1], z = rest[at + 2];
      let [sumX, sumY, sumZ] = [0, 0, 0];
      for (let k = four; k < four + 4; ++k) {
        const w = weights[k];
        if (w === 0) continue;
        const m = matrices[this.bones[k]];
        sumX += w * (m[0] * x + m[4] * y + m[8] * z + m[12]);
        sumY += w * (m[1] * x + m[5] * y + m[9] * z + m[13]);
        sumZ += w * (m[2] * x + m[6] * y + m[10] * z + m[14]);
      }
      vertices[at] = sumX;
      vertices[at + 1] = sumY;
      vertices[at + 2] = sumZ;
    }
  }
}
