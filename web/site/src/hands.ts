// Hands as they are drawn: the generic hand of WebXR, bent to 26 joints.
import * as THREE from 'three';
import {GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';
import {clone} from 'three/addons/utils/SkeletonUtils.js';

import {JOINT_FLOATS, JOINT_NAMES} from '../../src/index.js';
import type {Corrector, Hand, Method, Nade, Result, Scene, Side} from '../../src/index.js';
import {FlattenedSkin} from '../../src/three.js';

export const SIDES: readonly Side[] = ['left', 'right'];

/** The hands of one frame, as tracked. */
export type TrackedHands = Partial<Record<Side, Hand>>;

/** The tracked hand, seen through everything. */
class GhostHand {
  private readonly bones: (THREE.Object3D | undefined)[];

  constructor(readonly root: THREE.Object3D) {
    const mesh = skinnedMeshOf(root);
    mesh.material = ghostly();
    mesh.frustumCulled = false;
    mesh.renderOrder = 1;
    root.visible = false;
    this.bones = JOINT_NAMES.map((name) => root.getObjectByName(name));
  }

  show(hand: Hand): void {
    this.bones.forEach((bone, joint) => {
      bone?.quaternion.fromArray(hand, JOINT_FLOATS * joint);
      bone?.position.fromArray(hand, JOINT_FLOATS * joint + 4);
    });
  }
}

const skinnedMeshOf = (root: THREE.Object3D) =>
  root.getObjectByProperty('isSkinnedMesh', true) as THREE.SkinnedMesh;

function skin(): THREE.Material {
  return new THREE.MeshPhysicalMaterial({
    color: '#d99f80', roughness: 0.58, sheen: 0.6, sheenRoughness: 0.5,
    sheenColor: new THREE.Color('#c8664a'), side: THREE.DoubleSide});
}

/** Seen through everything, brighter at its rim. */
function ghostly(): THREE.Material {
  return new THREE.ShaderMaterial({
    transparent: true, depthTest: false, depthWrite: false, blending: THREE.NormalBlending,
    vertexShader: `
      #include <common>
      #include <skinning_pars_vertex>
      varying vec3 vNormal, vSeen;
      void main() {
        #include <beginnormal_vertex>
        #include <skinbase_vertex>
        #include <skinnormal_vertex>
        #include <begin_vertex>
        #include <skinning_vertex>
        #include <project_vertex>
        vNormal = normalMatrix * objectNormal;
        vSeen = mvPosition.xyz;
      }`,
    fragmentShader: `
      varying vec3 vNormal, vSeen;
      void main() {
        float rim = 1.0 - abs(dot(normalize(vNormal), normalize(vSeen)));
        gl_FragColor = vec4(0.16, 0.42, 0.85, 0.1 + 0.6 * rim * rim);
      }`,
  });
}

/** A hand of one side: corrected, and drawn with or without the one that was tracked. */
export class ShownHand {
  /** Of the last frame; null where it was not tracked. */
  tracked: Hand | null = null;
  result: Result | null = null;
  private corrector: Corrector;
  private method: Method = 'nade';

  private constructor(private readonly nade: Nade, readonly side: Side,
                      private readonly drawn: FlattenedSkin, private readonly ghost: GhostHand) {
    this.corrector = nade.corrector();
  }

  static async load(nade: Nade, side: Side, into: THREE.Object3D): Promise<ShownHand> {
    const {scene: model} = await new GLTFLoader().loadAsync(`${side}.glb`);
    const ghost = new GhostHand(clone(model));
    const mesh = skinnedMeshOf(model);
    mesh.material = skin();
    mesh.castShadow = mesh.receiveShadow = true;
    const drawn = new FlattenedSkin(nade, mesh, side);
    drawn.visible = false;
    into.add(drawn, ghost.root);
    return new ShownHand(nade, side, drawn, ghost);
  }

  correctBy(method: Method): void {
    if (method === this.method) return;
    this.method = method;
    this.corrector.destroy();
    this.corrector = this.nade.corrector({method});
  }

  reset(): void { this.corrector.reset(); }

  /** Corrects the hand of this frame, and gives the time that took, milliseconds. */
  update(tracked: Hand | undefined, touching: Scene, timeMs: number): number {
    this.tracked = tracked ?? null;
    const start = performance.now();
    this.result = tracked ? this.corrector.update(this.side, tracked, touching, timeMs) : null;
    // Only this method has flesh that gives; the others' skin is rigid.
    if (this.result && this.result.status !== 'untracked') {
      this.drawn.update(this.result.joints, this.method === 'nade' ? touching : null);
    }
    return performance.now() - start;
  }

  draw(withGhost: boolean): void {
    this.drawn.visible = this.result !== null;
    this.ghost.root.visible = withGhost && this.tracked !== null;
    if (withGhost && this.tracked) this.ghost.show(this.tracked);
  }

  /** The skin that is drawn, by the bone that carries most of each vertex. */
  vertices(): {joint: string; point: THREE.Vector3}[] {
    const {original, geometry} = this.drawn;
    const {skinIndex, skinWeight} = original.geometry.attributes;
    const position = geometry.getAttribute('position');
    return Array.from({length: position.count}, (_, i) => {
      const most = [0, 1, 2, 3].reduce((a, b) => (
        skinWeight.getComponent(i, b) > skinWeight.getComponent(i, a) ? b : a));
      return {joint: original.skeleton.bones[skinIndex.getComponent(i, most)].name,
              point: new THREE.Vector3().fromBufferAttribute(position, i)};
    });
  }
}
