// An object that moves by itself: drawn by its bones, and refitted for the hand.
import * as THREE from 'three';

import type {DrawnVertices} from '../../src/drawn_vertices.js';
import type {MeshSurface} from '../../src/index.js';

/** One skinned mesh whose surface has the vertices that are drawn. */
export class Living {
  /** Milliseconds that the last refit took: bones, vertices, tree. */
  refitMs = 0;
  private readonly mixer: THREE.AnimationMixer;
  private moved = false;

  constructor(root: THREE.Object3D, animations: THREE.AnimationClip[],
              private readonly drawn: DrawnVertices, private readonly surface: MeshSurface) {
    this.mixer = new THREE.AnimationMixer(root);
    for (const clip of animations) this.mixer.clipAction(clip).play();
    (root.getObjectByProperty('isSkinnedMesh', true) as THREE.SkinnedMesh).frustumCulled = false;
  }

  /** Moves on, or back to rest; false where nothing has moved. */
  update(seconds: number, lives: boolean): boolean {
    if (!lives && !this.moved) return false;
    if (lives) this.mixer.update(seconds);
    else this.mixer.setTime(0);
    this.moved = lives;
    const start = performance.now();
    const vertices = this.drawn.read();
    if (vertices) this.surface.refit(vertices);
    this.refitMs = performance.now() - start;
    return vertices !== null;
  }
}
