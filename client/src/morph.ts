// Linear morphing by the processor: S = A + sum (w_k - a_k) D_k, where A is where the server says
// that the face is at weights a. With a = 0 this is base plus displacements.

import type { Packet, Weights } from "./api";

interface Block {
  readonly start: number;
  readonly data: Float32Array;
}

export class Morph {
  readonly positions: Float32Array;
  #anchor: Float32Array;
  #anchorWeights: Weights = {};
  #columns = new Map<string, Block[]>();
  // While a handle is dragged: displacements of vertices that no control stands for.
  #extra: Float32Array | null = null;

  // counts: vertices of skin, parts and curves; the arrays hold three numbers for each.
  constructor(
    readonly counts: readonly number[],
    base: Float32Array,
  ) {
    this.#anchor = base.slice();
    this.positions = base.slice();
  }

  get ready(): boolean {
    return this.#columns.size > 0;
  }

  get anchorWeights(): Weights {
    return this.#anchorWeights;
  }

  start(part: number): number {
    return this.counts.slice(0, part).reduce((sum, count) => sum + count, 0);
  }

  setColumns({ arrays }: Packet, names: readonly string[]): void {
    const skin = arrays.get("skin") as Float32Array;
    const curves = arrays.get("curves") as Float32Array;
    const shifts = arrays.get("shifts") as Float32Array;
    const last = this.counts.length - 1;
    const block = (part: number) => 3 * this.counts[part]!;
    names.forEach((name, k) => {
      const blocks: Block[] = [
        { start: 0, data: skin.subarray(k * block(0), (k + 1) * block(0)) },
        { start: 3 * this.start(last), data: curves.subarray(k * block(last), (k + 1) * block(last)) },
      ];
      for (let part = 1; part < last; part++) {
        const exact = arrays.get(`${part - 1}:${k}`) as Float32Array | undefined;
        const shift = shifts.subarray(3 * (k * (last - 1) + part - 1)).subarray(0, 3);
        const data = exact ?? (shift.some((x) => x !== 0) ? repeated(shift, this.counts[part]!) : null);
        if (data) blocks.push({ start: 3 * this.start(part), data });
      }
      this.#columns.set(name, blocks);
    });
  }

  // Take the server's word for where everything is at these weights.
  anchor(positions: Float32Array, weights: Weights): void {
    this.#anchor.set(positions);
    this.#anchorWeights = weights;
  }

  setExtra(extra: Float32Array | null): void {
    this.#extra = extra;
  }

  // Whether anything differs from the last call.
  update(weights: Weights): void {
    const out = this.positions;
    out.set(this.#anchor);
    const names = new Set([...Object.keys(weights), ...Object.keys(this.#anchorWeights)]);
    for (const name of names) {
      const change = (weights[name] ?? 0) - (this.#anchorWeights[name] ?? 0);
      if (change === 0) continue;
      for (const { start, data } of this.#columns.get(name) ?? []) {
        for (let i = 0; i < data.length; i++) out[start + i]! += change * data[i]!;
      }
    }
    const extra = this.#extra;
    if (extra) for (let i = 0; i < extra.length; i++) out[i]! += extra[i]!;
  }
}

function repeated(shift: Float32Array, count: number): Float32Array {
  const data = new Float32Array(3 * count);
  for (let i = 0; i < count; i++) data.set(shift, 3 * i);
  return data;
}

// (3 n) unit normals of vertices, by the area of the triangles around each.
export function triangleNormals(
  positions: Float32Array,
  start: number,
  count: number,
  index: ArrayLike<number>,
  out: Float32Array,
): void {
  out.fill(0, 3 * start, 3 * (start + count));
  for (let t = 0; t < index.length; t += 3) {
    const a = 3 * (start + index[t]!);
    const b = 3 * (start + index[t + 1]!);
    const c = 3 * (start + index[t + 2]!);
    const ax = positions[a]!, ay = positions[a + 1]!, az = positions[a + 2]!;
    const ux = positions[b]! - ax, uy = positions[b + 1]! - ay, uz = positions[b + 2]! - az;
    const vx = positions[c]! - ax, vy = positions[c + 1]! - ay, vz = positions[c + 2]! - az;
    const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    out[a]! += nx; out[a + 1]! += ny; out[a + 2]! += nz;
    out[b]! += nx; out[b + 1]! += ny; out[b + 2]! += nz;
    out[c]! += nx; out[c + 1]! += ny; out[c + 2]! += nz;
  }
  for (let i = 3 * start; i < 3 * (start + count); i += 3) {
    const length = Math.hypot(out[i]!, out[i + 1]!, out[i + 2]!) || 1;
    out[i]! /= length;
    out[i + 1]! /= length;
    out[i + 2]! /= length;
  }
}
