import {JOINT_COUNT} from './layout.js';

/** The joints of a hand in nade's order, OpenXR's; by their names in WebXR, and the palm. */
export const JOINT_NAMES = [
  'palm', 'wrist', 'thumb-metacarpal', 'thumb-phalanx-proximal', 'thumb-phalanx-distal',
  'thumb-tip',
  ...['index', 'middle', 'ring', 'pinky'].flatMap((finger) => [
    `${finger}-finger-metacarpal`, `${finger}-finger-phalanx-proximal`,
    `${finger}-finger-phalanx-intermediate`, `${finger}-finger-phalanx-distal`,
    `${finger}-finger-tip`,
  ]),
] as readonly string[];
export {JOINT_COUNT};

export type Side = 'left' | 'right';
/** `none`: the tracked hand; `paper`: the baseline of 2023; `nade`: the default. */
export type Method = 'none' | 'paper' | 'nade';
/** What became of a tracked hand, see nade_hand_status of nade.h. */
export type HandStatus = 'free' | 'corrected' | 'released' | 'untracked';

/**
 * A hand: 26 joints of 8 numbers, rotation x y z w, position x y z, radius (0 where unknown).
 * Metres, right-handed, +Y up; in a joint's frame -Z points to the fingertip, +Y to the back of
 * the hand.
 */
export type Hand = Float32Array;

/** Where something stands; what is left out is no motion, scale 1. */
export interface Placement {
  position?: ArrayLike<number>;
  /** x y z w */
  rotation?: ArrayLike<number>;
  scale?: number;
}

/** What an object is like under the hand; left out: hard, without friction. */
export interface Feel {
  /** The skin sinks in so far at the most, metres, 0 to 0.02. */
  softness?: number;
  /** Pressing so deep sinks by two thirds of that, metres. */
  softnessDepth?: number;
  /** Lag over pressing depth at which the hand slips, 0 to 2. */
  friction?: number;
  /** Share of the lag that is left while it slips, 0 to 1. */
  frictionKinetic?: number;
  /** Metres. */
  longestLag?: number;
}

export interface CorrectorOptions {
  method?: Method;
  /** What cannot be continuous fades over this time, seconds, 0 to 1; 0.2 where left out. */
  release?: number;
  /** Wrist to middle knuckle of the hand that is drawn, metres; left out: as tracked. */
  handLength?: number;
  feel?: Feel;
}

/** A hand that is drawn, in its bind pose, metres. */
export interface HandMesh {
  side: Side;
  /** x y z of each vertex; so are the normals, which are unit. */
  vertices: ArrayLike<number>;
  normals: ArrayLike<number>;
  /** Three corners of each. */
  triangles: ArrayLike<number>;
  /** Four joints of each vertex, as numbers in JOINT_NAMES, and what each weighs. */
  bones: ArrayLike<number>;
  weights: ArrayLike<number>;
  bind: Hand;
}

export interface SkinOptions {
  /** Where a surface stands. */
  placement?: Placement;
  /** The size of what is drawn over the mesh's own; 1 where left out. */
  scale?: number;
  /** What is touched is drawn pressed in by so much under the hand, metres; 0 where left out. */
  give?: number;
}

/** Skin of one bone that touches. */
export interface Contact {
  /** The object's id. */
  object: number;
  /** The joint at the bone's base, as in JOINT_NAMES. */
  joint: string;
  /** Of the person's skin in the object, metres: how it presses. */
  depth: number;
  point: [number, number, number];
  normal: [number, number, number];
  /** Of the drawn skin against the object, metres a second. */
  velocity: [number, number, number];
}

/** What was found, and mended, in a mesh; see nade_mesh_report of nade.h. */
export interface MeshReport {
  solid: 'closed' | 'defective' | 'sheet';
  trianglesUsed: number;
  trianglesDegenerate: number;
  trianglesDuplicate: number;
  trianglesTurned: number;
  borderEdges: number;
  nonmanifoldEdges: number;
}

/** The point of a surface nearest to a query. */
export interface SurfacePoint {
  point: [number, number, number];
  /** Unit, out of the solid. */
  normal: [number, number, number];
  /** Negative inside the solid. */
  signedDistance: number;
}
