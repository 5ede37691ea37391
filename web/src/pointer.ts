/**
 * A hand without a tracker: the palm follows the point of a surface under a pointer. It is a
 * tracked hand like any other, sunk in by the depth that is pressed: give it to a corrector.
 */
// Based on: Casiez, Roussel and Vogel. 1 Euro Filter: A Simple Speed-based Low-pass Filter for
// Noisy Input in Interactive Systems. 2012. The same hand as that of `nade view`.
import {HAND_FLOATS} from './layout.js';
import {badArgument} from './error.js';
import {moved, positionOf, put, rotationOf} from './hand_joints.js';
import type {Hand, Side, SurfacePoint} from './types.js';
import {across, along, cross, dot, fromAxes, inverse, length, minus, multiply, plus, rotate, times,
        turn, unit} from './vectors.js';
import type {Quaternion, Vector} from './vectors.js';

const DEGREE = Math.PI / 180;
const SLOWEST_HZ = 5;       // cut-off of a hand at rest: steadies single pixels
const HZ_PER_SPEED = 60;    // and how it rises, so that a stroke hardly lags
const SPEED_CUTOFF_HZ = 4;  // of the speed that decides
const FASTEST_SPEED = 2.5;  // m/s: over a silhouette the goal leaps, a hand does not
const NORMAL_S = 0.05;      // time in which the hand turns with the surface
const HEADING_S = 0.12;
const INWARD = 30 * DEGREE;  // one's hand comes from one's side, not from one's middle
const HOLD_S = 0.045;        // time in which the settings take effect
const NEAR_M = 0.5;          // how far the surface is looked for
const LET_GO_M = 0.03;       // so far off the surface the hand presses no more
const PALM_M = 0.03;         // half a palm's breadth
const CURL = [0, 27 * DEGREE, 18 * DEGREE];  // of a finger's three hinges, at a curl of 1
const SPREAD = [10 * DEGREE, 10 * DEGREE, 0, -10 * DEGREE, -20 * DEGREE];
const FIRST_HINGES = [2, 7, 12, 17, 22];
const WRIST = 1;
const MIDDLE_KNUCKLE = 12;
// The generic hand of WebXR: from the palm joint to the skin, and from the wrist to that knuckle.
const PALM_SKIN_M = 0.02124;
const GENERIC_LENGTH_M = 0.0916981;

export {mirrored} from './hand_joints.js';

export interface PointerSettings {
  /** Of the palm's skin below the surface, metres; below 0 above it. */
  depth: number;
  /** Radians: about the back of the hand, counter-clockwise as seen from above. */
  turn: number;
  /** Above 0 raises the fingertips. */
  tilt: number;
  /** Above 0 raises the hand's right edge. */
  roll: number;
  /** 0 as relaxed, 1 bent by 45 degrees more. */
  curl: number;
  /** 0 as relaxed, 1 apart by about 10 degrees each. */
  spread: number;
}

export interface Ray {
  origin: Vector;
  /** Unit. */
  direction: Vector;
}

/** What a pointer asks of the hand in one frame, world coordinates. */
export interface Aim {
  /** Through the pointer; without it the hand stays. */
  ray?: Ray;
  /** Unit: where the viewer looks, and what is up there. */
  ahead: Vector;
  up: Vector;
}

/** What the pointer moves over: a Surface, or something placed. */
export interface Touchable {
  closestPoint(query: Vector, maxDistance: number): SurfacePoint | null;
  /** Found with `closestPoint` where it is left out. */
  firstHit?(ray: Ray): Vector | null;
}

export class PointerHand {
  readonly settings: PointerSettings = {depth: 0.02, turn: 0, tilt: 0, roll: 0, curl: 0, spread: 0};
  private readonly relaxed: Hand;
  private readonly palmSkin: number;
  private held: PointerSettings = {...this.settings};
  private goal: Vector = [0, 0, 0];
  private goalOff = 0;
  private point: Vector = [0, 0, 0];
  private velocity: Vector = [0, 0, 0];
  private off = 0;
  private surfacePoint: Vector = [0, 0, 0];
  private normal: Vector = [0, 1, 0];
  private ahead: Vector = [0, 0, -1];
  private settled = false;

