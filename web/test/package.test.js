import assert from 'node:assert/strict';
import {copyFileSync, mkdirSync, readdirSync, readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {fileURLToPath} from 'node:url';
import test from 'node:test';
import {brotliCompressSync, gzipSync} from 'node:zlib';

import {buildSync} from 'esbuild';

import {freshProject, moduleOf} from './project.js';

const WASM_BYTES = 170e3;
const CORE_BYTES = 12e3;
const folder = fileURLToPath(new URL('..', import.meta.url));

test('size: nade.wasm by brotli, the core’s JavaScript by gzip', (t) => {
  const wasm = brotliCompressSync(readFileSync(join(folder, 'dist/nade.wasm'))).length;
  const {outputFiles: [bundle]} = buildSync({entryPoints: [join(folder, 'dist/index.js')],
                                             bundle: true, format: 'esm', write: false});
  const core = gzipSync(bundle.contents).length;
  t.diagnostic(`${(wasm / 1e3).toFixed(1)} KB of ${WASM_BYTES / 1e3}, ` +
               `${(core / 1e3).toFixed(1)} KB of ${CORE_BYTES / 1e3}`);
  assert.ok(wasm <= WASM_BYTES, `${wasm} bytes`);
  assert.ok(core <= CORE_BYTES, `${core} bytes`);
});

test('packed, installed into an empty project, checked by tsc, bundled and run', () => {
  const {project, run, remove} = freshProject();
  try {
    writeFileSync(join(project, 'use.ts'), `
      import {load, type Result} from 'nade';
      import {readRecording} from 'nade/recording';
      import {PointerHand} from 'nade/pointer';
      const nade = await load();
      const hand = new PointerHand(nade.restHand('left'), 'left');
      const result: Result = nade.corrector().update(
          'left', hand.update(nade.plane(), {ahead: [0, 0, -1], up: [0, 1, 0]}, 0.01), null, 0);
      console.log(result.status, typeof readRecording);
    `);
    writeFileSync(join(project, 'tsconfig.json'), JSON.stringify({compilerOptions: {
      strict: true, module: 'nodenext', target: 'es2022', skipLibCheck: false, types: []}}));
    run(moduleOf('.bin/tsc'));
    assert.equal(run('node', 'use.js'), 'free function\n');
    run(moduleOf('.bin/esbuild'), 'use.js', '--bundle', '--format=esm', '--outfile=bundle.js');
  } finally {
    remove();
  }
});

test('bundled: nade.wasm beside the script, or within it', () => {
  const {project, run, remove} = freshProject();
  const bundle = (name, module) => {
    writeFileSync(join(project, `${name}.js`), `
      import {load} from '${module}';
      const nade = await load();
      const tracked = nade.restHand('right');
      console.log(nade.corrector().update('right', tracked, nade.plane(), 0).status);`);
    mkdirSync(join(project, name));
    run(moduleOf('.bin/esbuild'), `${name}.js`, '--bundle', '--format=esm', '--log-level=warning',
        `--outfile=${name}/main.mjs`);
    return join(project, name, 'main.mjs');
  };
  try {
    const beside = bundle('beside', 'nade');
    copyFileSync(join(project, 'node_modules/nade/dist/nade.wasm'),
                 join(project, 'beside/nade.wasm'));
    assert.equal(run('node', beside), 'corrected\n');
    const inline = bundle('inline', 'nade/inline');
    assert.deepEqual(readdirSync(join(project, 'inline')), ['main.mjs']);
    assert.equal(run('node', inline), 'corrected\n');
    assert.ok(!readFileSync(inline, 'utf8').includes('import.meta'));
  } finally {
    remove();
  }
});
