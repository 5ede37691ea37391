// Builds the page: node build.js SHARE OUT. SHARE is the folder share/nade of nade's build, with
// the dog and the hands; what is in OUT needs any static server, and nothing else.
import {copyFileSync, mkdirSync, readFileSync, readdirSync, rmSync, statSync,
        writeFileSync} from 'node:fs';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';

import {build} from 'esbuild';

const MOST_BYTES = 3e6;
const here = dirname(fileURLToPath(import.meta.url));
const [share, out] = process.argv.slice(2);

/** The dog standing still, with whole numbers of 16 bits: a third of its size. */
function smallDog(file) {
  const jsonBytes = file.readUInt32LE(12);
  const gltf = JSON.parse(file.subarray(20, 20 + jsonBytes).toString());
  const {attributes, indices} = gltf.meshes[0].primitives[0];
  const read = (index) => {
    const {bufferView, count, type} = gltf.accessors[index];
    const {byteOffset = 0} = gltf.bufferViews[bufferView];
    const from = file.byteOffset + 28 + jsonBytes + byteOffset;
    return file.buffer.slice(from, from + 4 * count * (type === 'VEC3' ? 3 : 1));
  };
  const positions = new Float32Array(read(attributes.POSITION));
  const normals = new Float32Array(read(attributes.NORMAL));
  const colours = new Float32Array(read(attributes.COLOR_0));
  const corners = new Uint32Array(read(indices));
  const count = positions.length / 3;
  if (count > 65536) throw new Error(`the dog: expected at most 65536 vertices, found ${count}`);
  const unit = positions.reduce((most, x) => Math.max(most, Math.abs(x)), 0) / 32767;
  const packed = (Kind, values, scale) => {
    const four = new Kind(4 * count);  // glTF wants each vertex on a multiple of four bytes
    for (let i = 0; i < values.length; ++i) {
      four[4 * Math.floor(i / 3) + i % 3] = Math.round(values[i] * scale);
    }
    return four;
  };
  const parts = [packed(Int16Array, positions, 1 / unit), packed(Int16Array, normals, 32767),
                 packed(Uint8Array, colours, 255), Uint16Array.from(corners)];
  const places = [0, 1, 2].map((axis) => positions.filter((_, i) => i % 3 === axis));
  const round = (x) => Math.round(x / unit);
  const accessor = (bufferView, componentType, normalized) => (
    {bufferView, componentType, normalized, count, type: 'VEC3'});
  let byteOffset = 0;
  const bufferViews = parts.map((part, i) => {
    const view = {buffer: 0, byteOffset, byteLength: part.byteLength,
                  target: i < 3 ? 34962 : 34963, byteStride: [8, 8, 4][i]};
    byteOffset += part.byteLength;
    return view;
  });
  const json = Buffer.from(JSON.stringify({
    asset: {version: '2.0', generator: 'nade'},
    extensionsUsed: ['KHR_mesh_quantization'],
    extensionsRequired: ['KHR_mesh_quantization'],
    scene: 0,
    scenes: [{nodes: [0]}],
    nodes: [{name: 'dog', mesh: 0, scale: [unit, unit, unit]}],
    materials: gltf.materials,
    meshes: [{primitives: [
      {attributes: {POSITION: 0, NORMAL: 1, COLOR_0: 2}, indices: 3, material: 0}]}],
    accessors: [
      {...accessor(0, 5122, false), min: places.map((p) => round(Math.min(...p))),
       max: places.map((p) => round(Math.max(...p)))},
      accessor(1, 5122, true), accessor(2, 5121, true),
      {bufferView: 3, componentType: 5123, count: corners.length, type: 'SCALAR'},
    ],
    bufferViews,
    buffers: [{byteLength: byteOffset}],
  }));
  const text = Buffer.concat([json, Buffer.alloc(-json.length & 3, ' ')]);
  const data = Buffer.concat(parts.map((p) => Buffer.from(p.buffer)));
  const binary = Buffer.concat([data, Buffer.alloc(-data.length & 3)]);
  const number = (...values) => Buffer.from(new Uint32Array(values).buffer);
  return Buffer.concat([
    number(0x46546c67, 2, 28 + text.length + binary.length), number(text.length, 0x4e4f534a), text,
    number(binary.length, 0x004e4942), binary]);
}

rmSync(out, {recursive: true, force: true});
mkdirSync(out, {recursive: true});
await build({
  entryPoints: [join(here, 'src/main.ts')], outfile: join(out, 'main.js'), bundle: true,
  minify: true, format: 'esm', target: 'es2022', legalComments: 'linked', logLevel: 'warning',
});
for (const name of ['index.html', 'style.css', 'icon.svg']) {
  copyFileSync(join(here, name), join(out, name));
}
copyFileSync(join(here, '../dist/nade.wasm'), join(out, 'nade.wasm'));
copyFileSync(join(share, 'hands/right.glb'), join(out, 'hand.glb'));
copyFileSync(join(share, 'hands/LICENSE-generic-hand.md'), join(out, 'LICENSE-hand.md'));
copyFileSync(join(share, 'hands/LICENSE-relaxed'), join(out, 'LICENSE-relaxed'));
copyFileSync(join(share, 'hands/relaxed.jsonl'), join(out, 'relaxed.jsonl'));
writeFileSync(join(out, 'dog.glb'), smallDog(readFileSync(join(share, 'dog.glb'))));

const bytes = readdirSync(out).reduce((sum, name) => sum + statSync(join(out, name)).size, 0);
console.log(`${out}: ${(bytes / 1e6).toFixed(2)} MB`);
if (bytes > MOST_BYTES) throw new Error(`the page: expected at most ${MOST_BYTES / 1e6} MB`);
