const CODES: Record<number, string> = {
  [-1]: 'argument', [-2]: 'handle', [-3]: 'size', [-4]: 'id', [-5]: 'data', [-6]: 'memory',
  [-7]: 'internal',
};

/** A call that failed; it has changed nothing. The message is a sentence that names the argument. */
export class NadeError extends Error {
  override readonly name = 'NadeError';
  /** The nade_status of nade.h. */
  readonly status: number;
  /** `argument`, `handle`, `size`, `id`, `data`, `memory` or `internal`. */
  readonly code: string;

  constructor(status: number, sentence: string) {
    super(sentence);
    this.status = status;
    this.code = CODES[status] ?? 'internal';
  }
}

export function badArgument(sentence: string): NadeError {
  return new NadeError(-1, sentence);
}
