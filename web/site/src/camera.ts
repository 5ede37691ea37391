// Hands in front of a camera, seen by MediaPipe, which is loaded only for this.
import {HAND_FLOATS, JOINT_FLOATS} from '../../src/index.js';
import type {Hand, Side} from '../../src/index.js';
import {handFromLandmarks, LandmarkFilter, readMediapipe} from '../../src/mediapipe.js';
import type {MediapipeResult} from '../../src/mediapipe.js';
import {moved, positionOf, rotationOf} from '../../src/hand_joints.js';
import {inverse, minus, multiply, plus, rotate} from '../../src/vectors.js';
import {SIDES} from './hands.js';

const FOLDER = 'mediapipe/';
const PICTURE = {width: 640, height: 480};
/** So long a hand that is not seen is still where it was. */
const KEPT_MS = 300;
const SURE = 0.8;
/** A camera sees a hand's middle only within so much of its picture, which is the whole window. */
const MARGIN = 0.18;
const FOLLOW_MS = 60;
/** Wrist to middle knuckle, heights of the picture: seen along its length a hand has no heading. */
const SHORTEST_SEEN = 0.05;

interface Solution {
  setOptions(options: object): void;
  onResults(listener: (result: MediapipeResult) => void): void;
  send(inputs: {image: HTMLVideoElement}): Promise<void>;
  close(): Promise<void>;
}
declare global {
  interface Window { Hands?: new (config: {locateFile(name: string): string}) => Solution }
}

/** A hand as the camera sees it: the fingers well, the place across the picture, no depth. */
export interface SeenHand {
  /** The palm's place in a mirror, 0 to 1, from the left and from above. */
  place: {x: number; y: number};
  /** Of the hand in the mirror, radians counter-clockwise from upright. */
  turn: number;
  /** Its palm is anywhere. */
  hand: Hand;
  isSure: boolean;
}

export class Camera {
  readonly seen: Partial<Record<Side, SeenHand>> = {};
  /** Milliseconds that MediaPipe took for the last picture. */
  spentMs = 0;
  private readonly filters = {left: new LandmarkFilter(), right: new LandmarkFilter()};
  private readonly seenAt = {left: -Infinity, right: -Infinity};
  private before = 0;
  private closed = false;

  private constructor(private readonly video: HTMLVideoElement, private readonly stream: MediaStream,
                      private readonly solution: Solution) {
    solution.setOptions({maxNumHands: 2, modelComplexity: 0, minDetectionConfidence: 0.5,
                         minTrackingConfidence: 0.5});
    solution.onResults((result) => this.take(result, performance.now()));
  }

  /** Asks the browser for the camera, and shows its picture in `video`; `failed` is for later. */
  static async open(video: HTMLVideoElement, failed: (error: Error) => void): Promise<Camera> {
    if (!navigator.mediaDevices) throw new Error('this browser gives no camera to this page');
    const stream = await navigator.mediaDevices.getUserMedia({video: PICTURE, audio: false}).catch(
      (error: Error) => { throw new Error(`no camera: ${error.message}`); });
    try {
      video.srcObject = stream;
      await video.play();
      await loadScript(`${FOLDER}hands.js`);
      const solution = new window.Hands!({locateFile: (name) => FOLDER + name});
      const camera = new Camera(video, stream, solution);
      await solution.send({image: video});
      stream.getVideoTracks()[0].addEventListener('ended', () => failed(new Error('The camera is gone')));
      camera.watch().catch(failed);
      return camera;
    } catch (error) {
      stop(stream);
      throw error;
    }
  }

  close(): void {
    this.closed = true;
    stop(this.stream);
    this.video.srcObject = null;
  }

  /** What it sees, in words. */
  words(): string {
    const found = SIDES.flatMap((side) => {
      const hand = this.seen[side];
      return hand ? [hand.isSure ? `${side} hand` : `${side} hand, unsure`] : [];
    });
    return found.length === 0 ? 'no hand seen' : `${found.join(', ')} seen`;
  }

  /** Picture after picture, as fast as MediaPipe is. */
  private async watch(): Promise<void> {
    while (!this.closed) {
      const start = performance.now();
      await this.solution.send({image: this.video});
      this.spentMs = performance.now() - start;
      await new Promise(requestAnimationFrame);
    }
    await this.solution.close();
  }

  private take(result: MediapipeResult, now: number): void {
    const aspect = this.video.videoWidth / this.video.videoHeight || PICTURE.width / PICTURE.height;
    for (const {side, score, picture, shape} of readMediapipe(result)) {
      const points = this.filters[side].update(shape, now);
      const hand = points && handFromLandmarks(side, points);
      if (!hand) continue;
      const before = this.seen[side];
      const follow = before ? 1 - Math.exp(-(now - this.before) / FOLLOW_MS) : 1;
      const middle = [0, 5, 9, 13, 17].map((i) => picture[i]).reduce(plus);
      const place = {x: inWindow(1 - middle[0] / 5), y: inWindow(middle[1] / 5)};
      // In a mirror left and right are swapped.
      const [across, up] = [aspect * (picture[0][0] - picture[9][0]), picture[0][1] - picture[9][1]];
      const seenTurn = Math.hypot(across, up) < SHORTEST_SEEN ? before?.turn ?? 0 :
        Math.atan2(-across, up);
      const turn = before ? before.turn + follow * around(seenTurn - before.turn) : seenTurn;
      if (before) {
        place.x = before.place.x + follow * (place.x - before.place.x);
        place.y = before.place.y + follow * (place.y - before.place.y);
      }
      this.seen[side] = {place, turn, hand, isSure: score >= SURE};
      this.seenAt[side] = now;
    }
    this.before = now;
    for (const side of SIDES) {
      if (this.seen[side] && now - this.seenAt[side] > KEPT_MS) {
        delete this.seen[side];
        this.filters[side].lost();
      }
    }
  }
}

/** The fingers of one hand on the palm of another. */
export function withPalmOf(hand: Hand, other: Hand): Hand {
  const turned = multiply(rotationOf(other, 0), inverse(rotationOf(hand, 0)));
  const result = moved(hand, turned, minus(positionOf(other, 0), rotate(turned, positionOf(hand, 0))));
  for (let at = 7; at < HAND_FLOATS; at += JOINT_FLOATS) result[at] = other[at];
  return result;
}

const inWindow = (x: number) => Math.min(1, Math.max(0, (x - MARGIN) / (1 - 2 * MARGIN)));
/** An angle within half a turn. */
const around = (angle: number) => Math.atan2(Math.sin(angle), Math.cos(angle));

function stop(stream: MediaStream): void {
  for (const track of stream.getTracks()) track.stop();
}

async function loadScript(address: string): Promise<void> {
  if (document.querySelector(`script[src="${address}"]`)) return;
  const script = document.createElement('script');
  script.src = address;
  await new Promise((resolve, reject) => {
    script.onload = resolve;
    script.onerror = () => {
      script.remove();
      reject(new Error('MediaPipe could not be loaded'));
    };
    document.head.append(script);
  });
}