  /** `relaxed` is a hand of that side at rest, anywhere, such as `nade.restHand(side)`. */
  constructor(relaxed: Hand, readonly side: Side) {
    if (relaxed.length !== HAND_FLOATS) {
      throw badArgument(`relaxed: expected ${HAND_FLOATS} numbers, found ${relaxed.length}`);
    }
    const home = inverse(rotationOf(relaxed, 0));
    this.relaxed = moved(relaxed, home, times(-1, rotate(home, positionOf(relaxed, 0))));
    const size = length(minus(positionOf(relaxed, MIDDLE_KNUCKLE), positionOf(relaxed, WRIST)));
    this.palmSkin = PALM_SKIN_M * size / GENERIC_LENGTH_M;
  }

  /** Puts the hand onto a point of a surface, at rest. */
  place(target: Touchable, point: Vector, ahead: Vector): void {
    const nearest = target.closestPoint(point, NEAR_M);
    this.goal = this.point = this.surfacePoint = nearest ? nearest.point : point;
    this.goalOff = this.off = 0;
    this.velocity = [0, 0, 0];
    this.normal = broadNormal(target, this.point, nearest ? nearest.normal : [0, 1, 0]);
    const flat = along(ahead, this.normal);
    this.ahead = length(flat) > 1e-3 ? unit(flat) : across(this.normal);
    this.held = {...this.settings};
    this.settled = false;
  }

  /** The hand after `seconds` (> 0) of following. */
  update(target: Touchable, aim: Aim, seconds: number): Hand {
    if (aim.ray) this.findGoal(target, aim.ray, aim.ahead);
    this.follow(seconds);
    this.lieOn(target, seconds);
    this.takeHeading(aim, seconds);
    const share = shareOf(seconds, HOLD_S);
    for (const key of Object.keys(this.held) as (keyof PointerSettings)[]) {
      this.held[key] += share * (this.settings[key] - this.held[key]);
    }
    const {depth, turn: turned, tilt, roll} = this.held;
    let rotation = fromAxes(cross(this.ahead, this.normal), this.normal, times(-1, this.ahead));
    rotation = multiply(rotation, turn(turned, [0, 1, 0]));
    rotation = multiply(rotation, turn(tilt, [1, 0, 0]));
    rotation = multiply(rotation, turn(roll, [0, 0, 1]));
    const pressing = Math.min(1, Math.max(0, 1 - this.off / LET_GO_M));
    const sunk = depth > 0 ? pressing * depth : depth;
    const skin = plus(this.surfacePoint, times(this.off - sunk, this.normal));
    return moved(this.posed(), rotation, plus(skin, times(this.palmSkin, rotate(rotation, [0, 1, 0]))));
  }

  private findGoal(target: Touchable, ray: Ray, ahead: Vector): void {
    const hit = target.firstHit ? target.firstHit(ray) : firstHit(target, ray);
    if (hit) {
      this.goal = hit;
      this.goalOff = 0;
      return;
    }
    // Beside the object: as far away as it was when it was last over it.
    const leads = dot(ray.direction, ahead);
    if (leads < 1e-3) return;
    const away = dot(minus(this.goal, ray.origin), ahead) / leads;
    const point = plus(ray.origin, times(away, ray.direction));
    const nearest = target.closestPoint(point, NEAR_M);
    if (!nearest) return;
    this.goal = point;
    this.goalOff = Math.max(0, nearest.signedDistance);
  }

  private follow(seconds: number): void {
    const way = minus(this.goal, this.point);
    const wanted = times(1 / seconds, way);
    const share = shareOf(seconds, timeConstant(SPEED_CUTOFF_HZ));
    this.velocity = plus(this.velocity, times(share, minus(wanted, this.velocity)));
    const cutoff = SLOWEST_HZ + HZ_PER_SPEED * length(this.velocity);
    const followed = shareOf(seconds, timeConstant(cutoff));
    const step = times(followed, way);
    const longest = FASTEST_SPEED * seconds;
    const far = length(step);
    this.point = plus(this.point, far > longest ? times(longest / far, step) : step);
    this.off += followed * (this.goalOff - this.off);
  }

