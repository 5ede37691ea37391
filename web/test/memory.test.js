import assert from 'node:assert/strict';
import test from 'node:test';

import {load} from '../dist/index.js';
import {correct, dog, objects, stroke} from './strokes.js';

const STACK_BYTES = 1 << 20;
const PAINT = 0xa5;
const FRAMES = 1e5;

test('a frame allocates nothing: memory does not grow', async (t) => {
  const nade = await load();
  const [, ball, mesh] = objects(nade);
  const rights = stroke(nade, ball.top, 12, 3).filter(({side}) => side === 'right');
  const scene = nade.scene();
  scene.add(1, ball.surface);
  scene.add(2, mesh.surface);
  const corrector = nade.corrector();
  // Where the next blocks of this size would come from: the heap's state, as far as it shows. Two,
  // since free ones may take turns.
  const nextBlocks = () => [0, 0].map(() => {
    const at = nade.wasm.allocate(4096);
    nade.wasm.free(at);
    return at;
  }).sort();
  const before = nade.wasm.bytes.length;
  let free;
  let count = 0;
  for (let round = 0; count < FRAMES; ++round) {
    const scale = round % 8 === 0 ? 1 : 0;  // the mesh takes longer
    for (const {joints} of rights) {
      scene.place(2, {position: [0, -0.02, 0], scale});
      corrector.update('right', joints, scene, 11 * count++);
    }
    const now = nextBlocks();
    if (round > 0) assert.deepEqual(now, free);
    free = now;
  }
  t.diagnostic(`${count} frames, ${before >> 10} KiB`);
  assert.equal(nade.wasm.bytes.length, before);
});

test('the stack has room to spare', async (t) => {
  const nade = await load();
  const bytes = nade.wasm.bytes;
  // It lies at the bottom of the memory, and nothing is on it between calls.
  bytes.fill(PAINT, 0, STACK_BYTES - 4096);
  const all = objects(nade);
  for (const object of all) {
    for (const method of ['none', 'paper', 'nade']) {
      correct(nade, object.surface, stroke(nade, object.top, 2, 5), method);
    }
  }
  const body = dog();
  if (body) nade.mesh(body.vertices, body.triangles).destroy();
  const scene = nade.scene();
  all.forEach(({surface, top}, i) => scene.add(i, surface, {position: top.map((x) => -x)}));
  correct(nade, scene, stroke(nade, [0, 0, 0], 2, 5));
  const untouched = nade.wasm.bytes.findIndex((byte) => byte !== PAINT);
  t.diagnostic(`${(STACK_BYTES - untouched) >> 10} KiB of ${STACK_BYTES >> 10} KiB used`);
  assert.ok(untouched > STACK_BYTES / 2, `${untouched} bytes were never used`);
});

test('the dog is refitted', async (t) => {
  const body = dog();
  if (!body) return t.skip('it has not been built');
  const nade = await load();
  const surface = nade.mesh(body.vertices, body.triangles);
  const moved = body.vertices.map((x, i) => (i % 3 === 1 ? x + 0.01 : x));
  const times = [];
  for (let i = 0; i < 20; ++i) {
    const start = process.hrtime.bigint();
    surface.refit(i % 2 ? body.vertices : moved);
    times.push(Number(process.hrtime.bigint() - start) / 1e6);
  }
  times.sort((a, b) => a - b);
  t.diagnostic(`${times[10].toFixed(1)} ms for ${body.vertices.length / 3} vertices`);
  const top = surface.closestPoint([0.04, 0.5, 0]).point[1];
  surface.refit(moved);
  assert.ok(Math.abs(surface.closestPoint([0.04, 0.51, 0]).point[1] - top - 0.01) < 1e-5);
});
