// What is stroked.
import * as THREE from 'three';
import {GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';

import {DrawnVertices} from '../../src/drawn_vertices.js';
import type {Nade, Placement, Surface} from '../../src/index.js';
import type {Touchable} from '../../src/pointer.js';
import {trianglesOf} from '../../src/three.js';
import {Living} from './living.js';
import {shadeByHand} from './stage.js';
import type {View} from './stage.js';

const MOST_TRIANGLES = 1e6;
const MOST_BYTES = 2e8;
const SMALLEST_M = 0.15;
const LARGEST_M = 1.2;

export interface Thing extends Touchable {
  root: THREE.Object3D;
  surface: Surface;
  placement: Placement;
  view: View;
  /** What moves by itself, if it does. */
  living?: Living;
  /** Where a hand that nobody moves strokes, at a time in seconds. */
  stroke(seconds: number): THREE.Vector3;
}

function thing(root: THREE.Object3D, surface: Surface, placement: Placement, view: View,
               stroke: (seconds: number) => THREE.Vector3): Thing {
  return {root, surface, placement, view, stroke,
          closestPoint: (query, most) => surface.closestPoint(query, most, placement)};
}

const circle = (center: THREE.Vector3, x: number, z: number) => (seconds: number) =>
  center.clone().add(new THREE.Vector3(x * Math.cos(1.3 * seconds), 0, z * Math.sin(1.3 * seconds)));

function drawn(geometry: THREE.BufferGeometry, material: THREE.MeshStandardMaterial): THREE.Mesh {
  const mesh = new THREE.Mesh(geometry, shadeByHand(material));
  mesh.castShadow = mesh.receiveShadow = true;
  return mesh;
}

/** The floor itself. */
export function plane(nade: Nade): Thing {
  return thing(new THREE.Group(), nade.plane(), {},
               {target: [0, 0.02, 0], distance: 0.85, around: 0.35, up: 0.55},
               circle(new THREE.Vector3(), 0.12, 0.06));
}

export function ball(nade: Nade): Thing {
  const radius = 0.12;
  const mesh = drawn(new THREE.SphereGeometry(radius, 96, 64), new THREE.MeshPhysicalMaterial(
    {color: '#6f8f86', roughness: 0.45, clearcoat: 0.25, clearcoatRoughness: 0.5}));
  mesh.position.y = radius;
  return thing(mesh, nade.sphere(radius), {position: [0, radius, 0]},
               {target: [0, 0.14, 0], distance: 0.95, around: 0.35, up: 0.45},
               circle(new THREE.Vector3(0, 2 * radius, 0), 0.06, 0.04));
}

export async function dog(nade: Nade): Promise<Thing> {
  const {scene, animations} = await new GLTFLoader().loadAsync('dog.glb');
  dress(scene, () => new THREE.MeshPhysicalMaterial({
    vertexColors: true, roughness: 0.9, sheen: 0.35, sheenRoughness: 0.55,
    sheenColor: new THREE.Color('#f3d3ae')}));
  const vertices = new DrawnVertices(scene);
  const surface = nade.mesh(vertices.read()!, vertices.triangles());
  const found = thing(scene, surface, {},
                      {target: [0.03, 0.33, 0], distance: 1.55, around: 0.42, up: 0.4},
                      (seconds) => new THREE.Vector3(0.085 - 0.145 * Math.cos(1.15 * seconds), 0.44,
                                                     0.014 * Math.sin(2.3 * seconds)));
  found.living = new Living(scene, animations, vertices, surface);
  return found;
}

/** A GLB file of somebody's own, on the floor, made smaller or larger to be within reach. */
export async function own(nade: Nade, file: File): Promise<Thing> {
  if (file.size > MOST_BYTES) {
    throw new Error(`has ${Math.round(file.size / 1e6)} MB, more than ${MOST_BYTES / 1e6}`);
  }
  const {scene} = await new GLTFLoader().parseAsync(await file.arrayBuffer(), '').catch(
    () => { throw new Error('expected a GLB file, whole and without Draco compression'); });
  const root = new THREE.Group().add(scene);
  const count = trianglesIn(root);
  if (count > MOST_TRIANGLES) throw new Error(`has ${count} triangles, more than ${MOST_TRIANGLES}`);
  const box = new THREE.Box3().setFromObject(root);
  const size = box.getSize(new THREE.Vector3());
  const most = Math.max(size.x, size.y, size.z);
  if (!(most > 0)) throw new Error('has no triangles');
  const scale = Math.min(Math.max(most, SMALLEST_M), LARGEST_M) / most;
  const center = box.getCenter(new THREE.Vector3());
  scene.position.sub(new THREE.Vector3(center.x, box.min.y, center.z));
  root.scale.setScalar(scale);
  const {vertices, triangles} = trianglesOf(root);
  dress(root, (before) => before);
  const high = scale * size.y;
  const wide = scale * Math.max(size.x, size.z);
  return thing(root, nade.mesh(vertices, triangles), {scale},
               {target: [0, 0.6 * high, 0], distance: 0.6 + 1.9 * Math.max(high, wide), around: 0.42,
                up: 0.42},
               circle(new THREE.Vector3(0, high, 0), 0.25 * scale * size.x, 0.1 * scale * size.z));
}

function trianglesIn(root: THREE.Object3D): number {
  let sum = 0;
  root.traverse((part) => {
    if (!(part instanceof THREE.Mesh)) return;
    const {index, attributes} = part.geometry as THREE.BufferGeometry;
    const copies = part instanceof THREE.InstancedMesh ? part.count : 1;
    sum += copies * Math.floor((index ?? attributes.position).count / 3);
  });
  return sum;
}

function dress(root: THREE.Object3D,
               material: (before: THREE.MeshStandardMaterial) => THREE.MeshStandardMaterial): void {
  root.traverse((part) => {
    if (!(part instanceof THREE.Mesh)) return;
    part.castShadow = part.receiveShadow = true;
    const before = part.material as THREE.Material | THREE.Material[];
    if (!Array.isArray(before) && before instanceof THREE.MeshStandardMaterial) {
      part.material = shadeByHand(material(before));
    }
  });
}
