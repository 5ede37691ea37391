import assert from 'node:assert/strict';
import test from 'node:test';

import {JOINT_FLOATS, load} from '../dist/index.js';
import {reference} from './reference.js';
import {correct, objects, stroke} from './strokes.js';

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
    t.diagnostic(`${object.name}, ${method}: ${(1e6 * difference).toFixed(3)} µm off, ` +
                 `corrected by up to ${(1e3 * moved).toFixed(1)} mm`);
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
