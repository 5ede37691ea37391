import {create, Surface} from './surface.js';
import {withFeel, writePlacement} from './structs.js';
import {PLACEMENT_BYTES} from './layout.js';
import type {Feel, Placement} from './types.js';
import type {Address, Wasm} from './wasm.js';

/** All objects that a hand may touch, by ids of the program's own: whole numbers from 0. */
export class Scene {
  /** @internal */
  readonly handle: Address;
  private readonly placement: Address;

  /** @internal */
  constructor(private readonly wasm: Wasm) {
    this.handle = create(wasm, 'nade_scene_create');
    this.placement = wasm.allocate(PLACEMENT_BYTES);
  }

  /** One more object. One that comes where a hand is pushes it out slowly. */
  add(id: number, surface: Surface, placement: Placement = {}, feel?: Feel): void {
    writePlacement(this.wasm, this.placement, placement);
    withFeel(this.wasm, feel, (felt) => this.wasm.call(
      'nade_scene_add', this.handle, BigInt(id), surface.handle, this.placement, felt));
  }
  /** Moves, turns or scales an object; a scale of 0 hides it. */
  place(id: number, placement: Placement): void {
    writePlacement(this.wasm, this.placement, placement);
    this.wasm.call('nade_scene_place', this.handle, BigInt(id), this.placement);
  }
  /** The object's surface was refitted. */
  deformed(id: number): void { this.wasm.call('nade_scene_deformed', this.handle, BigInt(id)); }
  setFeel(id: number, feel?: Feel): void {
    withFeel(this.wasm, feel, (felt) =>
      this.wasm.call('nade_scene_set_feel', this.handle, BigInt(id), felt));
  }
  /** A hand on it comes back slowly to where the person is. */
  remove(id: number): void { this.wasm.call('nade_scene_remove', this.handle, BigInt(id)); }
  get size(): number {
    return this.wasm.with(8, (at) => {
      this.wasm.call('nade_scene_size', this.handle, at);
      return this.wasm.data.getUint32(at, true);
    });
  }
  destroy(): void {
    this.wasm.call('nade_scene_destroy', this.handle);
    this.wasm.free(this.placement);
  }
}
