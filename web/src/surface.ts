import {badArgument} from './error.js';
import {GROUP_MEMBER_BYTES, MESH_BYTES, MESH_REPORT_BYTES, SURFACE_POINT_BYTES} from './layout.js';
import {expectLength, withPlacement, writePlacement} from './structs.js';
import type {MeshReport, Placement, SurfacePoint} from './types.js';
import type {Address, Wasm} from './wasm.js';

const SOLIDS = ['closed', 'defective', 'sheet'] as const;

/** What a hand may touch, in its own frame, metres. Several objects may share one. */
export class Surface {
  /** @internal */
  constructor(protected readonly wasm: Wasm, /** @internal */ readonly handle: Address) {}

  /**
   * The point nearest to `query`, world coordinates, of the surface as placed; null where there is
   * none within `maxDistance`.
   */
  closestPoint(query: ArrayLike<number>, maxDistance = Infinity,
               placement?: Placement): SurfacePoint | null {
    expectLength(query, 3, 'query');
    const wasm = this.wasm;
    return withPlacement(wasm, placement, (placed) => wasm.with(SURFACE_POINT_BYTES + 32, (at) => {
      const asked = at + SURFACE_POINT_BYTES;
      for (let i = 0; i < 3; ++i) wasm.data.setFloat64(asked + 8 * i, query[i], true);
      wasm.call('nade_surface_closest_point', this.handle, placed, asked, maxDistance, at,
                asked + 24);
      const data = wasm.data;
      if (data.getInt32(asked + 24, true) === 0) return null;
      const triple = (from: number): [number, number, number] =>
        [0, 8, 16].map((i) => data.getFloat64(from + i, true)) as [number, number, number];
      return {point: triple(at), normal: triple(at + 24),
              signedDistance: data.getFloat64(at + 48, true)};
    }));
  }

  /** Frees it, when the last scene or corrector that uses it has gone. */
  destroy(): void { this.wasm.call('nade_surface_destroy', this.handle); }
}

/** A triangle mesh; its vertices may move. */
export class MeshSurface extends Surface {
  private vertices: Address = 0;  // where they are passed on, once they have moved

  /** @internal */
  constructor(wasm: Wasm, handle: Address, readonly vertexCount: number,
              readonly report: MeshReport) {
    super(wasm, handle);
  }

  /** New positions for its vertices. Scenes that have it are told by `Scene.deformed`. */
  refit(vertices: ArrayLike<number>): void {
    expectLength(vertices, 3 * this.vertexCount, 'vertices');
    this.vertices ||= this.wasm.allocate(12 * this.vertexCount);
    this.wasm.floats.set(vertices, this.vertices / 4);
    this.wasm.call('nade_surface_refit', this.handle, this.vertices, this.vertexCount);
  }

  override destroy(): void {
    super.destroy();
    this.wasm.free(this.vertices);  // 0 is none
    this.vertices = 0;
  }
}

/** Several surfaces as one. */
export class GroupSurface extends Surface {
  /** Moves a member. */
  place(index: number, placement: Placement): void {
    withPlacement(this.wasm, placement, (placed) =>
      this.wasm.call('nade_surface_place_member', this.handle, index, placed));
  }
}

/** Calls a `create` with `values` and gives the handle. */
export function create(wasm: Wasm, name: string, ...values: (number | bigint)[]): Address {
  return wasm.with(8, (at) => {
    wasm.call(name, ...values, at);
    return wasm.data.getUint32(at, true);
  });
}

export function withDoubles<Result>(wasm: Wasm, values: ArrayLike<number>,
                                    use: (address: Address) => Result): Result {
  return wasm.with(8 * values.length, (at) => {
    for (let i = 0; i < values.length; ++i) wasm.data.setFloat64(at + 8 * i, values[i], true);
    return use(at);
  });
}

export function createMesh(wasm: Wasm, vertices: ArrayLike<number>,
                           triangles: ArrayLike<number>): MeshSurface {
  for (const [array, name] of [[vertices, 'vertices'], [triangles, 'triangles']] as const) {
    if (array == null || array.length === 0 || array.length % 3 !== 0) {
      throw badArgument(`${name}: expected three numbers each, found ${array?.length ?? array}`);
    }
  }
  const count = vertices.length / 3;
  return wasm.withFloats(vertices, (points) => wasm.with(4 * triangles.length, (corners) =>
    wasm.with(MESH_BYTES + MESH_REPORT_BYTES, (mesh) => {
      new Uint32Array(wasm.bytes.buffer).set(triangles, corners / 4);
      const report = mesh + MESH_BYTES;
      const set = (at: Address, value: number) => wasm.data.setUint32(at, value, true);
      set(mesh, MESH_BYTES);
      set(mesh + 4, count);
      set(mesh + 8, triangles.length / 3);
      set(mesh + 24, points);
      set(mesh + 28, corners);
      set(report, MESH_REPORT_BYTES);
      const handle = create(wasm, 'nade_surface_create_mesh', mesh, report);
      const read = (field: number) => wasm.data.getUint32(report + 4 * field, true);
      return new MeshSurface(wasm, handle, count, {
        solid: SOLIDS[read(1)], trianglesUsed: read(2), trianglesDegenerate: read(3),
        trianglesDuplicate: read(4), trianglesTurned: read(5), borderEdges: read(6),
        nonmanifoldEdges: read(7),
      });
    })));
}

export function createGroup(wasm: Wasm,
                            members: {surface: Surface; placement?: Placement}[]): GroupSurface {
  return wasm.with(GROUP_MEMBER_BYTES * members.length, (at) => {
    members.forEach(({surface, placement = {}}, i) => {
      wasm.data.setUint32(at + GROUP_MEMBER_BYTES * i, surface.handle, true);
      writePlacement(wasm, at + GROUP_MEMBER_BYTES * i + 4, placement);
    });
    return new GroupSurface(wasm,
                            create(wasm, 'nade_surface_create_group', at, members.length));
  });
}
