import {badArgument} from './error.js';
import {Nade} from './nade.js';

/** An address, the bytes that are there, or a module that is compiled already. */
export type WasmSource = string | URL | BufferSource | WebAssembly.Module;

/** Loads nade.wasm. Its code is run once, so that the first frame is no slower than the others. */
export async function loadFrom(from: WasmSource): Promise<Nade> {
  const nade = new Nade(await compiled(from));
  warmUp(nade);
  return nade;
}

async function compiled(from: WasmSource): Promise<WebAssembly.Module> {
  if (from instanceof WebAssembly.Module) return from;
  if (typeof from !== 'string' && !(from instanceof URL)) return WebAssembly.compile(from);
  const address = String(from);
  if (address.startsWith('file:')) {
    // Node's fetch reads no files. A name in a variable, so that bundlers leave it alone.
    const files = 'node:fs/promises';
    const {readFile} = await import(/* @vite-ignore */ /* webpackIgnore: true */ files) as
        {readFile(path: URL): Promise<Uint8Array<ArrayBuffer>>};
    return WebAssembly.compile(await readFile(new URL(address)));
  }
  const response = await fetch(address);
  if (!response.ok) throw badArgument(`${address}: expected nade.wasm, found ${response.status}`);
  return WebAssembly.compile(await response.arrayBuffer());
}

/** Engines compile a function when it is first called. */
function warmUp(nade: Nade): void {
  const corrector = nade.corrector();
  const ball = nade.sphere(0.1);
  const hand = nade.restHand('right');
  for (let frame = 0; frame < 8; ++frame) {
    corrector.update('right', hand, ball, 11 * frame,
                     {position: [0, -0.14 + 0.01 * frame, 0]});
  }
  corrector.destroy();
  ball.destroy();
}
