/** Hands from one camera: landmarks of MediaPipe's hand tracking to hands of 26 joints. */
// Based on: Casiez, Roussel and Vogel. 1 Euro Filter: A Simple Speed-based Low-pass Filter for
// Noisy Input in Interactive Systems. 2012.
// Based on: WebXR Input Profiles. generic-hand, @webxr-input-profiles/assets 1.0.20. (its rest
// pose gives the proportions of what MediaPipe does not report)
import {badArgument} from './error.js';
import {mirrored, positionOf, put} from './hand_joints.js';
import {HAND_FLOATS} from './layout.js';
import type {Hand, Side} from './types.js';
import {along, cross, dot, fromAxes, inverse, length, minus, multiply, plus, rotate, times, turn,
        unit} from './vectors.js';
import type {Quaternion, Vector} from './vectors.js';

export interface LandmarkHand {
  side: Side;
  /** How sure MediaPipe is of the side, 0 to 1: of a hand it sees badly it is not. */
  score: number;
  /** In the picture: x to the right and y down, 0 to 1. */
  picture: Vector[];
  /** Of whatever size and place: x to the right, y up, z to the camera. */
  shape: Vector[];
}

/** What of a result of MediaPipe's Hands is used here. */
export interface MediapipeResult {
  multiHandLandmarks?: Points[];
  multiHandWorldLandmarks?: Points[];
  multiHandedness?: {label: string; score: number}[];
}
type Points = {x: number; y: number; z: number}[];

const LANDMARK_COUNT = 21;
const POINTS_OF_DIGIT = 4;
const DIGITS = 5;
const KNUCKLES = [5, 9, 13, 17];
const MIDDLE_KNUCKLE = 9;
const GENERIC_LENGTH_M = 0.092;
const SHORTEST_M = 1e-6;
/** Bones keep the lengths that they had over about so many pictures. */
const LEARNED_OVER = 90;
const SLOWEST_HZ = 1;        // cut-off of a still hand: steadies landmarks
const HZ_PER_SPEED = 10;     // and how it rises with metres a second
const SPEED_CUTOFF_HZ = 1;   // of the speed that decides

const DEGREE = Math.PI / 180;
// The right generic hand at rest, seen from its wrist.
const REST_BASES: Vector[] = [[-0.01016, -0.00706, -0.02921], [-0.00343, -0.00605, -0.02911],
                              [0.0081, -0.00605, -0.02699], [0.023, -0.00942, -0.03407]];
const REST_KNUCKLES: Vector[] = [[-0.02355, -0.00732, -0.08855], [-0.00173, -0.00254, -0.09165],
                                 [0.01747, -0.00653, -0.08469], [0.03505, -0.01369, -0.0739]];
const BASE_ROLLS = [-2.4, 6.7, 14.5, 25.2];    // degrees of +X about the bone, from the wrist's
const FINGER_ROLLS = [-2, 1.9, 8.7, 17];
const THUMB_BONE: Vector = unit([-0.5206, -0.466, -0.7154]);
const THUMB_HINGE: Vector = [-0.073, 0.862, -0.501];
// Sines of a finger's two bends, added: below the first it counts as straight, above the second
// as bent; and cosines of how well the plane of the bend agrees with the rest pose.
const STRAIGHT = 0.17;
const BENT = 0.5;
const PLANE_ASTRAY = 0.5;
const PLANE_AGREES = 0.8;

/**
 * The hands of a result, at most one of each side. MediaPipe takes a picture for one in a mirror:
 * of a picture that is none, as a camera gives it, the label is the other hand's.
 */
export function readMediapipe(result: MediapipeResult, isMirrored = false): LandmarkHand[] {
  const hands: LandmarkHand[] = [];
  (result.multiHandedness ?? []).forEach(({label, score}, i) => {
    const picture = result.multiHandLandmarks?.[i]?.map(({x, y, z}): Vector => [x, y, z]);
    const shape = (result.multiHandWorldLandmarks ?? result.multiHandLandmarks)?.[i]
      ?.map(({x, y, z}): Vector => [x, -y, -z]);
    if (!picture || !shape || ![picture, shape].every(isWhole)) return;
    const side: Side = (label === 'Right') === isMirrored ? 'right' : 'left';
    const rival = hands.findIndex((hand) => hand.side === side);
    if (rival >= 0 && hands[rival].score >= score) return;
    if (rival >= 0) hands.splice(rival, 1);
    hands.push({side, score, picture, shape});
  });
  return hands;
}

function isWhole(points: Vector[]): boolean {
  return points.length === LANDMARK_COUNT && points.every((point) => point.every(Number.isFinite));
}

