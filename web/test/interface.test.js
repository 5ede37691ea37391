import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import test from 'node:test';

import {HAND_FLOATS, load, NadeError} from '../dist/index.js';

const nade = await load();

function fails(use, code, sentence) {
  assert.throws(use, (error) => {
    assert.ok(error instanceof NadeError, String(error));
    assert.ok(error instanceof Error);
    assert.equal(error.code, code);
    assert.match(error.message, sentence);
    return true;
  });
}

test('loads from bytes, a module and an address', async () => {
  const file = new URL('../dist/nade.wasm', import.meta.url);
  const bytes = readFileSync(file);
  const module = await WebAssembly.compile(bytes);
  for (const from of [bytes, module, file, String(file)]) {
    assert.equal((await load(from)).version, nade.version);
  }
  const start = process.hrtime.bigint();
  await load(module);
  assert.ok(Number(process.hrtime.bigint() - start) < 2e9);
});

test('wrong arguments are NadeErrors, in words', () => {
  const corrector = nade.corrector();
  const hand = nade.restHand('right');
  fails(() => nade.sphere(-1), 'argument', /radius_m: expected a number above 0, found -1/);
  fails(() => nade.sphere(NaN), 'argument', /radius_m/);
  fails(() => nade.box([1, 2]), 'argument', /halfSize: expected 3 numbers, found 2/);
  fails(() => nade.mesh([0, 0, 0], [0, 0, 0]), 'data', /./);
  fails(() => nade.mesh([], []), 'argument', /vertices/);
  fails(() => nade.mesh([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 7]), 'data', /7/);
  fails(() => nade.corrector({method: 'magic'}), 'argument', /method: .*magic/);
  fails(() => nade.corrector({release: 7}), 'argument', /release_s: expected 0.* to 1.*, found 7/);
  fails(() => nade.corrector({feel: {softness: 1}}), 'argument', /softness_m/);
  fails(() => corrector.update('both', hand, null, 0), 'argument', /side: .*both/);
  fails(() => corrector.update('right', hand.slice(1), null, 0), 'argument', /joints/);
  fails(() => corrector.update('right', undefined, null, 0), 'argument', /joints/);
  fails(() => corrector.update('right', hand, null, NaN), 'argument', /timeMs/);
  const none = {side: 'right', vertices: [], normals: [], triangles: [], bones: [], weights: [], bind: hand};
  fails(() => nade.skin(none), 'argument', /vertex_count: expected at least 1/);
  fails(() => nade.skin({...none, side: 'top'}), 'argument', /side/);
  fails(() => nade.skin({...none, normals: [1]}), 'argument', /normals: expected 0 numbers, found 1/);
  fails(() => nade.plane().closestPoint([0, NaN, 0]), 'argument', /query/);
});

test('what was destroyed is told, not followed', () => {
  const ball = nade.sphere(0.1);
  ball.destroy();
  fails(() => ball.destroy(), 'handle', /surface/);
  fails(() => ball.closestPoint([0, 0, 0]), 'handle', /destroyed/);
  const scene = nade.scene();
  scene.add(3, nade.plane());
  fails(() => scene.add(3, nade.plane()), 'id', /3/);
  fails(() => scene.place(4, {}), 'id', /4/);
  assert.equal(scene.size, 1);
});

test('a hand that cannot be used is no error', () => {
  const hand = nade.restHand('right');
  hand[4] = NaN;
  const result = nade.corrector().update('right', hand, nade.plane(), 0);
  assert.equal(result.status, 'untracked');
  assert.match(result.fault, /not finite/);
});

test('every kind of surface has its top where it should', () => {
  const group = nade.group([{surface: nade.sphere(0.05), placement: {position: [0, 0.05, 0]}}]);
  const tops = [
    [nade.plane(), 0], [nade.plate([-1, -1, 1, -1, 1, 1, -1, 1], 0.02), 0],
    [nade.sphere(0.2), 0.2], [nade.ellipsoid([0.1, 0.3, 0.1]), 0.3],
    [nade.box([0.1, 0.2, 0.3], 0.01), 0.2], [nade.cylinder(0.2, 0.1), 0.2],
    [nade.capsule(0.2, 0.1), 0.2], [group, 0.1], [nade.heightField([0, 0, 0, 0], 2, 1), 0],
    [nade.hull([-1, 0, -1, 1, 0, -1, 1, 0, 1, -1, 0, 1, 0, -1, 0]), 0],
  ];
  for (const [surface, top] of tops) {
    const {point, normal, signedDistance} = surface.closestPoint([0, top + 0.1, 0]);
    assert.ok(Math.abs(point[1] - top) < 1e-6);
    assert.ok(normal[1] > 0.99);
    assert.ok(Math.abs(signedDistance - 0.1) < 1e-6);
  }
  group.place(0, {position: [0, 0.15, 0]});
  assert.ok(Math.abs(group.closestPoint([0, 1, 0]).point[1] - 0.2) < 1e-6);
  assert.equal(nade.sphere(0.1).closestPoint([0, 1, 0], 0.5), null);
});

test('contacts say which bone touches what', () => {
  const hand = nade.restHand('right');
  const scene = nade.scene();
  scene.add(42, nade.plane());
  const corrector = nade.corrector();
  let result;
  for (let i = 0; i < 30; ++i) {
    for (let j = 5; j < HAND_FLOATS; j += 8) hand[j] -= 0.001;
    result = corrector.update('right', hand, scene, 11 * i);
  }
  assert.equal(result.status, 'corrected');
  assert.ok(result.contacts.length > 3);
  assert.ok(result.contacts.every(({object, normal}) => object === 42 && normal[1] > 0.99));
  assert.ok(result.contacts.some(({joint}) => joint === 'palm'));
  const drawn = corrector.preview('right', hand);
  assert.ok(drawn[5] > hand[5] + 0.003);
});
