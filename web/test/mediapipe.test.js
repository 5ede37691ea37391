import assert from 'node:assert/strict';
import test from 'node:test';

import {load} from '../dist/index.js';
import {handFromLandmarks, LandmarkFilter, readMediapipe} from '../dist/mediapipe.js';
import {PointerHand} from '../dist/pointer.js';

const nade = await load();
/** The joints where MediaPipe has its 21 landmarks. */
const JOINTS = [1, 2, 3, 4, 5, 7, 8, 9, 10, 12, 13, 14, 15, 17, 18, 19, 20, 22, 23, 24, 25];
const position = (hand, joint) => [...hand.slice(8 * joint + 4, 8 * joint + 7)];
const landmarks = (hand) => JOINTS.map((joint) => position(hand, joint));
const distance = (a, b) => Math.hypot(...a.map((x, i) => x - b[i]));

/** Degrees between two rotations of a joint. */
function turned(a, b, joint) {
  const dot = [0, 1, 2, 3].reduce((sum, i) => sum + a[8 * joint + i] * b[8 * joint + i], 0);
  return 2 * Math.acos(Math.min(1, Math.abs(dot))) * 180 / Math.PI;
}

/** A hand that lies on a ball, turned and curled. */
function posed(side, curl) {
  const hand = new PointerHand(nade.restHand(side), side);
  Object.assign(hand.settings, {curl, turn: 0.7, tilt: 0.3, depth: 0});
  const ball = nade.sphere(0.1);
  const touchable = {closestPoint: (query, most) => ball.closestPoint(query, most)};
  hand.place(touchable, [0.02, 0.1, 0.03], [0, 0, -1]);
  return hand.update(touchable, {ahead: [0, 0, -1], up: [0, 1, 0]}, 0.01);
}

test('a hand comes back from its landmarks', () => {
  for (const side of ['left', 'right']) {
    for (const curl of [0, 0.5, 1]) {
      const hand = posed(side, curl);
      const found = handFromLandmarks(side, landmarks(hand));
      for (const joint of JOINTS) {
        assert.ok(distance(position(hand, joint), position(found, joint)) < 1e-6);
        assert.ok(turned(hand, found, joint) < 25, `${side} ${curl}: joint ${joint}`);
      }
      assert.ok(turned(hand, found, 1) < 6);
      assert.ok(distance(position(hand, 0), position(found, 0)) < 0.01);
      assert.equal(nade.corrector().update(side, found, null, 0).status, 'free');
    }
  }
});

test('points in one line are no hand, and too few are an error', () => {
  const line = JOINTS.map((_, i) => [0, 0.01 * i, 0]);
  assert.equal(handFromLandmarks('right', line), null);
  assert.equal(new LandmarkFilter().update(JOINTS.map(() => [1, 1, 1]), 0), null);
  assert.throws(() => handFromLandmarks('right', line.slice(1)), /points: expected 21, found 20/);
});

const points = (value) => JOINTS.map(() => ({x: value, y: value, z: value}));

test('the label is the other hand’s, unless the picture is mirrored', () => {
  const result = {multiHandLandmarks: [points(0.5), points(0.25)],
                  multiHandWorldLandmarks: [points(1), points(2)],
                  multiHandedness: [{label: 'Left', score: 0.9}, {label: 'Right', score: 0.8}]};
  assert.deepEqual(readMediapipe(result).map(({side}) => side), ['right', 'left']);
  assert.deepEqual(readMediapipe(result, true).map(({side}) => side), ['left', 'right']);
  assert.deepEqual(readMediapipe(result)[1].shape[3], [2, -2, -2]);
});

test('of two hands of one side the surer one is taken; broken and absent ones are not', () => {
  const result = {multiHandLandmarks: [points(0.1), points(0.2), points(NaN), points(0.4).slice(1)],
                  multiHandedness: [['Left', 0.6], ['Left', 0.7], ['Right', 0.9], ['Right', 0.9]]
                    .map(([label, score]) => ({label, score}))};
  const hands = readMediapipe(result);
  assert.deepEqual(hands.map(({side, score}) => [side, score]), [['right', 0.7]]);
  assert.equal(hands[0].picture[0][0], 0.2);
  assert.deepEqual(readMediapipe({}), []);
});

test('a still hand that jitters is drawn still, and of one size', () => {
  const still = landmarks(posed('right', 0.5));
  const filter = new LandmarkFilter();
  let seed = 1;
  const noise = () => ((seed = seed * 48271 % 2147483647) / 2147483647 - 0.5) * 0.01;
  let before;
  let most = 0;
  let jumped = 0;
  for (let frame = 0; frame < 200; ++frame) {
    const seen = still.map((point) => point.map((x) => 3 * (x + noise())));
    const shown = filter.update(seen, 33 * frame);
    const tip = (all) => [0, 1, 2].map((i) => all[8][i]);
    if (frame > 60) {
      most = Math.max(most, distance(tip(shown), tip(before.shown)));
      jumped = Math.max(jumped, distance(tip(seen), tip(before.seen)) / 3);
    }
    before = {shown, seen};
  }
  assert.ok(jumped > 0.006);
  assert.ok(most < 0.4 * jumped, `${most} of ${jumped} m`);
  const last = before.shown;
  assert.ok(Math.abs(distance(last[0], last[9]) - 0.092) < 0.005);
});

test('a hand that moves is followed', () => {
  const filter = new LandmarkFilter();
  const open = landmarks(posed('right', 0));
  const closed = landmarks(posed('right', 1));
  let shown;
  for (let frame = 0; frame < 30; ++frame) shown = filter.update(open, 33 * frame);
  const before = distance(shown[0], shown[12]);
  for (let frame = 30; frame < 45; ++frame) shown = filter.update(closed, 33 * frame);
  const moved = before - distance(shown[0], shown[12]);
  const asked = (distance(open[0], open[12]) - distance(closed[0], closed[12])) *
                0.092 / distance(open[0], open[9]);
  assert.ok(moved > 0.8 * asked, `${moved} of ${asked} m`);
});
