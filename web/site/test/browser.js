// The page in Debian's Chromium, drawn without a graphics card.
import assert from 'node:assert/strict';
import {spawn} from 'node:child_process';
import {mkdirSync} from 'node:fs';
import {createRequire} from 'node:module';
import {join} from 'node:path';
import {fileURLToPath} from 'node:url';

import {chromium} from 'playwright-core';

import {writeGlb} from '../../glb.js';
import {browser as chromiumHere} from '../../test/project.js';

const require = createRequire(import.meta.url);
const root = fileURLToPath(new URL('../../..', import.meta.url));
export const built = join(root, 'build/web');
const pictures = join(built, 'pictures');
const SIZE = {viewport: {width: 1280, height: 800}};

/** A machine may have other things to do. */
const PATIENCE_MS = 300e3;

/** Serves the page, and opens it as often as is asked; `close` ends both. */
export async function openBrowser() {
  const server = spawn(process.execPath, [join(root, 'web/site/serve.js'), join(built, 'site'), '8400']);
  const address = await new Promise((resolve, reject) => {
    server.stdout.once('data', (line) => resolve(String(line).trim()));
    server.stderr.once('data', (line) => reject(new Error(String(line))));
  });
  const browser = await chromium.launch({
    executablePath: chromiumHere(), timeout: PATIENCE_MS,
    args: ['--use-gl=angle', '--use-angle=gl-egl', '--ignore-gpu-blocklist',
           '--use-fake-device-for-media-stream',
           `--use-file-for-fake-video-capture=${join(built, 'hand.mjpeg')}`]}).catch((error) => {
    server.kill();
    throw error;
  });
  mkdirSync(pictures, {recursive: true});
  return {
    /** The page, ready. What it asks of others, or calls an error, fails the test at `done`. */
    async open({script, ...options} = {}) {
      const context = await browser.newContext({...SIZE, permissions: ['camera'], ...options});
      context.setDefaultTimeout(PATIENCE_MS);
      const complaints = [];
      const requests = [];
      context.on('request', (request) => requests.push(request.url()));
      if (script) for (const part of [script].flat()) await context.addInitScript(part);
      const page = await context.newPage();
      page.on('pageerror', (error) => complaints.push(error.message));
      page.on('console', (line) => { if (line.type() === 'error') complaints.push(line.text()); });
      await page.goto(address);
      await until(page, () => window.nadePage?.hand('right'));
      return {
        page, context, requests,
        picture: (name) => page.screenshot({path: join(pictures, `${name}.png`)}),
        async done() {
          await context.close();
          assert.deepEqual(complaints, []);
          const others = requests.filter((url) => !url.startsWith(address) && !/^(blob|data):/.test(url));
          assert.deepEqual(others, []);
        },
      };
    },
    async close() {
      await browser.close();
      server.kill();
    },
  };
}

/** Asks the page again and again; gives its first answer that is something. */
export async function until(page, question, argument, seconds = PATIENCE_MS / 1000) {
  for (let end = Date.now() + 1000 * seconds; Date.now() < end;) {
    const answer = await page.evaluate(question, argument);
    if (answer) return answer;
    await page.waitForTimeout(60);
  }
  return assert.fail(`waited ${seconds} s for ${question}`);
}

/** Waits for so many frames: without a graphics card time goes by more slowly than it does. */
export async function frames(page, count) {
  await page.evaluate(() => window.nadePage.spent());
  await until(page, (most) => {
    window.seen = (window.seen ?? 0) + window.nadePage.spent().length;
    if (window.seen < most) return false;
    window.seen = 0;
    return true;
  }, count);
}

/** A headset that is none; `window.inject(side, joints)` puts a hand into the page's scene. */
export const headset = [{path: require.resolve('iwer/build/iwer.min.js')}, () => {
  const {XRDevice, metaQuest3} = window.IWER;
  const device = window.device = new XRDevice(metaQuest3, {stereoEnabled: false});
  device.installRuntime({forceInstall: true});
  device.primaryInputMode = 'hand';
  device.position.set(0.2, 1.5, 0.3);
  device.quaternion.set(-0.26, 0, 0, 0.966);
  const names = (hand) => [...hand.keys()];
  /** 26 joints of 8 numbers, the palm first, which WebXR does not have. */
  window.inject = (side, joints) => {
    const input = device.hands[side];
    const table = window.nadePage.tableMatrix();
    input.position.set(0, 0, 0);
    input.quaternion.set(0, 0, 0, 1);
    input.updateHandPose = () => names(input.inputSource.hand).forEach((name, i) => {
      const space = input.inputSource.hand.get(name);
      const [x, y, z, w, px, py, pz, radius] = joints.slice(8 * (i + 1), 8 * (i + 2));
      const local = [
        1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0,
        2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0,
        2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0, px, py, pz, 1];
      for (const symbol of Object.getOwnPropertySymbols(space)) {
        const kept = space[symbol];
        if ('radius' in kept) kept.radius = radius;
        if (!kept.offsetMatrix) continue;
        for (let column = 0; column < 4; ++column) {
          for (let row = 0; row < 4; ++row) {
            kept.offsetMatrix[4 * column + row] = [0, 1, 2, 3].reduce(
              (sum, k) => sum + table[4 * k + row] * local[4 * column + k], 0);
          }
        }
      }
    });
  };
  // IWER takes a matrix for what WebXR has as a transform.
  const space = window.XRReferenceSpace.prototype;
  const {getOffsetReferenceSpace} = space;
  space.getOffsetReferenceSpace = function(origin) {
    return getOffsetReferenceSpace.call(this, origin.matrix);
  };
  /** Joints of this name have no pose, as a tracker's that does not see them. */
  window.hidden = null;
  const {getJointPose, fillPoses} = window.XRFrame.prototype;
  window.XRFrame.prototype.getJointPose = function(joint, space) {
    return joint.jointName === window.hidden ? null : getJointPose.call(this, joint, space);
  };
  window.XRFrame.prototype.fillPoses = function(spaces, ...rest) {
    return [...spaces].every(({jointName}) => jointName !== window.hidden) &&
           fillPoses.call(this, spaces, ...rest);
  };
}];

/** A GLB of one mesh. */
export function glb(positions, indices) {
  const axis = (k) => positions.filter((_, i) => i % 3 === k);
  return writeGlb({
    asset: {version: '2.0'}, scene: 0, scenes: [{nodes: [0]}], nodes: [{mesh: 0}],
    meshes: [{primitives: [{attributes: {POSITION: 0}, indices: 1}]}],
    accessors: [
      {bufferView: 0, componentType: 5126, count: positions.length / 3, type: 'VEC3',
       min: [0, 1, 2].map((k) => Math.min(...axis(k))), max: [0, 1, 2].map((k) => Math.max(...axis(k)))},
      {bufferView: 1, componentType: 5125, count: indices.length, type: 'SCALAR'}],
    bufferViews: [{}, {}],
  }, [Float32Array.from(positions), Uint32Array.from(indices)]);
}

export const CUBE = [
  [-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1, -1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, 1].map((x) => x / 8),
  [0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4, 3, 7, 6, 3, 6, 2, 1, 2, 6, 1, 6, 5, 0, 4, 7,
   0, 7, 3]];
