import type {Corrector, Result} from './corrector.js';
import {badArgument} from './error.js';
import {jointMatrix, readJoints} from './joints.js';
import {HAND_FLOATS, JOINT_FLOATS} from './layout.js';
import type {Nade} from './nade.js';
import type {Scene} from './scene.js';
import type {Surface} from './surface.js';
import {JOINT_NAMES} from './types.js';
import type {CorrectorOptions, Hand, Side} from './types.js';
import {inverse, minus, multiply, rotate} from './vectors.js';
import type {Quaternion, Vector} from './vectors.js';

export interface XRHandsOptions extends CorrectorOptions {
  /** What hands may touch; null where no object is near. */
  touching?: Scene | Surface | null;
  /**
   * Where its coordinates are those of: a reference space of the session, or the type of one, which
   * must be among the session's features; `local-floor` where left out.
   */
  space?: XRReferenceSpace | XRReferenceSpaceType;
}

interface Pose {
  rotation: Quaternion;
  position: Vector;
}
/** A hand of a session, in the space of the objects. */
interface TrackedHand {
  readonly side: Side;
  readonly corrector: Corrector;
  readonly pose: Hand;
  readonly drawn: Hand;
  /** The frame that these are of: a browser may use one XRFrame for all of them. */
  timeMs: number | null;
  result: Result | null;
}

/** What is changed of XRFrame. */
interface Reader {
  getPose: XRFrame['getPose'];
  getJointPose: NonNullable<XRFrame['getJointPose']>;
  fillPoses(spaces: Iterable<XRSpace>, base: XRSpace, transforms: Float32Array): boolean;
}

let installed: XRHands | null = null;

/**
 * Corrected hands for all that reads hands through XRFrame, whatever the engine: `getJointPose`,
 * `fillPoses`, and `getPose` of a joint. Grips, rays, radii and velocities are the tracker's.
 */
export class XRHands {
  touching: Scene | Surface | null;
  private readonly native: Reader;
  private readonly changes = new Set<unknown>();
  private readonly nativeRequest: XRSession['requestAnimationFrame'];
  private readonly hands: Record<Side, TrackedHand>;
  private readonly owners = new WeakMap<XRSpace, {hand: XRHand; side: Side; joint: number}>();
  private asked: XRReferenceSpace | XRReferenceSpaceType;
  private session: XRSession | null = null;
  private own: XRReferenceSpace | null = null;
  private asking = false;
  private now: {frame: XRFrame; timeMs: number} | null = null;
  /** Where a space was last: engines ask for all joints of a hand in the same one. */
  private placed: {space: XRSpace; own: XRReferenceSpace; timeMs: number; pose: Pose | null} | null = null;

  /** @internal */
  constructor(nade: Nade, {touching = null, space = 'local-floor', ...options}: XRHandsOptions) {
    if (typeof XRFrame === 'undefined') {
      throw badArgument('XRFrame: expected a browser with WebXR, or its emulation, found none');
    }
    if (installed) throw badArgument('correctXRHands: hands are corrected already');
    this.touching = touching;
    this.asked = space;
    const hand = (side: Side): TrackedHand => (
      {side, corrector: nade.corrector(options), pose: new Float32Array(HAND_FLOATS),
       drawn: new Float32Array(HAND_FLOATS), timeMs: null, result: null});
    this.hands = {left: hand('left'), right: hand('right')};
    const {getPose, getJointPose, fillPoses} = XRFrame.prototype as unknown as Reader;
    this.native = {getPose, getJointPose, fillPoses};
    this.nativeRequest = XRSession.prototype.requestAnimationFrame;
    this.install();
    installed = this;
  }

  /** Where the coordinates of objects are those of; another one where the program moves its world. */
  get space(): XRReferenceSpace | XRReferenceSpaceType { return this.asked; }
  set space(space: XRReferenceSpace | XRReferenceSpaceType) {
    this.asked = space;
    if (typeof space === 'string') {
      this.session = null;  // starts anew
    } else if (this.session) {
      this.own = space;
    }
  }

  /** Status, contacts and joints of the last frame, in `space`; null where it was not tracked. */
  result(side: Side): Result | null { return this.hands[side].result; }

  /** As `frame.getJointPose` gives it without correction. */
  trackedPose(frame: XRFrame, joint: XRJointSpace, base: XRSpace): XRJointPose | undefined | null {
    return this.ask('getJointPose', frame, joint, base);
  }

