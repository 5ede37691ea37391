// Hands as they are drawn: the generic hand of WebXR, bent to 26 joints.
import * as THREE from 'three';
import {GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';

import {JOINT_FLOATS, JOINT_NAMES} from '../../src/index.js';
import type {Hand} from '../../src/index.js';

export class DrawnHand {
  readonly root: THREE.Object3D;
  private readonly bones: (THREE.Object3D | undefined)[];

  private constructor(root: THREE.Object3D, material: THREE.Material, isGhost: boolean) {
    this.root = root;
    root.traverse((part) => {
      if (!(part instanceof THREE.SkinnedMesh)) return;
      part.material = material;
      part.frustumCulled = false;
      part.castShadow = part.receiveShadow = !isGhost;
      part.renderOrder = isGhost ? 1 : 0;
    });
    this.bones = JOINT_NAMES.map((name) => root.getObjectByName(name));
  }

  static async skin(): Promise<DrawnHand> {
    const material = new THREE.MeshPhysicalMaterial({
      color: '#d99f80', roughness: 0.58, sheen: 0.6, sheenRoughness: 0.5,
      sheenColor: new THREE.Color('#c8664a'), side: THREE.DoubleSide});
    return new DrawnHand(await load(), material, false);
  }

  /** Seen through everything, brighter at its rim. */
  static async ghost(): Promise<DrawnHand> {
    const material = new THREE.ShaderMaterial({
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
    const hand = new DrawnHand(await load(), material, true);
    hand.root.visible = false;
    return hand;
  }

  show(hand: Hand): void {
    this.bones.forEach((bone, joint) => {
      bone?.quaternion.fromArray(hand, JOINT_FLOATS * joint);
      bone?.position.fromArray(hand, JOINT_FLOATS * joint + 4);
    });
  }
}

async function load(): Promise<THREE.Object3D> {
  return (await new GLTFLoader().loadAsync('hand.glb')).scene;
}
