// Morphing by the processor: S = A + sum (w_k - a_k) D_k, where A is where the server says that the
// face is at weights a, and w and a are what is left of weights in each other's company: a blink
// leaves little of what else lids do. What two expressions add where they meet is linear in both.

import type { Packet, Weights } from "./api";

// By an expression others of which it says something.
type Others = Readonly<Record<string, readonly string[]>>;

interface Block {
  readonly start: number;
  readonly data: Float32Array;
  // Eyes turn as they are told, whatever lids do.
  readonly free: boolean;
}

interface Meeting {
  readonly one: string;
  readonly other: string;
  // Of each of the moves, what the two make of it.
  readonly shares: Float32Array;
}

export class Morph {
  readonly positions: Float32Array;
  #anchor: Float32Array;
  #anchorWeights: Weights = {};
  #columns = new Map<string, Block[]>();
  #company: Others = {};
  #blinks: Others = {};
  #meetings: Meeting[] = [];
  // Vertices of the meetings, and where each move takes them.
  #meet: Int32Array = new Int32Array(0);
  #moves: Float32Array[] = [];
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

  setColumns({ header, arrays }: Packet, names: readonly string[]): void {
    const skin = arrays.get("skin") as Float32Array;
    const curves = arrays.get("curves") as Float32Array;
    const shifts = arrays.get("shifts") as Float32Array;
    const last = this.counts.length - 1;
    const parts = header.parts as string[];
    this.#company = header.company as Others;
    this.#blinks = header.blinks as Others;
    const block = (part: number) => 3 * this.counts[part]!;
    names.forEach((name, k) => {
      const blocks: Block[] = [
        { free: false, start: 0, data: skin.subarray(k * block(0), (k + 1) * block(0)) },
        { free: false, start: 3 * this.start(last), data: curves.subarray(k * block(last), (k + 1) * block(last)) },
      ];
      for (let part = 1; part < last; part++) {
        const exact = arrays.get(`${part - 1}:${k}`) as Float32Array | undefined;
        const shift = shifts.subarray(3 * (k * (last - 1) + part - 1)).subarray(0, 3);
        const data = exact ?? (shift.some((x) => x !== 0) ? repeated(shift, this.counts[part]!) : null);
        const free = parts[part - 1]!.endsWith("eyeball");
        if (data) blocks.push({ start: 3 * this.start(part), data, free });
      }
      this.#columns.set(name, blocks);
    });
  }

  setMeetings({ arrays }: Packet, names: readonly string[]): void {
    const pairs = arrays.get("pairs") as Int32Array;
    const cut = (name: string, count: number) => {
      const all = arrays.get(name) as Float32Array;
      const size = count && all.length / count;
      return Array.from({ length: count }, (_, n) => all.subarray(n * size, (n + 1) * size));
    };
    const shares = cut("shares", pairs.length / 2);
    this.#meet = arrays.get("vertices") as Int32Array;
    this.#moves = cut("moves", shares[0]?.length ?? 0);
    this.#meetings = shares.map((own, n) => ({ one: names[pairs[2 * n]!]!, other: names[pairs[2 * n + 1]!]!, shares: own }));
  }

  // Take the server's word for where everything is at these weights.
  anchor(positions: Float32Array, weights: Weights): void {
    this.#anchor.set(positions);
    this.#anchorWeights = weights;
  }

  setExtra(extra: Float32Array | null): void {
    this.#extra = extra;
  }

  update(weights: Weights): void {
    const out = this.positions;
    const before = this.#anchorWeights;
    out.set(this.#anchor);
    const [now, then] = [this.#together(weights), this.#together(before)];
    for (const name of new Set([...Object.keys(weights), ...Object.keys(before)])) {
      const [told, left] = [weights, now].map((of, n) => (of[name] ?? 0) - ([before, then][n]![name] ?? 0)) as [number, number];
      if (told === 0 && left === 0) continue;
      for (const { start, data, free } of this.#columns.get(name) ?? []) {
        const change = free ? told : left;
        for (let i = 0; i < data.length; i++) out[start + i]! += change * data[i]!;
      }
    }
    this.#addMeetings(weights, before);
    const extra = this.#extra;
    if (extra) for (let i = 0; i < extra.length; i++) out[i]! += extra[i]!;
  }

  // What is left of weights in company, as pdeface.controls.together has it.
  #together(weights: Weights): Weights {
    const left: Record<string, number> = { ...weights };
    for (const [name, others] of Object.entries(this.#company)) {
      if (left[name]) left[name] = Math.min(left[name], ...others.map((other) => weights[other] ?? 0));
    }
    for (const [blink, others] of Object.entries(this.#blinks)) {
      for (const other of others) if (left[other]) left[other] *= 1 - (weights[blink] ?? 0);
    }
    return left;
  }

  #addMeetings(weights: Weights, before: Weights): void {
    const out = this.positions;
    const sums = new Float64Array(this.#moves.length);
    for (const { one, other, shares } of this.#meetings) {
      const both = (weights[one] ?? 0) * (weights[other] ?? 0) - (before[one] ?? 0) * (before[other] ?? 0);
      if (both !== 0) shares.forEach((share, n) => (sums[n]! += both * share));
    }
    this.#moves.forEach((move, m) => {
      const share = sums[m]!;
      if (share === 0) return;
      this.#meet.forEach((vertex, n) => {
        for (let k = 0; k < 3; k++) out[3 * vertex + k]! += share * move[3 * n + k]!;
      });
    });
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
