// Builds the page: node build.js SHARE STROKE OUT. SHARE is the folder share/nade of nade's build,
// with the dog and the hands, STROKE a recording to replay; what is in OUT needs any static server,
// and nothing else.
import {copyFileSync, mkdirSync, readFileSync, rmSync, statSync, writeFileSync} from 'node:fs';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';

import {build} from 'esbuild';

import {readGlb, writeGlb} from '../glb.js';

const MOST_BYTES = 3e6;
/** What the page asks for by itself. */
const FIRST = ['index.html', 'style.css', 'icon.svg', 'main.js', 'nade.wasm', 'right.glb',
               'dog.glb', 'relaxed.jsonl'];
const here = dirname(fileURLToPath(import.meta.url));
const [share, stroke, out] = process.argv.slice(2);

/** The dog with whole numbers of 16 and 8 bits: half of its size. */
function smallDog(file) {
  const {gltf, read} = readGlb(file);
  const {attributes, indices} = gltf.meshes[0].primitives[0];
  const [skin] = gltf.skins;
  const positions = read(attributes.POSITION);
  const count = positions.length / 3;
  if (count > 65536) throw new Error(`the dog: expected at most 65536 vertices, found ${count}`);
  const unit = positions.reduce((most, x) => Math.max(most, Math.abs(x)), 0) / 32767;
  const packed = (Kind, values, size, scale) => {
    const four = new Kind(4 * count);  // glTF wants each vertex on a multiple of four bytes
    for (let i = 0; i < values.length; ++i) {
      four[4 * Math.floor(i / size) + i % size] = Math.round(values[i] * scale);
    }
    return four;
  };
  // What the numbers are smaller by, the bones' rest poses are larger by.
  const inverse = read(skin.inverseBindMatrices).map((x, i) => (i % 16 < 12 ? unit * x : x));
  const whole = positions.map((x) => Math.round(x / unit));
  const most = (which, axis) => whole.reduce(
    (sum, x, i) => (i % 3 === axis ? which(sum, x) : sum), 0);
  const accessors = [];
  const bufferViews = [];
  const parts = [];
  const add = (data, accessor, view = {}) => {
    bufferViews.push(view);
    parts.push(data);
    return accessors.push({bufferView: parts.length - 1, ...accessor}) - 1;
  };
  const vertices = (data, type, more) => add(
    data, {componentType: {Int16Array: 5122, Uint8Array: 5121}[data.constructor.name], count, type,
           ...more}, {target: 34962, byteStride: 4 * data.BYTES_PER_ELEMENT});
  const copied = (index) => {
    const {componentType, type, min, max} = gltf.accessors[index];
    return add(read(index), {componentType, count: gltf.accessors[index].count, type, min, max});
  };
  const primitive = {
    attributes: {
      POSITION: vertices(packed(Int16Array, positions, 3, 1 / unit), 'VEC3', {
        min: [0, 1, 2].map((axis) => most(Math.min, axis)),
        max: [0, 1, 2].map((axis) => most(Math.max, axis))}),
      NORMAL: vertices(packed(Int16Array, read(attributes.NORMAL), 3, 32767), 'VEC3',
                       {normalized: true}),
      COLOR_0: vertices(packed(Uint8Array, read(attributes.COLOR_0), 3, 255), 'VEC3',
                        {normalized: true}),
      JOINTS_0: vertices(read(attributes.JOINTS_0), 'VEC4'),
      WEIGHTS_0: vertices(packed(Uint8Array, read(attributes.WEIGHTS_0), 4, 255), 'VEC4',
                          {normalized: true}),
    },
    indices: add(Uint16Array.from(read(indices)), {
      componentType: 5123, count: gltf.accessors[indices].count, type: 'SCALAR'}, {target: 34963}),
    material: 0,
  };
  const times = new Map();
  const animations = gltf.animations.map(({name, channels, samplers}) => ({
    name, channels, samplers: samplers.map(({input, interpolation, output}) => {
      if (!times.has(input)) times.set(input, copied(input));
      return {input: times.get(input), interpolation, output: copied(output)};
    })}));
  const inverseBindMatrices = add(inverse, {componentType: 5126, count: inverse.length / 16,
                                            type: 'MAT4'});
  const {scene, scenes, nodes, materials} = gltf;
  return writeGlb({
    asset: {version: '2.0', generator: 'nade'},
    extensionsUsed: ['KHR_mesh_quantization'], extensionsRequired: ['KHR_mesh_quantization'],
    scene, scenes, nodes, materials, meshes: [{primitives: [primitive]}],
    skins: [{...skin, inverseBindMatrices}], animations, accessors, bufferViews}, parts);
}

const MEDIAPIPE = ['hands.js', 'hands.binarypb', 'hand_landmark_lite.tflite',
                   'hands_solution_packed_assets.data', 'hands_solution_packed_assets_loader.js',
                   'hands_solution_simd_wasm_bin.js', 'hands_solution_simd_wasm_bin.wasm'];

rmSync(out, {recursive: true, force: true});
mkdirSync(join(out, 'mediapipe'), {recursive: true});
await build({
  entryPoints: [join(here, 'src/main.ts')], outfile: join(out, 'main.js'), bundle: true,
  minify: true, format: 'esm', target: 'es2022', legalComments: 'linked', logLevel: 'warning',
});
for (const name of ['index.html', 'style.css', 'icon.svg']) {
  copyFileSync(join(here, name), join(out, name));
}
copyFileSync(join(here, '../dist/nade.wasm'), join(out, 'nade.wasm'));
for (const name of ['left.glb', 'right.glb', 'LICENSE-relaxed', 'relaxed.jsonl']) {
  copyFileSync(join(share, 'hands', name), join(out, name));
}
copyFileSync(join(share, 'hands/LICENSE-generic-hand.md'), join(out, 'LICENSE-hand.md'));
copyFileSync(stroke, join(out, 'stroke.jsonl.gz'));
writeFileSync(join(out, 'dog.glb'), smallDog(readFileSync(join(share, 'dog.glb'))));

// Loaded only by who wants it. Its package has no file with the licence that it names, ours.
for (const name of MEDIAPIPE) {
  copyFileSync(join(here, '../node_modules/@mediapipe/hands', name), join(out, 'mediapipe', name));
}
copyFileSync(join(here, '../../LICENSE'), join(out, 'mediapipe/LICENSE'));

const worker = readFileSync(join(here, 'sw.js'), 'utf8');
writeFileSync(join(out, 'sw.js'), worker.replace('FIRST = []', `FIRST = ${JSON.stringify(FIRST)}`));

const bytes = FIRST.reduce((sum, name) => sum + statSync(join(out, name)).size, 0);
console.log(`${out}: ${(bytes / 1e6).toFixed(2)} MB at first`);
if (bytes > MOST_BYTES) throw new Error(`the page: expected at most ${MOST_BYTES / 1e6} MB`);
