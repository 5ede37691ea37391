/** nade with WebXR, whatever the engine: hands from XRFrame, or corrected within it. */
import {readJoints} from './joints.js';
import type {Hand} from './types.js';

export {fillPalm, jointMatrix} from './joints.js';
export {correctXRHands, XRHands} from './xr_hands.js';
export type {XRHandsOptions} from './xr_hands.js';

/** Reads a tracked hand of this frame; false where a joint is not tracked. */
export function readXRHand(frame: XRFrame, from: XRHand, space: XRReferenceSpace,
                           into: Hand): boolean {
  return readJoints(from, (joint) => frame.getJointPose?.(joint, space), into);
}
