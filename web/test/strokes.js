// Strokes of two hands over objects, the same in every run, and the objects.
import {existsSync, readFileSync} from 'node:fs';

import {HAND_FLOATS, JOINT_FLOATS} from '../dist/index.js';
import {readGlb} from '../glb.js';

export const FRAMES_PER_SECOND = 90;

/** Numbers from -1 to 1, the same ones in every run. */
export function randomNumbers(seed) {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 0x80000000 - 1;
  };
}

/** A ball with bumps, about the origin: a mesh with nothing regular about it. */
export function bumpyBall(radius = 0.12, rows = 48, columns = 64) {
  const vertices = [0, radius, 0];
  const triangles = [];
  for (let row = 1; row < rows; ++row) {
    for (let column = 0; column < columns; ++column) {
      const down = Math.PI * row / rows;
      const around = 2 * Math.PI * column / columns;
      const r = radius * (1 + 0.04 * Math.sin(7 * down) * Math.cos(5 * around));
      vertices.push(r * Math.sin(down) * Math.cos(around), r * Math.cos(down),
                    r * Math.sin(down) * Math.sin(around));
    }
  }
  vertices.push(0, -radius, 0);
  const at = (row, column) => 1 + (row - 1) * columns + column % columns;
  const last = vertices.length / 3 - 1;
  for (let column = 0; column < columns; ++column) {
    triangles.push(0, at(1, column + 1), at(1, column));
    triangles.push(last, at(rows - 1, column), at(rows - 1, column + 1));
    for (let row = 1; row < rows - 1; ++row) {
      const [a, b] = [at(row, column), at(row, column + 1)];
      const [c, d] = [at(row + 1, column), at(row + 1, column + 1)];
      triangles.push(a, b, c, b, d, c);
    }
  }
  return {vertices: new Float32Array(vertices), triangles: new Uint32Array(triangles)};
}

/** The dog that comes with nade, if it has been built. */
export function dog(path = new URL('../../build/release/share/nade/dog.glb', import.meta.url)) {
  if (!existsSync(path)) return null;
  const {gltf, read} = readGlb(readFileSync(path));
  const {attributes, indices} = gltf.meshes[0].primitives[0];
  return {vertices: read(attributes.POSITION), triangles: read(indices)};
}

/**
 * Both hands in turns stroke what has its top at `top`, sinking in by up to 35 mm and out again,
 * with the jitter of a tracker: a list of {side, timeNs, joints}.
 */
export function stroke(nade, top, seconds, seed) {
  const random = randomNumbers(seed);
  const hands = {left: nade.restHand('left'), right: nade.restHand('right')};
  const frames = [];
  for (let i = 0; i < seconds * FRAMES_PER_SECOND; ++i) {
    const t = i / FRAMES_PER_SECOND;
    for (const side of ['left', 'right']) {
      const away = side === 'left' ? -0.03 : 0.03;
      const x = away + 0.07 * Math.sin(2.1 * t + away);
      const y = 0.02 - 0.035 * (0.5 - Math.cos(1.3 * t)) - 0.0175;
      const z = 0.05 * Math.cos(1.7 * t);
      const tilt = 0.15 * Math.sin(0.9 * t) / 2;
      const joints = new Float32Array(HAND_FLOATS);
      const rest = hands[side];
      const [s, c] = [Math.sin(tilt), Math.cos(tilt)];
      for (let j = 0; j < HAND_FLOATS; j += JOINT_FLOATS) {
        const [qx, qy, qz, qw, px, py, pz, radius] = rest.subarray(j, j + JOINT_FLOATS);
        // Turned about x, then moved.
        joints.set([c * qx + s * qw, c * qy - s * qz, c * qz + s * qy, c * qw - s * qx,
                    top[0] + x + px + 5e-4 * random(),
                    top[1] + y + (c * c - s * s) * py - 2 * s * c * pz + 5e-4 * random(),
                    top[2] + z + (c * c - s * s) * pz + 2 * s * c * py + 5e-4 * random(), radius],
                   j);
      }
      frames.push({side, timeNs: BigInt(Math.round(t * 1e9)), joints});
    }
  }
  return frames;
}

/** What is stroked: `kind` and `mesh` for reference.c, `surface` here. */
export function objects(nade) {
  const all = [
    {name: 'plane', kind: 0, top: [0, 0, 0], surface: nade.plane()},
    {name: 'ball', kind: 1, top: [0, 0.1, 0], surface: nade.sphere(0.1)},
  ];
  const bumpy = bumpyBall();
  all.push({name: 'mesh', kind: 2, top: [0, 0.12, 0], mesh: bumpy,
            surface: nade.mesh(bumpy.vertices, bumpy.triangles)});
  const body = dog();
  if (body) {
    all.push({name: 'dog', kind: 2, top: [0.04, 0.4388, 0], mesh: body,
              surface: nade.mesh(body.vertices, body.triangles)});
  }
  return all;
}

/** The hands of all frames, one after another, and how long an update took, nanoseconds. */
export function correct(nade, surface, frames, method = 'nade') {
  const correctors = {left: nade.corrector({method}), right: nade.corrector({method})};
  const hands = new Float32Array(HAND_FLOATS * frames.length);
  const times = frames.map(({side, timeNs, joints}, i) => {
    const start = process.hrtime.bigint();
    const result = correctors[side].update(side, joints, surface, Number(timeNs) / 1e6);
    const time = Number(process.hrtime.bigint() - start);
    hands.set(result.joints, HAND_FLOATS * i);
    return time;
  });
  for (const corrector of Object.values(correctors)) corrector.destroy();
  times.sort((a, b) => a - b);
  return {hands, medianNs: times[times.length >> 1]};
}
