import assert from 'node:assert/strict';
import test from 'node:test';

import {load, NadeError} from '../dist/index.js';
import {readRecording, writePackedRecording, writeRecording} from '../dist/recording.js';
import {stroke} from './strokes.js';

const nade = await load();
const recording = {
  header: {format: 'nade-recording', version: 1, source: 'test', own: [1, {a: 2}]},
  frames: stroke(nade, [0, 0, 0], 1, 1).map(({side, joints}, i) => (
    {timeNs: 4_000_000_000_000_000_000n + BigInt(i), [side]: {joints, confidence: 0.5}})),
};

test('what is written comes back bit for bit, plain and packed', async () => {
  assert.deepEqual(await readRecording(writeRecording(recording)), recording);
  assert.deepEqual(await readRecording(await writePackedRecording(recording)), recording);
});

test('a last line that was cut off is left out', async () => {
  const text = writeRecording(recording);
  const read = await readRecording(`\uFEFF${text.slice(0, -20).replaceAll('\n', '\r\n\r\n')}`);
  assert.equal(read.frames.length, recording.frames.length - 1);
});

test('a hand that was lost is left out, and what is wrong is told', async () => {
  const lines = writeRecording(recording).split('\n');
  const changed = (from, to) => [lines[0], lines[1].replace(from, to), ''].join('\n');
  const lost = await readRecording(changed(/\[\[[^,]*/, '[[null'));
  assert.equal(lost.frames.length, 1);
  assert.equal(lost.frames[0].left, undefined);
  const wrong = async (text, sentence) => assert.rejects(readRecording(text), (error) => {
    assert.ok(error instanceof NadeError);
    assert.match(error.message, sentence);
    return true;
  });
  await wrong('', /found nothing/);
  await wrong('{"format":"other"}\n', /line 1: expected "format"/);
  await wrong(changed('"joints"', '"bones"'), /line 2: left.joints: expected 26 joints/);
  await wrong(changed('}', ''), /line 2: is no JSON/);
  await wrong([lines[0], lines[2], lines[1], ''].join('\n'), /line 3: t: expected more than/);
  await wrong(new Uint8Array([0x1f, 0x8b, 8, 0, 1, 2, 3]), /gzip/);
  assert.throws(() => writeRecording({header: {}, frames: [{timeNs: 1n}, {timeNs: 1n}]}), NadeError);
});
