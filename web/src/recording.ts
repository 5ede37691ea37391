/** Recordings of hands in nade's own format: JSON Lines, plain or gzip (docs/formats.md). */
import {badArgument, NadeError} from './error.js';
import {HAND_FLOATS, JOINT_COUNT, JOINT_FLOATS} from './layout.js';
import type {Hand, Side} from './types.js';

export interface RecordedHand {
  joints: Hand;
  /** The tracker's own, 0 to 1. */
  confidence: number;
}

export interface Frame {
  /** On the source's own clock, nanoseconds. */
  timeNs: bigint;
  left?: RecordedHand;
  right?: RecordedHand;
  /** The viewer: position, rotation x y z w. */
  head?: number[];
}

export interface Recording {
  /** The keys of the first line, `format` and `version` among them. */
  header: Record<string, unknown>;
  /** Times increase strictly. */
  frames: Frame[];
}

const SIDES: readonly Side[] = ['left', 'right'];

function damaged(line: number, sentence: string): NadeError {
  return new NadeError(-5, `line ${line}: ${sentence}`);
}

/** Reads a recording from text or from bytes, which may be gzip. */
export async function readRecording(from: string | ArrayBuffer | Uint8Array<ArrayBuffer>):
    Promise<Recording> {
  if (typeof from === 'string') return parse(from);
  const bytes = from instanceof Uint8Array ? from : new Uint8Array(from);
  const packed = bytes[0] === 0x1f && bytes[1] === 0x8b;
  return parse(packed ? await unpacked(bytes) : new TextDecoder().decode(bytes));
}

/** Writes a recording. */
export function writeRecording(recording: Recording): string {
  const header = {format: 'nade-recording', version: 1, ...recording.header};
  const lines = [JSON.stringify(header)];
  let before: bigint | undefined;
  for (const frame of recording.frames) {
    if (before !== undefined && frame.timeNs <= before) {
      throw badArgument(`timeNs: expected more than ${before}, found ${frame.timeNs}`);
    }
    before = frame.timeNs;
    let line = `{"t":${frame.timeNs}`;
    for (const side of SIDES) {
      const hand = frame[side];
      if (hand) line += `,"${side}":${handText(hand)}`;
    }
    if (frame.head) line += `,"head":${JSON.stringify(frame.head)}`;
    lines.push(`${line}}`);
  }
  return `${lines.join('\n')}\n`;
}

/** The same as gzip, for a file whose name ends in `.gz`. */
export async function writePackedRecording(recording: Recording): Promise<ArrayBuffer> {
  const text = new Blob([writeRecording(recording)]);
  return new Response(text.stream().pipeThrough(new CompressionStream('gzip'))).arrayBuffer();
}

async function unpacked(bytes: Uint8Array<ArrayBuffer>): Promise<string> {
  try {
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
    return await new Response(stream).text();
  } catch {
    throw new NadeError(-5, 'the gzip data are damaged, or cut off');
  }
}

function parse(text: string): Recording {
  const lines = text.replace(/^\uFEFF/, '').split('\n');
  const whole = text.endsWith('\n');
  let header: Record<string, unknown> | undefined;
  const frames: Frame[] = [];
  lines.forEach((line, index) => {
    if (line.trim() === '') return;
    let value: Record<string, unknown>;
    try {
      value = JSON.parse(line) as Record<string, unknown>;
    } catch {
      // A last line that was cut off is left out: what went before is whole.
      if (header && !whole && index === lines.length - 1) return;
      throw damaged(index + 1, 'is no JSON');
    }
    if (header) {
      frames.push(frameFrom(value, line, index + 1, frames[frames.length - 1]?.timeNs));
      return;
    }
    if (value.format !== 'nade-recording' || value.version !== 1) {
      throw damaged(index + 1, 'expected "format":"nade-recording" and "version":1');
    }
    header = value;
  });
  if (!header) throw new NadeError(-5, 'expected a recording, found nothing');
  return {header, frames};
}

function frameFrom(value: Record<string, unknown>, line: string, number: number,
                   before: bigint | undefined): Frame {
  // A number beyond 2^53 would not come through JSON.parse whole; writers put the time first.
  const digits = /^\s*\{\s*"t"\s*:\s*(-?\d+)\s*[,}]/.exec(line)?.[1];
  if (typeof value.t !== 'number') throw damaged(number, 't: expected a number');
  const timeNs = BigInt(digits ?? Math.round(value.t));
  if (before !== undefined && timeNs <= before) {
    throw damaged(number, `t: expected more than ${before}, found ${timeNs}`);
  }
  const frame: Frame = {timeNs};
  for (const side of SIDES) {
    const hand = value[side] === undefined ? null : handFrom(value[side], `${side}.joints`, number);
    if (hand) frame[side] = hand;
  }
  if (Array.isArray(value.head)) frame.head = value.head as number[];
  return frame;
}

/** Null for a hand with a number that is none, as trackers write them that lost it. */
function handFrom(value: unknown, name: string, number: number): RecordedHand | null {
  const {joints: list, confidence = 1} = value as {joints?: unknown; confidence?: number};
  if (!Array.isArray(list) || list.length !== JOINT_COUNT) {
    throw damaged(number, `${name}: expected ${JOINT_COUNT} joints`);
  }
  const joints = new Float32Array(HAND_FLOATS);
  for (let j = 0; j < JOINT_COUNT; ++j) {
    const joint = list[j] as unknown;
    if (!Array.isArray(joint) || joint.length !== JOINT_FLOATS) {
      throw damaged(number, `${name}[${j}]: expected ${JOINT_FLOATS} numbers`);
    }
    if (!joint.every((x) => typeof x === 'number' && Number.isFinite(x))) return null;
    const [px, py, pz, qx, qy, qz, qw, radius] = joint as number[];
    joints.set([qx, qy, qz, qw, px, py, pz, radius], JOINT_FLOATS * j);
  }
  return {joints, confidence};
}

function handText({joints, confidence}: RecordedHand): string {
  if (joints.length !== HAND_FLOATS || !joints.every(Number.isFinite)) {
    throw badArgument(`joints: expected ${HAND_FLOATS} finite numbers`);
  }
  const list = Array.from({length: JOINT_COUNT}, (_, j) => {
    const [qx, qy, qz, qw, px, py, pz, radius] =
        joints.subarray(JOINT_FLOATS * j, JOINT_FLOATS * (j + 1));
    // JSON.stringify would lose the sign of -0.
    const numbers = [px, py, pz, qx, qy, qz, qw, radius];
    return `[${numbers.map((x) => (Object.is(x, -0) ? '-0' : String(x))).join()}]`;
  });
  return `{"joints":[${list.join()}],"confidence":${confidence}}`;
}