  /** Frames give tracked hands again. */
  uninstall(): void {
    if (installed !== this) return;
    installed = null;
    this.asking = true;  // for good, where somebody has changed the same functions since
    this.restore(XRFrame.prototype, this.native);
    this.restore(XRSession.prototype, {requestAnimationFrame: this.nativeRequest});
    for (const {corrector} of Object.values(this.hands)) corrector.destroy();
  }

  private restore(prototype: object, native: object): void {
    for (const [name, method] of Object.entries(native)) {
      if (this.changes.has(Reflect.get(prototype, name))) Reflect.set(prototype, name, method);
    }
  }

  private change(prototype: object, name: string, method: unknown): void {
    this.changes.add(method);
    Reflect.set(prototype, name, method);
  }

  private install(): void {
    const hands = this;
    const reader: Reader = {
      getPose(this: XRFrame, space: XRSpace, base: XRSpace) {
        const tracked = hands.ask('getPose', this, space, base);
        return tracked && hands.changed(this, tracked, space, base);
      },
      getJointPose(this: XRFrame, joint: XRJointSpace, base: XRSpace) {
        const tracked = hands.ask('getJointPose', this, joint, base);
        return tracked && hands.changed(this, tracked, joint, base);
      },
      fillPoses(this: XRFrame, given: Iterable<XRSpace>, base: XRSpace, transforms: Float32Array) {
        const spaces = [...given];
        const filled = hands.ask('fillPoses', this, spaces, base, transforms);
        spaces.forEach((space, i) => {
          const pose = hands.poseIn(this, space, base);
          if (!pose) return;
          const joint = Float32Array.of(...pose.rotation, ...pose.position, 0);
          jointMatrix(joint, 0, transforms.subarray(16 * i, 16 * i + 16));
        });
        return filled;
      },
    };
    // What a browser lacks it goes on lacking: engines look for that.
    for (const name of Object.keys(reader) as (keyof Reader)[]) {
      if (this.native[name]) this.change(XRFrame.prototype, name, reader[name]);
    }
    const {nativeRequest} = this;
    const request: typeof nativeRequest = function(this: XRSession, callback) {
      return nativeRequest.call(this, (time, frame) => {
        hands.now = {frame, timeMs: time};
        try {
          callback(time, frame);
        } finally {
          hands.now = null;
        }
      });
    };
    this.change(XRSession.prototype, 'requestAnimationFrame', request);
  }

  /** What is tracked. An emulated frame may ask itself in turn. */
  private ask<Name extends keyof Reader>(name: Name, frame: XRFrame,
                                         ...given: Parameters<Reader[Name]>): ReturnType<Reader[Name]> {
    const native = this.native[name] as (...given: unknown[]) => ReturnType<Reader[Name]>;
    const outer = this.asking;
    this.asking = true;
    try {
      return native.apply(frame, given);
    } finally {
      this.asking = outer;
    }
  }

  /** `tracked` with the pose as corrected, where it is. */
  private changed<Tracked extends XRPose>(frame: XRFrame, tracked: Tracked, space: XRSpace,
                                          base: XRSpace): Tracked {
    const pose = this.poseIn(frame, space, base);
    if (!pose) return tracked;
    const [x, y, z, w] = pose.rotation;
    const [px, py, pz] = pose.position;
    const {radius, emulatedPosition} = tracked as XRPose & {radius?: number};
    const value = {
      transform: new XRRigidTransform({x: px, y: py, z: pz, w: 1}, {x, y, z, w}),
      emulatedPosition, radius,
      linearVelocity: tracked.linearVelocity, angularVelocity: tracked.angularVelocity,
    };
    return Object.create(Object.getPrototypeOf(tracked) as object,
                         Object.getOwnPropertyDescriptors(value)) as Tracked;
  }

  /** Null where correction changes nothing. */
  private poseIn(frame: XRFrame, space: XRSpace, base: XRSpace): Pose | null {
    if (this.asking) return null;
    const joint = this.jointOf(frame, space);
    const from = this.jointOf(frame, base);
    if (!this.own || (!joint && !from)) return null;
    const to = joint ?? this.placeOf(frame, space, this.own);
    const at = from ?? this.placeOf(frame, base, this.own);
    if (!to || !at) return null;
    const back = inverse(at.rotation);
    return {rotation: multiply(back, to.rotation),
            position: rotate(back, minus(to.position, at.position))};
  }

