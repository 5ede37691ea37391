/**
 * `nade` with nade.wasm in it, for places that cannot fetch: a page in one file, a worklet, a
 * sandbox. A third larger than what it has to send otherwise.
 */
import {loadFrom} from './load.js';
import type {Nade} from './nade.js';
import {packedWasm} from './packed_wasm.js';

export * from './nade.js';

/** Loads the nade.wasm of this module. */
export async function load(): Promise<Nade> {
  const packed = Uint8Array.from(atob(packedWasm), (letter) => letter.charCodeAt(0));
  const unpacked = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
  return loadFrom(await new Response(unpacked).arrayBuffer());
}