/** Landmarks of one hand, frame by frame: bones of one length, and steady while the hand is still. */
export class LandmarkFilter {
  private shares: number[] | null = null;
  private shown: Vector[] | null = null;
  private speeds: Vector[] = [];
  private timeMs = 0;

  /**
   * The shape, as large as the generic hand, its wrist in the origin, without its noise; null where
   * all its points lie in one.
   */
  update(shape: Vector[], timeMs: number): Vector[] | null {
    const lengths = boneLengths(shape);
    const whole = lengths.reduce((sum, x) => sum + x, 0);
    if (!(lengths[MIDDLE_KNUCKLE] > SHORTEST_M)) return null;
    const now = lengths.map((x) => x / whole);
    this.shares = this.shares ?
      this.shares.map((x, i) => x + (now[i] - x) / LEARNED_OVER) : now;
    const scale = GENERIC_LENGTH_M / this.shares[MIDDLE_KNUCKLE];
    const size = scale / whole;
    const steady = this.steadied(shape.map((point) => times(size, minus(point, shape[0]))), timeMs);
    return withBones(steady, this.shares.map((x) => scale * x));
  }

  /** After the hand was lost: what it was like is known, where it was is not. */
  lost(): void { this.shown = null; }

  private steadied(points: Vector[], timeMs: number): Vector[] {
    const seconds = (timeMs - this.timeMs) / 1000;
    this.timeMs = timeMs;
    if (!this.shown || !(seconds > 0)) {
      this.speeds = points.map((): Vector => [0, 0, 0]);
      return this.shown = points;
    }
    const before = this.shown;
    return this.shown = points.map((point, i) => {
      const way = minus(point, before[i]);
      const share = shareOf(seconds, SPEED_CUTOFF_HZ);
      this.speeds[i] = plus(this.speeds[i],
                            times(share, minus(times(1 / seconds, way), this.speeds[i])));
      const cutoff = SLOWEST_HZ + HZ_PER_SPEED * length(this.speeds[i]);
      return plus(before[i], times(shareOf(seconds, cutoff), way));
    });
  }
}

/** The share of the way that a first-order filter of that cut-off goes in a step. */
const shareOf = (seconds: number, cutoffHz: number) =>
  1 - Math.exp(-2 * Math.PI * cutoffHz * seconds);

/** A point's neighbour on the way to the wrist. */
const before = (landmark: number) => (landmark % POINTS_OF_DIGIT === 1 ? 0 : landmark - 1);

function boneLengths(shape: Vector[]): number[] {
  return shape.map((point, i) => (i === 0 ? 0 : length(minus(point, shape[before(i)]))));
}

function withBones(shape: Vector[], bones: number[]): Vector[] {
  const lengths = boneLengths(shape);
  const result: Vector[] = [[0, 0, 0]];
  for (let i = 1; i < LANDMARK_COUNT; ++i) {
    const bone = minus(shape[i], shape[before(i)]);
    result.push(plus(result[before(i)], times(lengths[i] > 0 ? bones[i] / lengths[i] : 0, bone)));
  }
  return result;
}

/**
 * The 26 joints of 21 points, metres: the points as they are; the palm, the metacarpals and all
 * turns inferred. Null where wrist and knuckles lie in one line.
 */
export function handFromLandmarks(side: Side, points: Vector[]): Hand | null {
  if (points.length !== LANDMARK_COUNT) {
    throw badArgument(`points: expected ${LANDMARK_COUNT}, found ${points.length}`);
  }
  const right = side === 'right' ? points : points.map(flipped);
  const palm = palmOf(right);
  if (!palm) return null;
  const hand = new Float32Array(HAND_FLOATS);
  put(hand, 1, palm.rotation, right[0]);
  placeThumb(hand, palm, right.slice(1, 5));
  for (let finger = 0; finger < KNUCKLES.length; ++finger) placeFinger(hand, palm, right, finger);
  const [base, knuckle] = [11, 12].map((joint) => positionOf(hand, joint));
  put(hand, 0, palm.rotation, times(0.5, plus(base, knuckle)));
  return side === 'right' ? hand : mirrored(hand);
}

interface Palm {
  wrist: Vector;
  rotation: Quaternion;
  /** Over the generic hand. */
  scale: number;
}

/** The palm turns as the fan of the four knuckles does, seen from the wrist. */
function palmOf(points: Vector[]): Palm | null {
  const seen = fanOf(KNUCKLES.map((at) => minus(points[at], points[0])));
  if (!seen) return null;
  const breadth = length(minus(points[5], points[17]));
  return {wrist: points[0], rotation: multiply(seen, REST_FAN), scale: breadth / REST_BREADTH_M};
}

