// The picture: light, floor, camera, and the shade of a hand on what it touches.
import * as THREE from 'three';

import {JOINT_FLOATS} from '../../src/index.js';
import type {Hand} from '../../src/index.js';

/** From joint to joint: what of a hand keeps light off. Not the wrist, which is drawn fading. */
const BONES = [
  [2, 3], [3, 4], [4, 5], [6, 7], [7, 8], [8, 9], [9, 10], [11, 12], [12, 13], [13, 14], [14, 15],
  [16, 17], [17, 18], [18, 19], [19, 20], [21, 22], [22, 23], [23, 24], [24, 25],
];
const TYPICAL_RADIUS_M = 0.011;
const FAR_M = 0.4;

const MOST_HANDS = 2;
const MIDDLE_KNUCKLE = 12;

const ends = {value: Array.from({length: 2 * MOST_HANDS * BONES.length}, () => new THREE.Vector4())};
const middles = {value: Array.from({length: MOST_HANDS}, () => new THREE.Vector3())};
const handCount = {value: 0};

/** Where the hands are that shade things. */
export function shadeBy(hands: readonly Hand[]): void {
  handCount.value = hands.length;
  hands.forEach((hand, which) => {
    middles.value[which].fromArray(hand, JOINT_FLOATS * MIDDLE_KNUCKLE + 4);
    BONES.flat().forEach((joint, i) => {
      const at = JOINT_FLOATS * joint;
      ends.value[2 * BONES.length * which + i].set(hand[at + 4], hand[at + 5], hand[at + 6],
                                                  hand[at + 7] || TYPICAL_RADIUS_M);
    });
  });
}

/**
 * Light that hands keep off a surface: each bone as a ball at its point nearest to what is shaded.
 * A shadow map alone leaves hands floating: under a palm no light comes from anywhere. What is
 * farther than FAR_M from a hand's middle is lit as if it were not there.
 */
