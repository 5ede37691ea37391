/** What a loaded nade has. */
import {Corrector} from './corrector.js';
import {badArgument, NadeError} from './error.js';
import {HAND_FLOATS} from './layout.js';
import {Scene} from './scene.js';
import {Skin} from './skin.js';
import {expectLength, sideNumber} from './structs.js';
import {create, createGroup, createMesh, GroupSurface, MeshSurface, Surface,
        withDoubles} from './surface.js';
import type {CorrectorOptions, Hand, HandMesh, Placement, Side} from './types.js';
import {Wasm} from './wasm.js';

export {Corrector, Result} from './corrector.js';
export {NadeError} from './error.js';
export {HAND_FLOATS, JOINT_FLOATS} from './layout.js';
export {Scene} from './scene.js';
export {Skin} from './skin.js';
export {GroupSurface, MeshSurface, Surface} from './surface.js';
export * from './types.js';

const ABI_VERSION = 1;

/** A loaded nade. What it makes lives in its own memory, and does not mix with another one's. */
export class Nade {
  /** @internal */
  readonly wasm: Wasm;

  /** @internal */
  constructor(module: WebAssembly.Module) {
    this.wasm = new Wasm(module);
    const abi = this.wasm.ask('nade_abi_version');
    if (abi !== ABI_VERSION) {
      throw new NadeError(-7, `nade.wasm: expected version ${ABI_VERSION} of it, found ${abi}`);
    }
  }

  /** The release of nade.wasm, "0.1.0". */
  get version(): string { return this.wasm.text(this.wasm.ask('nade_version')); }

  /** The half-space below y = 0. */
  plane(): Surface { return this.made('nade_surface_create_plane'); }
  /** A flat plate, solid below its top, which is at y = 0 within an outline of x, z, x, z … */
  plate(outline: ArrayLike<number>, thickness: number): Surface {
    return this.wasm.withFloats(outline, (at) =>
      this.made('nade_surface_create_plate', at, outline.length >> 1, thickness));
  }
  /** A ball about the origin. */
  sphere(radius: number): Surface { return this.made('nade_surface_create_sphere', radius); }
  ellipsoid(halfAxes: ArrayLike<number>): Surface {
    expectLength(halfAxes, 3, 'halfAxes');
    return withDoubles(this.wasm, halfAxes, (at) => this.made('nade_surface_create_ellipsoid', at));
  }
  /** A box about the origin; `rounding` of its edges lies within its size. */
  box(halfSize: ArrayLike<number>, rounding = 0): Surface {
    expectLength(halfSize, 3, 'halfSize');
    return withDoubles(this.wasm, halfSize, (at) =>
      this.made('nade_surface_create_box', at, rounding));
  }
  /** About the Y axis, its middle in the origin; so is the capsule. */
  cylinder(halfHeight: number, radius: number, rounding = 0): Surface {
    return this.made('nade_surface_create_cylinder', halfHeight, radius, rounding);
  }
  capsule(length: number, radius: number): Surface {
    return this.made('nade_surface_create_capsule', length, radius);
  }
  /** The smallest convex solid with all points in it, x y z each. */
  hull(points: ArrayLike<number>): Surface {
    return this.wasm.withFloats(points, (at) =>
      this.made('nade_surface_create_hull', at, Math.floor(points.length / 3)));
  }
  /** Heights, rows (+Z) of columns (+X), `step` apart, about the origin. */
  heightField(heights: ArrayLike<number>, columns: number, step: number): Surface {
    if (heights.length % columns !== 0) {
      throw badArgument(`heights: expected rows of ${columns}, found ${heights.length}`);
    }
    return this.wasm.withFloats(heights, (at) => this.made(
      'nade_surface_create_height_field', at, columns, heights.length / columns, step));
  }
  /** A triangle mesh: x y z of each vertex, three indices of each triangle. */
  mesh(vertices: ArrayLike<number>, triangles: ArrayLike<number>): MeshSurface {
    return createMesh(this.wasm, vertices, triangles);
  }
  /** Up to 255 surfaces as one. */
  group(members: {surface: Surface; placement?: Placement}[]): GroupSurface {
    return createGroup(this.wasm, members);
  }

  scene(): Scene { return new Scene(this.wasm); }
  corrector(options: CorrectorOptions = {}): Corrector { return new Corrector(this.wasm, options); }
  /** For drawing: the skin of a hand mesh, flattened where it is sunk. Takes some milliseconds. */
  skin(mesh: HandMesh): Skin { return new Skin(this.wasm, mesh); }

  /** The built-in hand at rest: the palm joint in the origin, palm down, fingers along -Z. */
  restHand(side: Side): Hand {
    return this.wasm.with(4 * HAND_FLOATS, (at) => {
      this.wasm.call('nade_rest_hand', sideNumber(side), at);
      return this.wasm.floats.slice(at / 4, at / 4 + HAND_FLOATS);
    });
  }

  private made(name: string, ...values: number[]): Surface {
    return new Surface(this.wasm, create(this.wasm, name, ...values));
  }
}
