/** Hands of WebXR as nade has them. */
import {JOINT_FLOATS} from './layout.js';
import {JOINT_NAMES} from './types.js';
import type {Hand} from './types.js';

const WRIST = 1;
const MIDDLE_METACARPAL = 11;
const MIDDLE_KNUCKLE = 12;

/** WebXR gives no palm: the middle of the middle metacarpal, turned like it. */
export function fillPalm(hand: Hand): void {
  const bone = JOINT_FLOATS * MIDDLE_METACARPAL;
  const knuckle = JOINT_FLOATS * MIDDLE_KNUCKLE;
  hand.copyWithin(0, bone, bone + JOINT_FLOATS);
  for (let i = 4; i < 7; ++i) hand[i] = 0.5 * (hand[bone + i] + hand[knuckle + i]);
}

/** Reads a hand whose joints a function gives; false where one is not tracked. */
export function readJoints(from: XRHand,
                           poseOf: (joint: XRJointSpace) => XRJointPose | undefined | null,
                           into: Hand): boolean {
  for (let j = WRIST; j < JOINT_NAMES.length; ++j) {
    const joint = from.get(JOINT_NAMES[j] as XRHandJoint);
    const pose = joint && poseOf(joint);
    if (!pose) return false;
    const {position: p, orientation: q} = pose.transform;
    into.set([q.x, q.y, q.z, q.w, p.x, p.y, p.z, pose.radius ?? 0], JOINT_FLOATS * j);
  }
  fillPalm(into);
  return true;
}

/** The matrix of a joint, column by column, for an engine of your own. */
export function jointMatrix(hand: Hand, joint: number, into: Float32Array = new Float32Array(16)): Float32Array {
  const [x, y, z, w, px, py, pz] = hand.subarray(JOINT_FLOATS * joint);
  into.set([
    1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0,
    2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0,
    2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0,
    px, py, pz, 1,
  ]);
  return into;
}
