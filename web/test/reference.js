// What the C library of this machine makes of strokes (reference.c).
import {execFileSync} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {fileURLToPath} from 'node:url';

import {HAND_FLOATS} from '../dist/index.js';

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

/** For each case its hands, and the median nanoseconds of an update. */
export function reference(cases) {
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
