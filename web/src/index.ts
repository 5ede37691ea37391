/**
 * nade in a browser, or in Node: keeps a tracked hand on the surface it strokes.
 *
 *   const nade = await load();
 *   const table = nade.plane();
 *   const corrector = nade.corrector();            // one for each hand
 *   const hand = corrector.update('right', joints, table, timeMs);
 *
 * Nothing happens at import.
 */
import {loadFrom} from './load.js';
import type {WasmSource} from './load.js';
import type {Nade} from './nade.js';

export type {WasmSource} from './load.js';
export * from './nade.js';

/** Loads nade.wasm: from beside this file, or from where you have it. */
export function load(from: WasmSource = new URL('./nade.wasm', import.meta.url)): Promise<Nade> {
  return loadFrom(from);
}
