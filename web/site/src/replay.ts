// A recording, played as slowly as one likes.
import {HAND_FLOATS, JOINT_COUNT, JOINT_FLOATS} from '../../src/index.js';
import type {Hand} from '../../src/index.js';
import type {Recording} from '../../src/recording.js';
import {SIDES} from './hands.js';
import type {TrackedHands} from './hands.js';
import type {Thing} from './objects.js';

const LONGEST_GAP_S = 0.1;
/** Of the palm joint above the surface: its skin is 10 mm deep then. */
const LYING_M = 0.011;
const FAR_M = 2;

export class Replay {
  playing = true;
  speed = 0.25;
  /** Seconds from the recording's first frame. */
  time = 0;
  readonly seconds: number;
  private readonly times: number[];
  private shift: [number, number, number] = [0, 0, 0];

  constructor(private readonly recording: Recording) {
    const {frames} = recording;
    if (!frames.some((frame) => frame.left || frame.right)) {
      throw new Error('expected a hand, found none');
    }
    this.times = frames.map(({timeNs}) => Number(timeNs - frames[0].timeNs) / 1e9);
    this.seconds = this.times[this.times.length - 1];
  }

  /** Puts the hands onto an object, as they lie at the median; not where it was recorded on it. */
  placeOn(thing: Thing, name: string): void {
    this.shift = [0, 0, 0];
    if (this.recording.header.object === name) return;
    const palms = this.recording.frames.flatMap((frame) => SIDES.flatMap((side) => (
      frame[side] ? [[...frame[side].joints.subarray(4, 7)]] : [])));
    const median = (values: number[]) => values.sort((a, b) => a - b)[values.length >> 1];
    const goal = thing.stroke(0);
    this.shift = [goal.x - median(palms.map(([x]) => x)), goal.y - median(palms.map(([, y]) => y)),
                  goal.z - median(palms.map(([, , z]) => z))];
    for (let round = 0; round < 5; ++round) {
      const above = median(palms.map((palm) => thing.closestPoint(
        [palm[0] + this.shift[0], palm[1] + this.shift[1], palm[2] + this.shift[2]],
        FAR_M)?.signedDistance ?? FAR_M));
      this.shift[1] += LYING_M - above;
    }
  }

  toggle(): void { this.playing = !this.playing; }

  /** Goes on; true where it began again from the start. */
  advance(seconds: number): boolean {
    if (!this.playing) return false;
    this.time += this.speed * seconds;
    if (this.time <= this.seconds) return false;
    this.time = 0;
    return true;
  }

  hands(): TrackedHands {
    const {frames} = this.recording;
    const after = this.times.findIndex((time) => time > this.time);
    const last = after < 0 ? frames.length - 1 : Math.max(0, after - 1);
    const next = Math.min(frames.length - 1, last + 1);
    const gap = this.times[next] - this.times[last];
    const share = gap > 0 ? (this.time - this.times[last]) / gap : 0;
    const hands: TrackedHands = {};
    for (const side of SIDES) {
      const [from, to] = [frames[last][side]?.joints, frames[next][side]?.joints];
      if (!from) continue;
      const hand = to && gap < LONGEST_GAP_S ? between(from, to, share) : from.slice();
      for (let joint = 0; joint < JOINT_COUNT; ++joint) {
        for (let i = 0; i < 3; ++i) hand[JOINT_FLOATS * joint + 4 + i] += this.shift[i];
      }
      hands[side] = hand;
    }
    return hands;
  }
}

/** The hand on its way from one frame to the next. */
function between(from: Hand, to: Hand, share: number): Hand {
  const hand = new Float32Array(HAND_FLOATS);
  for (let at = 0; at < HAND_FLOATS; at += JOINT_FLOATS) {
    let dot = 0;
    for (let i = 0; i < 4; ++i) dot += from[at + i] * to[at + i];
    // A rotation and its negative are the same.
    const sign = dot < 0 ? -1 : 1;
    let norm = 0;
    for (let i = 0; i < JOINT_FLOATS; ++i) {
      const goal = i < 4 ? sign * to[at + i] : to[at + i];
      hand[at + i] = from[at + i] + share * (goal - from[at + i]);
      if (i < 4) norm += hand[at + i] ** 2;
    }
    for (let i = 0; i < 4; ++i) hand[at + i] /= Math.sqrt(norm);
  }
  return hand;
}
