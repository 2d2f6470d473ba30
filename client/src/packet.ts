// Arrays behind a JSON header, all little-endian, as every browser's machine is.

import type { ArrayInfo } from "./schema";

export interface Packet {
  readonly header: Record<string, unknown>;
  readonly arrays: Map<string, Float32Array | Int32Array>;
}

export function unpacked(bytes: ArrayBuffer): Packet {
  const length = new DataView(bytes).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, length)));
  const arrays = new Map<string, Float32Array | Int32Array>();
  for (const info of header.arrays as ArrayInfo[]) {
    const count = info.shape.reduce((product, size) => product * size, 1);
    const Kind = info.type === "int32" ? Int32Array : Float32Array;
    arrays.set(info.name, new Kind(bytes, 4 + length + info.offset, count));
  }
  return { header, arrays };
}
