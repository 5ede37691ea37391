import assert from 'node:assert/strict';
import {readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {fileURLToPath} from 'node:url';
import test from 'node:test';

import {browser, freshProject, moduleOf, runInBrowser} from './project.js';

const HANDS = fileURLToPath(new URL('../../build/release/share/nade/hands', import.meta.url));

/** The first block of code below a heading of README.md. */
function readmeCode(heading) {
  const text = readFileSync(new URL('../README.md', import.meta.url), 'utf8');
  const [, code] = new RegExp(`^## ${heading}\\n[^]*?\`\`\`js\\n([^]*?)\`\`\``, 'm').exec(text);
  return code;
}

// An emulated headset, whose right hand goes down through the table; 200 mm over it the other one.
const HEADSET = `
  import {metaQuest3, XRDevice} from 'iwer';
  const device = new XRDevice(metaQuest3, {stereoEnabled: false});
  device.installRuntime({forceInstall: true});
  device.primaryInputMode = 'hand';
  device.position.set(0, 1.5, 0.3);
  device.quaternion.set(-0.38, 0, 0, 0.92);
  device.hands.left.position.set(-0.2, 1.2, -0.3);
  const LOWEST = 0.85;
  let height = 1;
  function lowerHand() {
    height = Math.max(LOWEST, height - 0.002);
    device.hands.right.quaternion.set(-0.26, 0, 0, 0.9656);
    device.hands.right.position.set(0.1, height, -0.3);
    return height > LOWEST;
  }
  addEventListener('error', ({message}) => send({failed: message}));
  addEventListener('unhandledrejection', ({reason}) => send({failed: String(reason)}));
`;

const THREE_BEFORE = `
  import {AmbientLight, BoxGeometry, DirectionalLight, Mesh, MeshStandardMaterial, PerspectiveCamera,
          Scene, WebGLRenderer} from 'three';
  import {XRHandModelFactory} from 'three/addons/webxr/XRHandModelFactory.js';
  const renderer = new WebGLRenderer();
  renderer.setSize(640, 480);
  document.body.append(renderer.domElement);
  renderer.xr.enabled = true;
  const scene = new Scene();
  const camera = new PerspectiveCamera();
  scene.add(new AmbientLight(), new DirectionalLight());
  const dog = new Mesh(new BoxGeometry(1, 0.1, 1), new MeshStandardMaterial({color: 0xc08040}));
  dog.position.set(0, 0.85, -0.3);                        // its top is 0.9 m high
  scene.add(dog);
`;

const THREE_AFTER = `
  await renderer.xr.setSession(await navigator.xr.requestSession('immersive-vr',
      {requiredFeatures: ['local-floor', 'hand-tracking']}));
  const timer = setInterval(() => {
    const hand = hands.find(({result}) => result?.status === 'corrected');
    const skin = hand?.children.find(({original}) => original);
    if (lowerHand() || !skin) return;
    clearInterval(timer);
    const heights = (joints) => Object.values(joints).map((joint) => joint.position.y);
    requestAnimationFrame(() => send({
      tracked: heights(hand.tracked.joints), drawn: heights(hand.joints),
      skin: [...skin.geometry.attributes.position.array].filter((_, i) => i % 3 === 1),
      isHidden: !skin.original.visible,
      contacts: hand.result.contacts.length,
    }));
  }, 11);
`;

test('three.js: the README’s lines, in a fresh project, draw corrected hands', async (t) => {
  const program = browser();
  if (!program) return t.skip('chromium is not installed');
  const {project, run, remove} = freshProject(['three', 'iwer']);
  try {
    writeFileSync(join(project, 'main.js'),
                  HEADSET + THREE_BEFORE + readmeCode('three.js') + THREE_AFTER);
    run(moduleOf('.bin/esbuild'), 'main.js', '--bundle', '--format=esm',
        '--outfile=bundle.js');
    run('cp', 'node_modules/nade/dist/nade.wasm', '.');
    run('cp', '-r', HANDS, 'hands');
    const page = '<!doctype html><body><script type="module" src="bundle.js"></script>';
    const result = await runInBrowser(program, project, page);
    assert.equal(result.failed, undefined);
    t.diagnostic(`lowest joint ${(1e3 * (Math.min(...result.tracked) - 0.9)).toFixed(1)} mm above ` +
                 `the table as tracked, ${(1e3 * (Math.min(...result.drawn) - 0.9)).toFixed(1)} drawn`);
    assert.ok(Math.min(...result.tracked) < 0.89);
    assert.ok(Math.min(...result.drawn) > 0.895);
    assert.ok(result.contacts > 0);
    assert.ok(result.isHidden);
    assert.ok(Math.min(...result.skin) > 0.8995, `skin ${Math.min(...result.skin)} m high`);
  } finally {
    remove();
  }
});
