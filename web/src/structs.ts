import {badArgument} from './error.js';
import {FEEL_BYTES, OPTIONS_BYTES, PLACEMENT_BYTES} from './layout.js';
import type {CorrectorOptions, Feel, Method, Placement, Side} from './types.js';
import type {Address, Wasm} from './wasm.js';

const METHODS: readonly Method[] = ['none', 'paper', 'nade'];

export function sideNumber(side: Side): number {
  if (side === 'left') return 0;
  if (side === 'right') return 1;
  throw badArgument(`side: expected 'left' or 'right', found ${String(side)}`);
}

export function expectLength(values: ArrayLike<number>, length: number, name: string): void {
  if (values == null || values.length !== length) {
    throw badArgument(`${name}: expected ${length} numbers, found ${values?.length ?? values}`);
  }
}

export function writePlacement(wasm: Wasm, address: Address, placement: Placement): void {
  const {rotation, position, scale = 1} = placement;
  if (rotation) expectLength(rotation, 4, 'rotation');
  if (position) expectLength(position, 3, 'position');
  const floats = wasm.floats;
  const at = address / 4;
  for (let i = 0; i < 4; ++i) floats[at + i] = rotation ? rotation[i] : i === 3 ? 1 : 0;
  for (let i = 0; i < 3; ++i) floats[at + 4 + i] = position ? position[i] : 0;
  floats[at + 7] = scale;
}

export function withPlacement<Result>(wasm: Wasm, placement: Placement | undefined,
                                      use: (address: Address) => Result): Result {
  if (!placement) return use(0);
  return wasm.with(PLACEMENT_BYTES, (address) => {
    writePlacement(wasm, address, placement);
    return use(address);
  });
}

export function withFeel<Result>(wasm: Wasm, feel: Feel | undefined,
                                 use: (address: Address) => Result): Result {
  if (!feel) return use(0);
  return wasm.with(FEEL_BYTES, (address) => {
    wasm.data.setUint32(address, FEEL_BYTES, true);
    wasm.call('nade_feel_init', address);
    const fields = [feel.softness, feel.softnessDepth, feel.friction, feel.frictionKinetic,
                    feel.longestLag];
    fields.forEach((value, i) => {
      if (value !== undefined) wasm.data.setFloat64(address + 8 + 8 * i, value, true);
    });
    return use(address);
  });
}

export function withOptions<Result>(wasm: Wasm, options: CorrectorOptions,
                                    use: (address: Address) => Result): Result {
  const {method, release, handLength} = options;
  return withFeel(wasm, options.feel, (feel) => wasm.with(OPTIONS_BYTES, (address) => {
    wasm.data.setUint32(address, OPTIONS_BYTES, true);
    wasm.call('nade_corrector_options_init', address);
    if (method !== undefined) {
      const number = METHODS.indexOf(method);
      if (number < 0) throw badArgument(`method: expected none, paper or nade, found ${method}`);
      wasm.data.setInt32(address + 4, number, true);
    }
    if (release !== undefined) wasm.data.setFloat64(address + 8, release, true);
    if (handLength !== undefined) wasm.data.setFloat64(address + 16, handLength, true);
    wasm.data.setUint32(address + 24, feel, true);
    return use(address);
  }));
}
