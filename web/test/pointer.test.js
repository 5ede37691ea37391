import assert from 'node:assert/strict';
import test from 'node:test';

import {load} from '../dist/index.js';
import {PointerHand} from '../dist/pointer.js';

const nade = await load();
const DOWN = {ahead: [0, -Math.SQRT1_2, -Math.SQRT1_2], up: [0, Math.SQRT1_2, -Math.SQRT1_2]};
const above = (x, z) => ({...DOWN, ray: {origin: [x, 1, z + 1], direction: DOWN.ahead}});

/** The hand after a second of pointing at x, z. */
function pointed(hand, target, x, z) {
  let joints;
  for (let i = 0; i < 60; ++i) joints = hand.update(target, above(x, z), 1 / 60);
  return joints;
}

test('the palm is under the pointer, as deep as is pressed', () => {
  for (const side of ['left', 'right']) {
    const table = nade.plane();
    const hand = new PointerHand(nade.restHand(side), side);
    hand.settings.depth = 0.01;
    hand.place(table, [0, 0, 0], [0, 0, -1]);
    const joints = pointed(hand, table, 0.1, -0.05);
    assert.ok(Math.hypot(joints[4] - 0.1, joints[6] + 0.05) < 1e-3);
    const skin = 0.02124 / 0.0916981 *
        Math.hypot(...[0, 1, 2].map((i) => joints[8 * 12 + 4 + i] - joints[8 + 4 + i]));
    assert.ok(Math.abs(joints[5] - (skin - 0.01)) < 1e-4);
    assert.ok(joints.every(Number.isFinite));
  }
});

test('a corrected hand of it lies on a ball, no joint in it', () => {
  const ball = nade.sphere(0.15);
  const hand = new PointerHand(nade.restHand('right'), 'right');
  const corrector = nade.corrector();
  hand.place(ball, [0, 0.15, 0], [0, 0, -1]);
  let result;
  for (let i = 0; i < 90; ++i) {
    result = corrector.update('right', hand.update(ball, above(0.02 * Math.sin(i / 20), 0), 1 / 60),
                              ball, i * 1000 / 60);
  }
  assert.equal(result.status, 'corrected');
  for (let j = 0; j < 26; ++j) {
    assert.ok(Math.hypot(...result.joints.subarray(8 * j + 4, 8 * j + 7)) > 0.15, `joint ${j}`);
  }
  assert.ok(result.contacts.some(({joint}) => joint === 'palm'));
  assert.ok(result.contacts.length >= 3);
});

test('curl and spread bend the fingers, and keep their bones', () => {
  const table = nade.plane();
  const hand = new PointerHand(nade.restHand('right'), 'right');
  hand.place(table, [0, 0, 0], [0, 0, -1]);
  const flat = pointed(hand, table, 0, 0);
  Object.assign(hand.settings, {curl: 1, spread: 1, tilt: 0.2, turn: -0.3});
  const bent = pointed(hand, table, 0, 0);
  const between = (joints, a, b) => Math.hypot(
    ...[4, 5, 6].map((i) => joints[8 * a + i] - joints[8 * b + i]));
  for (let j = 7; j < 10; ++j) {
    assert.ok(Math.abs(between(flat, j, j + 1) - between(bent, j, j + 1)) < 1e-5);
  }
  assert.ok(between(bent, 10, 1) < between(flat, 10, 1) - 0.001);
  assert.ok(between(bent, 10, 25) > between(flat, 10, 25));
});
