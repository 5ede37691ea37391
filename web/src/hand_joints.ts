/** The joints of a hand: read, put, moved and mirrored. */
import {JOINT_COUNT, JOINT_FLOATS} from './layout.js';
import type {Hand} from './types.js';
import {multiply, plus, rotate} from './vectors.js';
import type {Quaternion, Vector} from './vectors.js';

/** The hand of the other side. */
export function mirrored(hand: Hand): Hand {
  return hand.map((x, i) => ([1, 2, 4].includes(i % JOINT_FLOATS) ? -x : x));
}

/** Turned about the origin, then shifted. */
export function moved(hand: Hand, rotation: Quaternion, by: Vector): Hand {
  const result = hand.slice();
  for (let j = 0; j < JOINT_COUNT; ++j) {
    put(result, j, multiply(rotation, rotationOf(hand, j)),
        plus(by, rotate(rotation, positionOf(hand, j))));
  }
  return result;
}

export function rotationOf(hand: Hand, joint: number): Quaternion {
  const at = JOINT_FLOATS * joint;
  return [hand[at], hand[at + 1], hand[at + 2], hand[at + 3]];
}
export function positionOf(hand: Hand, joint: number): Vector {
  const at = JOINT_FLOATS * joint + 4;
  return [hand[at], hand[at + 1], hand[at + 2]];
}
export function put(hand: Hand, joint: number, rotation: Quaternion, position: Vector): void {
  hand.set(rotation, JOINT_FLOATS * joint);
  hand.set(position, JOINT_FLOATS * joint + 4);
}