  private lieOn(target: Touchable, seconds: number): void {
    const nearest = target.closestPoint(this.point, NEAR_M);
    if (!nearest) return;
    this.surfacePoint = nearest.point;
    const lies = broadNormal(target, nearest.point, nearest.normal);
    const turned = plus(this.normal,
                        times(shareOf(seconds, NORMAL_S), minus(lies, this.normal)));
    this.normal = length(turned) > 0.1 ? unit(turned) : lies;
  }

  private takeHeading(aim: Aim, seconds: number): void {
    const inward = turn(this.side === 'right' ? INWARD : -INWARD, this.normal);
    const goal = rotate(inward, along(plus(aim.ahead, aim.up), this.normal));
    const kept = along(this.ahead, this.normal);
    this.ahead = length(kept) > 1e-3 ? unit(kept) : across(this.normal);
    if (length(goal) < 0.1) return;
    const away = Math.atan2(dot(cross(this.ahead, goal), this.normal), dot(this.ahead, goal));
    const share = this.settled ? shareOf(seconds, HEADING_S) : 1;
    this.settled = true;
    this.ahead = unit(along(rotate(turn(share * away, this.normal), this.ahead), this.normal));
  }

  /** The relaxed hand, curled and spread. */
  private posed(): Hand {
    const hand = this.relaxed.slice();
    const mirror = this.side === 'right' ? 1 : -1;
    FIRST_HINGES.forEach((first, digit) => {
      const spread = turn(mirror * this.held.spread * SPREAD[digit], [0, 1, 0]);
      bend(hand, first, first + 3, spread);
      if (digit === 0) return;
      CURL.forEach((angle, hinge) => bend(hand, first + hinge, first + 3,
                                          turn(-this.held.curl * angle, [1, 0, 0])));
    });
    return hand;
  }
}

/** Turns a joint by a rotation in its own frame, and what hangs on it. */
function bend(hand: Hand, joint: number, tip: number, by: Quaternion): void {
  const own = rotationOf(hand, joint);
  const world = multiply(multiply(own, by), inverse(own));
  const center = positionOf(hand, joint);
  for (let j = joint; j <= tip; ++j) {
    const position = plus(center, rotate(world, minus(positionOf(hand, j), center)));
    put(hand, j, multiply(world, rotationOf(hand, j)), position);
  }
}

const timeConstant = (cutoffHz: number) => 1 / (2 * Math.PI * cutoffHz);
/** The share of the way that a first-order filter goes in a step. */
const shareOf = (seconds: number, constant: number) => 1 - Math.exp(-seconds / constant);

/** Goes along the ray as far as no surface can be nearer, again and again. */
function firstHit(target: Touchable, {origin, direction}: Ray): Vector | null {
  const FARTHEST_M = 10;
  const HIT_M = 2e-4;
  let away = 0;
  for (let step = 0; step < 128 && away < FARTHEST_M; ++step) {
    const point = plus(origin, times(away, direction));
    const nearest = target.closestPoint(point, FARTHEST_M);
    if (!nearest) return null;
    if (nearest.signedDistance < HIT_M) return nearest.point;
    away += nearest.signedDistance;
  }
  return null;
}

/** Averaged over a palm's breadth: how a flat hand lies there. */
function broadNormal(target: Touchable, point: Vector, normal: Vector): Vector {
  const SPOKES = 8;
  const aside = across(normal);
  const forward = cross(normal, aside);
  let sum = normal;
  for (let i = 0; i < 2 * SPOKES; ++i) {
    const angle = Math.PI * i / SPOKES;
    const radius = (i % 2 + 1) * 0.5 * PALM_M;
    const spoke = plus(times(radius * Math.cos(angle), aside),
                       times(radius * Math.sin(angle), forward));
    const near = target.closestPoint(plus(point, spoke), 0.1);
    // A thin part's far side is no part of what the palm lies on.
    if (near && dot(near.normal, normal) > 0) sum = plus(sum, near.normal);
  }
  return unit(sum);
}
