/** The skin of a hand in three.js, flattened where it is sunk in what it touches. */
import {BufferGeometry, DynamicDrawUsage, Float32BufferAttribute, Matrix3, Matrix4, Mesh, Quaternion,
        Vector3} from 'three';
import type {BufferAttribute, SkinnedMesh} from 'three';
import {badArgument} from './error.js';
import {fillPalm} from './joints.js';
import {HAND_FLOATS, JOINT_FLOATS} from './layout.js';
import type {Nade} from './nade.js';
import type {Scene} from './scene.js';
import type {Skin} from './skin.js';
import type {Surface} from './surface.js';
import {JOINT_NAMES} from './types.js';
import type {Hand, HandMesh, Side, SkinOptions} from './types.js';

/** By the skeleton's bone, the joint of its name; -1 where there is none. */
const jointsOf = ({skeleton}: SkinnedMesh) => skeleton.bones.map(({name}) => JOINT_NAMES.indexOf(name));

/** Whether its bones are the joints of a hand as WebXR names them. */
export function isHandMesh(mesh: SkinnedMesh): boolean {
  const found = jointsOf(mesh);
  return JOINT_NAMES.every((name, joint) => name === 'palm' || found.includes(joint));
}

/**
 * Stands for a skinned mesh of a hand, which it hides: drawn by vertices that are moved, with the
 * same material. Its frame is that of the joints.
 */
export class FlattenedSkin extends Mesh<BufferGeometry> {
  private readonly skin: Skin;

  constructor(nade: Nade, readonly original: SkinnedMesh, side: Side) {
    super(new BufferGeometry(), original.material);
    this.skin = nade.skin(handMeshOf(original, side));
    const {geometry} = original;
    this.geometry.setIndex(geometry.index);
    for (const [name, attribute] of Object.entries(geometry.attributes)) {
      if (!/^(position|normal|tangent|skin)/.test(name)) this.geometry.setAttribute(name, attribute);
    }
    for (const {materialIndex, start, count} of geometry.groups) {
      this.geometry.addGroup(start, count, materialIndex);
    }
    for (const name of ['position', 'normal'] as const) {
      const attribute = new Float32BufferAttribute(3 * this.skin.vertexCount, 3);
      this.geometry.setAttribute(name, attribute.setUsage(DynamicDrawUsage));
    }
    this.frustumCulled = false;
    this.matrixAutoUpdate = false;
    this.castShadow = original.castShadow;
    this.receiveShadow = original.receiveShadow;
    this.renderOrder = original.renderOrder;
    original.visible = false;
  }

  /** Once a frame: the joints of the hand as it is drawn, and what it touches. */
  update(joints: Hand, touching: Scene | Surface | null, options?: SkinOptions): void {
    const {geometry, skin, original} = this;
    this.material = original.material;
    skin.update(joints, touching, options);
    for (const [name, values] of [['position', skin.vertices], ['normal', skin.normals]] as const) {
      const attribute = geometry.getAttribute(name) as BufferAttribute;
      attribute.array.set(values);
      attribute.needsUpdate = true;
    }
  }

  /** The skinned mesh is drawn again. */
  destroy(): void {
    this.removeFromParent();
    this.skin.destroy();
    this.geometry.dispose();
    this.original.visible = true;
  }
}

/** The mesh in its bind pose, metres, with bones as nade has them. */
function handMeshOf(mesh: SkinnedMesh, side: Side): HandMesh {
  if (!isHandMesh(mesh)) {
    throw badArgument(`${mesh.name || 'mesh'}: expected a bone for each joint of a hand, by WebXR's names`);
  }
  const {geometry, skeleton, bindMatrix} = mesh;
  // What the numbers of a file are smaller by, the bones are larger by.
  const unit = new Vector3().setFromMatrixScale(skeleton.boneInverses[0]).x;
  const position = geometry.getAttribute('position');
  const normal = geometry.getAttribute('normal');
  if (!normal) throw badArgument(`${mesh.name || 'mesh'}: expected normals, found none`);
  const {count} = position;
  const [vertices, normals] = [new Float32Array(3 * count), new Float32Array(3 * count)];
  const bind = new Matrix3().getNormalMatrix(bindMatrix);
  const at = new Vector3();
  for (let i = 0; i < count; ++i) {
    at.fromBufferAttribute(position, i).applyMatrix4(bindMatrix).multiplyScalar(unit).toArray(vertices, 3 * i);
    at.fromBufferAttribute(normal, i).applyMatrix3(bind).normalize().toArray(normals, 3 * i);
  }
  const triangles = geometry.index ? Uint32Array.from(geometry.index.array) :
    Uint32Array.from({length: count}, (_, i) => i);
  return {side, vertices, normals, triangles, ...carriersOf(mesh, count), bind: bindPose(mesh, unit)};
}

/** Four joints and weights of each vertex. */
function carriersOf(mesh: SkinnedMesh, count: number) {
  const {skinIndex, skinWeight} = mesh.geometry.attributes;
  const found = jointsOf(mesh);
  const [bones, weights] = [new Uint8Array(4 * count), new Float32Array(4 * count)];
  for (let i = 0; i < bones.length; ++i) {
    const [vertex, k] = [i >> 2, i & 3];
    const weight = skinWeight.getComponent(vertex, k);
    if (!(weight > 0)) continue;
    const bone = skinIndex.getComponent(vertex, k);
    if (found[bone] < 0) {
      throw badArgument(`${mesh.name || 'mesh'}: expected bones that are joints, found ` +
                        mesh.skeleton.bones[bone].name);
    }
    bones[i] = found[bone];
    weights[i] = weight;
  }
  return {bones, weights};
}

function bindPose({skeleton}: SkinnedMesh, unit: number): Hand {
  const bind = new Float32Array(HAND_FLOATS);
  const [matrix, position, rotation, scale] = [new Matrix4(), new Vector3(), new Quaternion(), new Vector3()];
  skeleton.bones.forEach(({name}, i) => {
    const joint = JOINT_NAMES.indexOf(name);
    if (joint < 0) return;
    matrix.copy(skeleton.boneInverses[i]).invert().decompose(position, rotation, scale);
    rotation.toArray(bind, JOINT_FLOATS * joint);
    position.multiplyScalar(unit).toArray(bind, JOINT_FLOATS * joint + 4);
  });
  fillPalm(bind);
  return bind;
}