function fanOf(knuckles: Vector[]): Quaternion | null {
  const ahead = knuckles.reduce(plus);
  const up = cross(knuckles[3], knuckles[0]);
  return facing(ahead, cross(ahead, up));
}

function placeFinger(hand: Hand, palm: Palm, points: Vector[], finger: number): void {
  const knuckle = KNUCKLES[finger];
  const rest = REST_KNUCKLES[finger];
  // A metacarpal begins where the generic one does, carried along with the knuckle.
  const share = length(REST_BASES[finger]) / length(rest);
  const offset = rotate(inverse(palm.rotation), minus(points[knuckle], palm.wrist));
  const base = plus(times(palm.scale, REST_BASES[finger]),
                    times(share, minus(offset, times(palm.scale, rest))));
  const places = [plus(palm.wrist, rotate(palm.rotation, base)),
                  ...points.slice(knuckle, knuckle + POINTS_OF_DIGIT)];
  const bones = directions(places, rotate(palm.rotation, [0, 0, -1]));
  const right = rotate(palm.rotation, [1, 0, 0]);
  const hinge = hingeOf(bones.slice(1), rolled(right, bones[1], FINGER_ROLLS[finger]));
  places.forEach((place, i) => {
    const bone = bones[Math.min(i, bones.length - 1)];
    const across = i === 0 ? rolled(right, bone, BASE_ROLLS[finger]) : hinge;
    put(hand, 6 + DIGITS * finger + i, facing(bone, across) ?? palm.rotation, place);
  });
}

function placeThumb(hand: Hand, palm: Palm, places: Vector[]): void {
  const bones = directions(places, rotate(palm.rotation, THUMB_BONE));
  // It swings far from its rest pose, and takes its hinge along on the shortest way.
  const swing = shortestTurn(THUMB_BONE, rotate(inverse(palm.rotation), bones[0]));
  const hinge = hingeOf(bones, rotate(palm.rotation, rotate(swing, THUMB_HINGE)));
  places.forEach((place, i) => {
    put(hand, 2 + i, facing(bones[Math.min(i, bones.length - 1)], hinge) ?? palm.rotation, place);
  });
}

/** Where each bone points; one without a length like the one before. */
function directions(places: Vector[], first: Vector): Vector[] {
  const bones: Vector[] = [];
  for (let i = 0; i + 1 < places.length; ++i) {
    bones.push(unitOr(minus(places[i + 1], places[i]), bones[i - 1] ?? first));
  }
  return bones;
}

/** The axis (+X) about which three bones bend; where they are straight the rest pose's. */
function hingeOf(bones: Vector[], rest: Vector): Vector {
  const across = unitOr(along(rest, bones[0]), rest);
  const bend = plus(cross(bones[1], bones[0]), cross(bones[2], bones[1]));
  const amount = length(bend);
  if (!(amount > STRAIGHT)) return across;
  const agreement = dot(bend, across) / amount;
  const weight = smoothStep(STRAIGHT, BENT, amount) *
                 smoothStep(PLANE_ASTRAY, PLANE_AGREES, Math.abs(agreement));
  // A finger bent backwards turns about the same hinge the other way.
  const measured = times((agreement < 0 ? -1 : 1) / amount, bend);
  return unitOr(plus(times(1 - weight, across), times(weight, measured)), across);
}

function smoothStep(from: number, to: number, x: number): number {
  const t = Math.min(1, Math.max(0, (x - from) / (to - from)));
  return t * t * (3 - 2 * t);
}

function rolled(right: Vector, bone: Vector, degrees: number): Vector {
  const across = unitOr(along(right, bone), right);
  return rotate(turn(degrees * DEGREE, bone), across);
}

/** The rotation whose -Z is `ahead` and whose +X is nearest to `right`. */
function facing(ahead: Vector, right: Vector): Quaternion | null {
  if (!(length(ahead) > SHORTEST_M)) return null;
  const z = times(-1, unit(ahead));
  const across = along(right, z);
  if (!(length(across) > SHORTEST_M)) return null;
  const x = unit(across);
  return fromAxes(x, cross(z, x), z);
}

function shortestTurn(from: Vector, to: Vector): Quaternion {
  const axis = cross(from, to);
  const sine = length(axis);
  return sine > SHORTEST_M ? turn(Math.atan2(sine, dot(from, to)), unit(axis)) : [0, 0, 0, 1];
}

const unitOr = (a: Vector, otherwise: Vector): Vector =>
  (length(a) > SHORTEST_M ? unit(a) : otherwise);
const REST_FAN = inverse(fanOf(REST_KNUCKLES) as Quaternion);
const REST_BREADTH_M = length(minus(REST_KNUCKLES[0], REST_KNUCKLES[3]));
const flipped = ([x, y, z]: Vector): Vector => [-x, y, z];