// Based on: Quilez. Sphere ambient occlusion. iquilezles.org.
export function shadeByHand<Kind extends THREE.MeshStandardMaterial>(material: Kind): Kind {
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, {handEnds: ends, handMiddles: middles, handCount});
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', '#include <common>\nvarying vec3 vShadedAt;')
      .replace('#include <project_vertex>', `#include <project_vertex>
        vShadedAt = (modelMatrix * vec4(transformed, 1.0)).xyz;`);
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', `#include <common>
        varying vec3 vShadedAt;
        uniform vec4 handEnds[${2 * MOST_HANDS * BONES.length}];
        uniform vec3 handMiddles[${MOST_HANDS}];
        uniform int handCount;
        float lightPastHand(int first, vec3 normalWorld) {
          float light = 1.0;
          for (int i = first; i < first + ${BONES.length}; ++i) {
            vec4 from = handEnds[2 * i];
            vec4 bone = handEnds[2 * i + 1] - from;
            float along = dot(vShadedAt - from.xyz, bone.xyz) / max(dot(bone.xyz, bone.xyz), 1e-8);
            vec4 ball = from + clamp(along, 0.0, 1.0) * bone;
            vec3 way = ball.xyz - vShadedAt;
            float away = max(length(way), ball.w);
            float facing = clamp(dot(normalWorld, way) / away + 0.15, 0.0, 1.0);
            light *= 1.0 - 0.9 * facing * ball.w * ball.w / (away * away);
          }
          return light;
        }
        float lightPastHands(vec3 normalWorld) {
          float light = 1.0;
          for (int i = 0; i < handCount; ++i) {
            float near = 1.0 - smoothstep(${(0.6 * FAR_M).toFixed(2)}, ${FAR_M.toFixed(2)},
                                          distance(handMiddles[i], vShadedAt));
            if (near > 0.0) light *= mix(1.0, lightPastHand(${BONES.length} * i, normalWorld), near);
          }
          return light;
        }`)
      .replace('#include <aomap_fragment>', `#include <aomap_fragment>
        float pastHand = lightPastHands(inverseTransformDirection(normal, viewMatrix));
        reflectedLight.indirectDiffuse *= pastHand;
        reflectedLight.directDiffuse *= mix(1.0, pastHand, 0.6);`);
  };
  return material;
}

export interface View {
  target: [number, number, number];
  distance: number;
  /** Radians: around from +Z, and up. */
  around: number;
  up: number;
}

/** How well it is drawn, best first: a machine that is too slow for one goes on to the next. */
const QUALITIES = [{mostPixels: 2, shadows: true}, {mostPixels: 1, shadows: true},
                   {mostPixels: 0.4, shadows: false}];
const SLOW_MS = 45;
const SLOW_FRAMES = 6;
/** So much of a high picture goes up. */
const PANEL_SHARE = 0.08;

const BACKGROUND = new THREE.Color('#e6ddd3');

export class Stage {
  readonly scene = new THREE.Scene();
  readonly camera = new THREE.PerspectiveCamera(32, 1, 0.05, 20);
  readonly floor: THREE.Mesh;
  view: View = {target: [0, 0.3, 0], distance: 1.5, around: 0.3, up: 0.5};
  readonly renderer: THREE.WebGLRenderer;
  private readonly haze = new THREE.Fog(BACKGROUND);
  private readonly key = new THREE.DirectionalLight('#fff4e6', 2.4);
  private quality = 0;
  private slow = 0;
  private drawnAt = 0;
  private readonly shown = {target: new THREE.Vector3(0, 0.3, 0), distance: 1.6, around: 0, up: 0.4};

  constructor(private readonly canvas: HTMLCanvasElement) {
    this.renderer = new THREE.WebGLRenderer({canvas, antialias: true});
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.VSMShadowMap;
    this.renderer.toneMapping = THREE.AgXToneMapping;
    this.renderer.toneMappingExposure = 1.25;
    this.scene.background = BACKGROUND;
    this.scene.fog = this.haze;
    this.scene.add(new THREE.HemisphereLight('#f4f3f2', '#a39a92', 1.7));
    const rim = new THREE.DirectionalLight('#dfe8ff', 0.9);
    rim.position.set(1.5, 1.2, -2);
    this.scene.add(rim, this.key, this.key.target);
    this.key.castShadow = true;
    this.key.shadow.mapSize.set(1024, 1024);
    this.key.shadow.radius = 7;
    this.key.shadow.blurSamples = 16;
    this.key.shadow.intensity = 0.75;
    this.key.shadow.normalBias = 0.003;
    this.key.shadow.bias = -2e-4;
    Object.assign(this.key.shadow.camera, {left: -0.7, right: 0.7, top: 0.7, bottom: -0.7,
                                           near: 0.5, far: 4});
    this.floor = new THREE.Mesh(
      new THREE.CircleGeometry(8, 64).rotateX(-Math.PI / 2),
      shadeByHand(new THREE.MeshStandardMaterial({color: '#cfc9c2', roughness: 0.95})));
    this.floor.receiveShadow = true;
    this.scene.add(this.floor);
  }

  /** In a headset there is a table instead of a floor without an end; around it nothing, or the room. */
  surround(by: 'page' | 'nothing' | 'room', table: THREE.Object3D): void {
    this.floor.visible = by === 'page';
    this.haze.near = 1.5;
    this.haze.far = 6;
    this.scene.background = by === 'room' ? null : BACKGROUND;
    if (by === 'page') this.scene.remove(table);
    else this.scene.add(table);
  }

  /** Where no headset decides that, it looks from somewhere else slowly. */
  draw(seconds: number): void {
    this.keepUp();
    if (!this.renderer.xr.isPresenting) this.look(seconds);
    this.renderer.render(this.scene, this.camera);
  }

  private keepUp(): void {
    const now = performance.now();
    this.slow = now - this.drawnAt > SLOW_MS ? this.slow + 1 : 0;
    this.drawnAt = now;
    if (this.slow < SLOW_FRAMES || this.quality === QUALITIES.length - 1) return;
    this.slow = 0;
    this.key.castShadow = QUALITIES[++this.quality].shadows;
  }

  private look(seconds: number): void {
    const {shown, view, camera} = this;
    const share = 1 - Math.exp(-seconds / 0.18);
    shown.target.lerp(new THREE.Vector3(...view.target), share);
    for (const key of ['distance', 'around', 'up'] as const) {
      shown[key] += share * (view[key] - shown[key]);
    }
    this.fit();
    // What is wide has to fit into a picture that is high.
    const distance = shown.distance * Math.max(1, 0.9 / camera.aspect);
    // The floor goes over into the background.
    this.haze.near = 1.25 * distance;
    this.haze.far = 3.2 * distance;
    camera.position.set(Math.sin(shown.around) * Math.cos(shown.up), Math.sin(shown.up),
                        Math.cos(shown.around) * Math.cos(shown.up))
      .multiplyScalar(distance).add(shown.target);
    camera.lookAt(shown.target);
    camera.updateMatrixWorld();
    this.key.target.position.copy(shown.target);
    this.key.position.copy(shown.target).add(new THREE.Vector3(-0.55, 1.7, 0.85));
  }

  settle(): void {
    this.shown.target.set(...this.view.target);
    Object.assign(this.shown, {distance: this.view.distance, around: this.view.around,
                               up: this.view.up});
  }

  /** The ray through a place of the window. */
  ray(x: number, y: number): THREE.Ray {
    const caster = new THREE.Raycaster();
    caster.setFromCamera(new THREE.Vector2(2 * x / this.canvas.clientWidth - 1,
                                           1 - 2 * y / this.canvas.clientHeight), this.camera);
    return caster.ray;
  }

  private fit(): void {
    const {clientWidth: width, clientHeight: height} = this.canvas;
    const ratio = Math.min(devicePixelRatio, QUALITIES[this.quality].mostPixels);
    const size = this.renderer.getSize(new THREE.Vector2());
    if (size.x === width && size.y === height && this.renderer.getPixelRatio() === ratio) return;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    // A picture that is high has the panel in its lower part.
    this.camera.setViewOffset(width, height, 0, width < height ? PANEL_SHARE * height : 0, width,
                              height);
    this.camera.updateProjectionMatrix();
  }
}
