/** nade.wasm, by gzip and in base64. `scripts/web package` writes it. */
export const packedWasm: string;
