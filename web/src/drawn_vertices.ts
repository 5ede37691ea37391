/** The vertices of a three.js object as they are drawn: with bones and morph targets. */
import {Matrix4} from 'three';
import type {BufferAttribute, InstancedMesh, InterleavedBufferAttribute, Mesh, Object3D,
             SkinnedMesh} from 'three';

type Attribute = BufferAttribute | InterleavedBufferAttribute;

/** A mesh of the object, once for each instance. */
interface Part {
  mesh: Mesh;
  instance: number | null;
  positions: Float32Array;
  /** Of each vertex, four of both. */
  bones: Uint16Array | null;
  weights: Float32Array | null;
  morphs: Float32Array[];
}

const matrix = new Matrix4();
const into = new Matrix4();
const home = new Matrix4();

/** What of the meshes stays the same is read once. */
export class DrawnVertices {
  readonly count: number;
  /** Whether bones or morph targets can move them. */
  readonly deforms: boolean;
  private readonly parts: Part[] = [];
  private readonly vertices: Float32Array;
  private pose: number[] = [];

  constructor(private readonly object: Object3D) {
    object.traverse((part) => {
      const mesh = part as InstancedMesh;
      if (!mesh.isMesh || !mesh.geometry.getAttribute('position')) return;
      const shared = partOf(mesh);
      const count = mesh.isInstancedMesh ? mesh.count : 1;
      for (let i = 0; i < count; ++i) {
        this.parts.push({...shared, instance: mesh.isInstancedMesh ? i : null});
      }
    });
    this.count = this.parts.reduce((sum, {positions}) => sum + positions.length / 3, 0);
    this.deforms = this.parts.some(({bones, morphs}) => bones !== null || morphs.length > 0);
    this.vertices = new Float32Array(3 * this.count);
  }

  /** Three corners of each triangle, counter-clockwise where they are drawn. */
  triangles(): Uint32Array {
    this.placeObject();
    const triangles: number[] = [];
    let first = 0;
    for (const part of this.parts) {
      const {index} = part.mesh.geometry;
      const corners = index ? index.count : part.positions.length / 3;
      const turned = intoHome(part).determinant() < 0;
      for (let i = 0; i + 2 < corners; i += 3) {
        const [a, b, c] = [0, 1, 2].map((k) => first + (index ? index.getX(i + k) : i + k));
        triangles.push(a, turned ? c : b, turned ? b : c);
      }
      first += part.positions.length / 3;
    }
    return new Uint32Array(triangles);
  }

  /** In the object's frame, as it stands now: the same array each time. Null: as the last time. */
  read(): Float32Array | null {
    this.placeObject();
    const moves = this.parts.map((part) => ({part, matrices: matricesOf(part)}));
    const pose = moves.flatMap(({part, matrices}) => [...matrices, ...influencesOf(part)]);
    if (pose.length === this.pose.length && pose.every((x, i) => x === this.pose[i])) return null;
    this.pose = pose;
    let at = 0;
    for (const {part, matrices} of moves) {
      move(part, matrices, this.vertices.subarray(at, at += part.positions.length));
    }
    return this.vertices;
  }

  private placeObject(): void {
    this.object.updateWorldMatrix(true, true);
    home.copy(this.object.matrixWorld).invert();
  }
}

function partOf(mesh: Mesh): Omit<Part, 'instance'> {
  const {geometry} = mesh;
  const numbers = (attribute: Attribute, size: number) => {
    const read = new Float32Array(size * attribute.count);
    for (let i = 0; i < read.length; ++i) {
      read[i] = attribute.getComponent(Math.floor(i / size), i % size);
    }
    return read;
  };
  const skinned = (mesh as SkinnedMesh).isSkinnedMesh;
  return {
    mesh,
    positions: numbers(geometry.getAttribute('position'), 3),
    bones: skinned ? Uint16Array.from(numbers(geometry.getAttribute('skinIndex'), 4)) : null,
    weights: skinned ? numbers(geometry.getAttribute('skinWeight'), 4) : null,
    morphs: (geometry.morphAttributes.position ?? []).map((morph) => numbers(morph, 3)),
  };
}

const influencesOf = ({mesh, morphs}: Part) => morphs.map((_, i) => mesh.morphTargetInfluences?.[i] ?? 0);

/** From a mesh's frame to the object's. */
function intoHome({mesh, instance}: Part): Matrix4 {
  into.multiplyMatrices(home, mesh.matrixWorld);
  if (instance !== null) {
    (mesh as InstancedMesh).getMatrixAt(instance, matrix);
    into.multiply(matrix);
  }
  return into;
}

/** What moves its vertices: one matrix, or one of each bone. */
function matricesOf(part: Part): Float32Array {
  const whole = intoHome(part);
  if (!part.bones) return new Float32Array(whole.elements);
  const {skeleton, bindMatrix, bindMode} = part.mesh as SkinnedMesh;
  for (const bone of skeleton.bones) {
    // They need not be parts of the object.
    if (!(bone.parent as {isBone?: boolean} | null)?.isBone) bone.updateWorldMatrix(true, true);
  }
  // Bones stand in the world; bound in the attached mode the mesh's own place cancels out.
  const unbound = bindMode === 'detached' ?
    whole.clone().multiply(matrix.copy(bindMatrix).invert()) : home;
  const matrices = new Float32Array(16 * skeleton.bones.length);
  skeleton.bones.forEach((bone, i) => {
    matrix.multiplyMatrices(unbound, bone.matrixWorld).multiply(skeleton.boneInverses[i]);
    matrix.multiply(bindMatrix).toArray(matrices, 16 * i);
  });
  return matrices;
}

function move(part: Part, matrices: Float32Array, vertices: Float32Array): void {
  const positions = morphed(part);
  const {bones, weights} = part;
  for (let v = 0; v < positions.length; v += 3) {
    const [x, y, z] = [positions[v], positions[v + 1], positions[v + 2]];
    let [sumX, sumY, sumZ] = [0, 0, 0];
    for (let k = 0; k < (bones ? 4 : 1); ++k) {
      const weight = weights ? weights[4 * v / 3 + k] : 1;
      if (weight === 0) continue;
      const m = bones ? 16 * bones[4 * v / 3 + k] : 0;
      sumX += weight * (matrices[m] * x + matrices[m + 4] * y + matrices[m + 8] * z +
                        matrices[m + 12]);
      sumY += weight * (matrices[m + 1] * x + matrices[m + 5] * y + matrices[m + 9] * z +
                        matrices[m + 13]);
      sumZ += weight * (matrices[m + 2] * x + matrices[m + 6] * y + matrices[m + 10] * z +
                        matrices[m + 14]);
    }
    vertices[v] = sumX;
    vertices[v + 1] = sumY;
    vertices[v + 2] = sumZ;
  }
}

function morphed(part: Part): Float32Array {
  const {positions, morphs, mesh} = part;
  const influences = influencesOf(part);
  if (influences.every((influence) => influence === 0)) return positions;
  const sum = positions.slice();
  morphs.forEach((morph, m) => {
    const influence = influences[m];
    if (influence === 0) return;
    const rest = mesh.geometry.morphTargetsRelative ? 0 : influence;
    for (let i = 0; i < sum.length; ++i) sum[i] += influence * morph[i] - rest * positions[i];
  });
  return sum;
}
