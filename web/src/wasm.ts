import {NadeError} from './error.js';

export type Address = number;
type Function = (...values: (number | bigint)[]) => number;

/** The module's memory and functions. */
export class Wasm {
  private readonly memory: WebAssembly.Memory;
  private readonly functions: Record<string, Function>;
  private views: {bytes: Uint8Array; data: DataView; floats: Float32Array};
  private printed = '';
  private stopped = false;

  constructor(module: WebAssembly.Module) {
    const imports: Record<string, Record<string, Function>> = {};
    for (const {module: from, name} of WebAssembly.Module.imports(module)) {
      // All that is asked of a system is to print why it stops.
      const call: Function = name === 'fd_write' ? (...values) => this.print(values) : () => 52;
      (imports[from] ??= {})[name] = call;
    }
    const instance = new WebAssembly.Instance(module, imports);
    this.memory = instance.exports.memory as WebAssembly.Memory;
    this.functions = instance.exports as unknown as Record<string, Function>;
    this.views = this.look();
    this.functions._initialize();
  }

  /** Views of the memory as it is now: not to be kept beyond a call, which may make it grow. */
  get bytes(): Uint8Array { return this.now().bytes; }
  get data(): DataView { return this.now().data; }
  get floats(): Float32Array { return this.now().floats; }

  /** Calls a function whose answer is no status. */
  ask(name: string, ...values: (number | bigint)[]): number {
    if (this.stopped) throw new NadeError(-7, `${name}: nade has stopped after a bug; load it anew`);
    this.printed = '';
    try {
      return this.functions[name](...values);
    } catch (error) {
      // What it was in the middle of is half done.
      this.stopped = true;
      throw new NadeError(-7, `${name}: ${this.printed.trim() || (error as Error).message}`);
    }
  }

  /** Calls a function, and throws what it says if it fails. */
  call(name: string, ...values: (number | bigint)[]): void {
    const status = this.ask(name, ...values);
    if (status < 0) throw new NadeError(status, this.text(this.ask('nade_last_error')));
  }

  allocate(bytes: number): Address {
    const address = this.ask('malloc', Math.max(bytes, 8));
    if (address === 0) throw new NadeError(-6, `no memory is left for ${bytes} bytes`);
    this.bytes.fill(0, address, address + bytes);
    return address;
  }
  free(address: Address): void { this.ask('free', address); }

  /** Memory for the time of `use`. */
  with<Result>(bytes: number, use: (address: Address) => Result): Result {
    const address = this.allocate(bytes);
    try {
      return use(address);
    } finally {
      if (!this.stopped) this.free(address);
    }
  }
  /** The numbers as floats, for the time of `use`. */
  withFloats<Result>(values: ArrayLike<number>, use: (address: Address) => Result): Result {
    return this.with(4 * values.length, (address) => {
      this.floats.set(values, address / 4);
      return use(address);
    });
  }

  text(address: Address): string {
    const end = this.bytes.indexOf(0, address);
    return new TextDecoder().decode(this.bytes.slice(address, end));
  }

  private look() {
    const buffer = this.memory.buffer;
    return {bytes: new Uint8Array(buffer), data: new DataView(buffer), floats: new Float32Array(buffer)};
  }
  private now() {
    if (this.views.bytes.length === 0) this.views = this.look();
    return this.views;
  }
  private print([, vectors, count, written]: (number | bigint)[]): number {
    let total = 0;
    for (let i = 0; i < Number(count); ++i) {
      const at = this.data.getUint32(Number(vectors) + 8 * i, true);
      const length = this.data.getUint32(Number(vectors) + 8 * i + 4, true);
      this.printed += new TextDecoder().decode(this.bytes.slice(at, at + length));
      total += length;
    }
    this.data.setUint32(Number(written), total, true);
    return 0;
  }
}
