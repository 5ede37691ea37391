// IWER, an emulated headset, without a browser: what it asks of one is stood in for, and frames come
// when a test wants them.
import {metaQuest3, XRDevice} from 'iwer';

const FRAME_MS = 11;

/** A session with hands. `frame` runs one frame, and gives what `use(frame)` does in it. */
export async function startHeadset({features = ['local-floor', 'hand-tracking']} = {}) {
  const element = {dataset: {}, style: {}, appendChild() {}};
  let waiting = [];
  let timeMs = 0;
  Object.assign(globalThis, {
    document: {createElement: () => element, body: element},
    window: {},
    WebGL2RenderingContext: class {},
    localStorage: {getItem: () => null},
    requestAnimationFrame: (callback) => waiting.push(callback),
    cancelAnimationFrame() {},
    DOMPointReadOnly: class {
      constructor(x = 0, y = 0, z = 0, w = 1) { Object.assign(this, {x, y, z, w}); }
    },
  });
  Object.defineProperty(globalThis, 'navigator', {value: {}, configurable: true});
  const device = new XRDevice(metaQuest3, {visibilityMask: null});
  device.installRuntime({forceInstall: true});
  device.primaryInputMode = 'hand';
  const session = await navigator.xr.requestSession('immersive-vr',
                                                    {requiredFeatures: features});
  const context = new Proxy({canvas: element}, {get: (own, key) => own[key] ?? (() => [])});
  session.updateRenderState({baseLayer: new XRWebGLLayer(session, context)});
  performance.now = () => timeMs;
  const hands = () => Object.fromEntries(
    [...session.inputSources].filter(({hand}) => hand).map((it) => [it.handedness, it.hand]));
  const frame = async (use) => {
    let answer;
    timeMs += FRAME_MS;
    // In a promise: IWER prints what a callback throws, and goes on.
    session.requestAnimationFrame((_, frame) => {
      answer = new Promise((done) => done(use(frame, hands())));
    });
    const callbacks = waiting;
    waiting = [];
    for (const callback of callbacks) callback(timeMs);
    await null;  // what was waited for between frames comes
    return answer;
  };
  await frame(() => {});  // the first one brings the layer
  return {device, session, frame};
}
