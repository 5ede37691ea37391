import {CONTACT_BYTES, HAND_FLOATS, JOINT_COUNT, PLACEMENT_BYTES, RESULT_BYTES, RESULT_CONTACTS,
        RESULT_JOINTS, RESULT_VELOCITIES} from './layout.js';
import {badArgument} from './error.js';
import {Scene} from './scene.js';
import {create, Surface} from './surface.js';
import {expectLength, sideNumber, withFeel, withOptions, writePlacement} from './structs.js';
import {JOINT_NAMES} from './types.js';
import type {Contact, CorrectorOptions, Feel, Hand, HandStatus, Placement, Side} from './types.js';
import type {Address, Wasm} from './wasm.js';

const STATUSES: readonly HandStatus[] = ['free', 'corrected', 'released', 'untracked'];

/** A corrected hand; the same object in every frame, with other contents. */
export class Result {
  status: HandStatus = 'free';
  /** Why an untracked hand could not be used; '' otherwise. */
  fault = '';
  /** The hand to draw. */
  readonly joints: Hand = new Float32Array(HAND_FLOATS);
  /** Of the drawn joints, x y z each, metres a second. */
  readonly velocities = new Float32Array(3 * JOINT_COUNT);
  /** What touches, at most one of each bone. */
  contacts: Contact[] = [];
}

/** Corrects one hand, frame by frame: one for each hand. */
export class Corrector {
  private readonly handle: Address;
  private readonly tracked: Address;
  private readonly result: Address;
  private readonly placement: Address;
  private readonly shown = new Result();

  /** @internal */
  constructor(private readonly wasm: Wasm, options: CorrectorOptions) {
    this.handle = withOptions(wasm, options, (at) => create(wasm, 'nade_corrector_create', at));
    this.tracked = wasm.allocate(4 * HAND_FLOATS);
    this.result = wasm.allocate(RESULT_BYTES);
    this.placement = wasm.allocate(PLACEMENT_BYTES);
  }

  /**
   * The hand to draw for a hand as it is tracked, never as it was drawn, that may touch a surface
   * or the objects of a scene; null in frames in which no object is near. `timeMs` of any origin.
   * A hand that is not tracked is not passed at all. `placement` and `object` are those of a
   * surface; `object` is any number that tells objects that share it apart.
   */
  update(side: Side, joints: Hand, touching: Surface | Scene | null, timeMs: number,
         placement?: Placement, object = 0): Result {
    const {wasm, handle, tracked, result} = this;
    this.take(joints);
    if (!Number.isFinite(timeMs)) throw badArgument(`timeMs: expected a number, found ${timeMs}`);
    const time = BigInt(Math.round(timeMs * 1e6));
    wasm.data.setUint32(result, RESULT_BYTES, true);
    if (touching instanceof Scene) {
      wasm.call('nade_corrector_update_scene', handle, sideNumber(side), tracked, touching.handle,
                time, result);
    } else {
      if (placement) writePlacement(wasm, this.placement, placement);
      wasm.call('nade_corrector_update', handle, sideNumber(side), tracked, touching?.handle ?? 0,
                placement ? this.placement : 0, BigInt(object), time, result);
    }
    this.show();
    return this.shown;
  }

  /** The latest correction on a newer pose of the same hand; remembers nothing. */
  preview(side: Side, joints: Hand, drawn: Hand = new Float32Array(HAND_FLOATS)): Hand {
    expectLength(drawn, HAND_FLOATS, 'drawn');
    this.take(joints);
    this.wasm.call('nade_corrector_preview', this.handle, sideNumber(side), this.tracked,
                   this.tracked);
    const at = this.tracked / 4;
    drawn.set(this.wasm.floats.subarray(at, at + HAND_FLOATS));
    return drawn;
  }

  /** How objects outside of a scene feel from the next frame on. */
  setFeel(feel?: Feel): void {
    withFeel(this.wasm, feel, (felt) =>
      this.wasm.call('nade_corrector_set_feel', this.handle, felt));
  }
  /** Forgets everything about the hand so far. */
  reset(): void { this.wasm.call('nade_corrector_reset', this.handle); }
  destroy(): void {
    this.wasm.call('nade_corrector_destroy', this.handle);
    for (const address of [this.tracked, this.result, this.placement]) this.wasm.free(address);
  }

  private take(joints: Hand): void {
    expectLength(joints, HAND_FLOATS, 'joints');
    this.wasm.floats.set(joints, this.tracked / 4);
  }

  private show(): void {
    const {wasm, shown, result} = this;
    const {data, floats} = wasm;
    shown.status = STATUSES[data.getInt32(result + 4, true)];
    const fault = data.getInt32(result + 8, true);
    shown.fault = fault === 0 ? '' : wasm.text(wasm.ask('nade_fault_text', fault));
    const joints = (result + RESULT_JOINTS) / 4;
    shown.joints.set(floats.subarray(joints, joints + HAND_FLOATS));
    const velocities = (result + RESULT_VELOCITIES) / 4;
    shown.velocities.set(floats.subarray(velocities, velocities + 3 * JOINT_COUNT));
    const count = data.getUint32(result + 12, true);
    shown.contacts = [];
    for (let i = 0; i < count; ++i) {
      const at = result + RESULT_CONTACTS + CONTACT_BYTES * i;
      const triple = (from: number): [number, number, number] =>
        [floats[from / 4], floats[from / 4 + 1], floats[from / 4 + 2]];
      shown.contacts.push({
        object: Number(data.getBigUint64(at, true)),
        joint: JOINT_NAMES[data.getInt32(at + 8, true)],
        depth: data.getFloat32(at + 12, true),
        point: triple(at + 16), normal: triple(at + 28), velocity: triple(at + 40),
      });
    }
  }
}
