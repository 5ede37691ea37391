// The hands that come with nade, as XRHandModelFactory's mesh model has them.
import {readFileSync} from 'node:fs';

import {Bone, BufferAttribute, BufferGeometry, Group, Matrix4, Skeleton, SkinnedMesh} from 'three';

import {readGlb} from '../glb.js';

const HANDS = new URL('../../build/release/share/nade/hands/', import.meta.url);

/** A skinned mesh and its bones, in a group. */
export function handModel(side) {
  const {gltf, read} = readGlb(readFileSync(new URL(`${side}.glb`, HANDS)));
  const [{attributes, indices}] = gltf.meshes[0].primitives;
  const geometry = new BufferGeometry();
  const add = (name, key, size) =>
    geometry.setAttribute(name, new BufferAttribute(read(attributes[key]), size));
  add('position', 'POSITION', 3);
  add('normal', 'NORMAL', 3);
  add('uv', 'TEXCOORD_0', 2);
  add('skinIndex', 'JOINTS_0', 4);
  add('skinWeight', 'WEIGHTS_0', 4);
  geometry.setIndex(new BufferAttribute(read(indices), 1));
  const [{joints, inverseBindMatrices}] = gltf.skins;
  const inverse = read(inverseBindMatrices);
  const bones = joints.map((node) => Object.assign(new Bone(), {name: gltf.nodes[node].name}));
  const mesh = new SkinnedMesh(geometry);
  mesh.bind(new Skeleton(bones, joints.map((_, i) => new Matrix4().fromArray(inverse, 16 * i))), new Matrix4());
  const model = new Group();
  model.add(mesh, ...bones);
  return {model, mesh, bones};
}