  private placeOf(frame: XRFrame, space: XRSpace, own: XRReferenceSpace): Pose | null {
    const {placed} = this;
    const timeMs = this.now?.frame === frame ? this.now.timeMs : null;
    if (placed?.space === space && placed.own === own && placed.timeMs === timeMs) return placed.pose;
    const pose = poseOf(this.ask('getPose', frame, space, own));
    this.placed = timeMs === null ? null : {space, own, timeMs, pose};
    return pose;
  }

  /** A corrected joint in the space of the objects; null for what is none. */
  private jointOf(frame: XRFrame, space: XRSpace): Pose | null {
    const owner = 'jointName' in space ? this.ownerOf(frame.session, space) : undefined;
    const drawn = owner && this.drawnHand(frame, owner.hand, this.hands[owner.side]);
    if (!owner || !drawn) return null;
    const [x, y, z, w, px, py, pz] = drawn.subarray(JOINT_FLOATS * owner.joint);
    return {rotation: [x, y, z, w], position: [px, py, pz]};
  }

  private ownerOf(session: XRSession, space: XRSpace) {
    if (!this.owners.has(space)) {
      // Beside controllers that are held hands are in a list of their own.
      const {trackedSources = []} = session as {trackedSources?: Iterable<XRInputSource>};
      for (const {hand, handedness} of [...session.inputSources, ...trackedSources]) {
        if (!hand || handedness === 'none') continue;
        JOINT_NAMES.forEach((name, joint) => {
          const own = hand.get(name as XRHandJoint);
          if (own) this.owners.set(own, {hand, side: handedness, joint});
        });
      }
    }
    return this.owners.get(space);
  }

  /** Null where nothing is changed: not tracked, nothing near, or the space not there yet. */
  private drawnHand(frame: XRFrame, from: XRHand, hand: TrackedHand): Hand | null {
    if (!this.readyFor(frame.session)) return null;
    const timeMs = this.now?.frame === frame ? this.now.timeMs : null;
    const {corrector, side, pose, drawn} = hand;
    if (timeMs === null || timeMs !== hand.timeMs) {
      const own = this.own!;
      const tracked = readJoints(from, (joint) => this.trackedPose(frame, joint, own), pose);
      if (timeMs === null) {
        // Of an event, whose time is not known: what the last frame changed.
        if (tracked && isChanged(hand.result)) return corrector.preview(side, pose, drawn);
        return null;
      }
      hand.timeMs = timeMs;
      hand.result = tracked ? corrector.update(side, pose, this.touching, timeMs) : null;
      if (hand.result) drawn.set(hand.result.joints);
    }
    return isChanged(hand.result) ? drawn : null;
  }

  private readyFor(session: XRSession): boolean {
    if (session !== this.session) {
      this.session = session;
      this.own = null;
      for (const hand of Object.values(this.hands)) {
        hand.corrector.reset();
        hand.timeMs = hand.result = null;
      }
      void this.findSpace(session, this.asked);
    }
    return this.own !== null;
  }

  private async findSpace(session: XRSession, asked: XRReferenceSpace | XRReferenceSpaceType) {
    if (typeof asked !== 'string') {
      this.own = asked;
      return;
    }
    try {
      const found = await session.requestReferenceSpace(asked);
      if (this.session === session && this.asked === asked) this.own = found;
    } catch {
      // Nobody waits for this one.
      reportError(badArgument(
          `space: expected ${asked} among the session's features, found none; no hand is corrected`));
    }
  }
}

function isChanged(result: Result | null): boolean {
  return result?.status === 'corrected' || result?.status === 'released';
}

function poseOf(pose: XRPose | undefined | null): Pose | null {
  if (!pose) return null;
  const {position: p, orientation: q} = pose.transform;
  return {rotation: [q.x, q.y, q.z, q.w], position: [p.x, p.y, p.z]};
}

/**
 * From now on every engine reads corrected hands from XRFrame. A browser's own XRFrame is changed
 * for that: once a page, and until `uninstall`.
 */
export function correctXRHands(nade: Nade, options: XRHandsOptions = {}): XRHands {
  return new XRHands(nade, options);
}
