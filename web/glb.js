// GLB files, as the page is built and tested with them.

const SIZES = {SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT4: 16};
const KINDS = {5121: Uint8Array, 5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array};
const HEADER_BYTES = 28;

/** glTF's JSON, and `read`, which gives the numbers of an accessor. */
export function readGlb(file) {
  const jsonBytes = file.readUInt32LE(12);
  const binary = file.subarray(HEADER_BYTES + jsonBytes);
  const gltf = JSON.parse(file.subarray(20, 20 + jsonBytes).toString());
  const read = (index) => {
    const {bufferView, byteOffset = 0, count, type, componentType} = gltf.accessors[index];
    const from = binary.byteOffset + (gltf.bufferViews[bufferView].byteOffset ?? 0) + byteOffset;
    const Kind = KINDS[componentType];
    const length = count * SIZES[type];
    return new Kind(binary.buffer.slice(from, from + length * Kind.BYTES_PER_ELEMENT));
  };
  return {gltf, read};
}

/** A file with the numbers of `parts`, one for each buffer view of `gltf`. */
export function writeGlb(gltf, parts) {
  let byteOffset = 0;
  const padded = parts.map((part) => {
    const bytes = Buffer.from(part.buffer);
    return Buffer.concat([bytes, Buffer.alloc(-bytes.length & 3)]);
  });
  padded.forEach((part, i) => {
    Object.assign(gltf.bufferViews[i], {buffer: 0, byteOffset, byteLength: parts[i].byteLength});
    byteOffset += part.length;
  });
  gltf.buffers = [{byteLength: byteOffset}];
  const json = Buffer.from(JSON.stringify(gltf));
  const text = Buffer.concat([json, Buffer.alloc(-json.length & 3, ' ')]);
  const number = (...values) => Buffer.from(new Uint32Array(values).buffer);
  return Buffer.concat([
    number(0x46546c67, 2, HEADER_BYTES + text.length + byteOffset), number(text.length, 0x4e4f534a), text,
    number(byteOffset, 0x004e4942), ...padded]);
}
