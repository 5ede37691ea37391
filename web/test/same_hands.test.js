import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {fileURLToPath} from 'node:url';
import test from 'node:test';

import {HAND_FLOATS, JOINT_FLOATS, load} from '../dist/index.js';
import {correct, objects, stroke} from './strokes.js';

const METHODS = ['none', 'paper', 'nade'];
const REFERENCE = fileURLToPath(
    new URL('../../build/release/web/web_reference', import.meta.url));

function bytesOf(cases) {
  const parts = [];
  for (const {method, object, frames} of cases) {
    const {vertices = new Float32Array(), triangles = new Uint32Array()} = object.mesh ?? {};
    parts.push(new Uint32Array([METHODS.indexOf(method), object.kind, vertices.length / 3,
                                triangles.length / 3, frames.length]), vertices, triangles);
    for (const {side, timeNs, joints} of frames) {
      parts.push(new BigInt64Array([timeNs]), new Int32Array([side === 'right' ? 1 : 0, 0]), joints);
    }
  }
  return Buffer.concat(parts.map((p) => Buffer.from(p.buffer, p.byteOffset, p.byteLength)));
}

/** What the C library of this machine makes of the cases. */
function reference(cases) {
  const folder = mkdtempSync(join(tmpdir(), 'nade-web-'));
  try {
    writeFileSync(join(folder, 'in'), bytesOf(cases));
    execFileSync(REFERENCE, [join(folder, 'in'), join(folder, 'out')]);
    const {buffer} = new Uint8Array(readFileSync(join(folder, 'out')));
    let at = 0;
    return cases.map(({frames}) => {
      const bytes = 4 * HAND_FLOATS * frames.length;
      const hands = new Float32Array(buffer.slice(at, at + bytes));
      const [medianNs] = new Float64Array(buffer.slice(at + bytes, at + bytes + 8));
      at += bytes + 8;
      return {hands, medianNs};
    });
  } finally {
    rmSync(folder, {recursive: true});
  }
}

/** The largest distance between the same joints, metres. */
function largestDifference(a, b) {
  let largest = 0;
  for (let j = 0; j < a.length; j += JOINT_FLOATS) {
    const away = Math.hypot(a[j + 4] - b[j + 4], a[j + 5] - b[j + 5], a[j + 6] - b[j + 6]);
    assert.ok(Number.isFinite(away));
    largest = Math.max(largest, away);
  }
  return largest;
}

test('the same hands as by the C library, within 1 µm', async (t) => {
  const nade = await load();
  const cases = objects(nade).flatMap((object) => ['paper', 'nade'].map((method) => (
    {object, method, frames: stroke(nade, object.top, 6, 7)})));
  const native = reference(cases);
  cases.forEach(({object, method, frames}, i) => {
    const here = correct(nade, object.surface, frames, method);
    const difference = largestDifference(here.hands, native[i].hands);
    const moved = largestDifference(here.hands, correct(nade, object.surface, frames, 'none').hands);
    const [web, c] = [here.medianNs / 1e3, native[i].medianNs / 1e3];
    t.diagnostic(`${object.name}, ${method}: ${(1e6 * difference).toFixed(3)} µm off, ` +
                 `corrected by up to ${(1e3 * moved).toFixed(1)} mm; ${web.toFixed(1)} µs a hand, ` +
                 `${c.toFixed(1)} by the C library: ${(web / c).toFixed(2)} times`);
    assert.ok(difference < 1e-6, `${object.name}, ${method}: ${difference} m off`);
    assert.ok(moved > 5e-3, `${object.name}, ${method}: nothing was touched`);
  });
});

test('two runs are equal to the byte', async () => {
  const [one, other] = [await load(), await load()];
  const [first, second] = [objects(one), objects(other)];
  first.forEach((object, i) => {
    const frames = stroke(one, object.top, 3, 11);
    const a = correct(one, object.surface, frames).hands;
    const b = correct(other, second[i].surface, frames).hands;
    assert.deepEqual(Buffer.from(a.buffer), Buffer.from(b.buffer), object.name);
  });
});
