// Mean curvature of the skin as colours: blue is hollow, red is round, pale is flat.

import * as THREE from "three";
import { between, paint } from "./paint";
import type { Head } from "./head";

// 1/m at which colours are full: a sphere of 12 mm.
const FULL = 80;
const STOPS = [0x2b5fb4, 0x7fb2e0, 0xe9e4da, 0xeea36f, 0xb63a2b].map((c) => new THREE.Color(c));

export function curvatureColours(head: Head): void {
  const { start, count, index } = head.skin;
  const sum = new Float32Array(count);
  const edges = new Float32Array(count);
  const p = head.morph.positions;
  const n = head.normals;
  for (let t = 0; t < index.length; t += 3) {
    for (let e = 0; e < 3; e++) {
      const a = index[t + e]!;
      const b = index[t + ((e + 1) % 3)]!;
      const i = 3 * (start + a);
      const j = 3 * (start + b);
      let along = 0;
      let square = 0;
      for (let k = 0; k < 3; k++) {
        const step = p[j + k]! - p[i + k]!;
        along += (n[j + k]! - n[i + k]!) * step;
        square += step * step;
      }
      if (square < 1e-14) continue;
      for (const node of [a, b]) {
        sum[node]! += along / square;
        edges[node]! += 1;
      }
    }
  }
  paint(head, (node, colour) => {
    const curvature = edges[node] ? sum[node]! / edges[node]! : 0;
    between(STOPS, (Math.max(-1, Math.min(1, curvature / FULL)) + 1) / 2, colour);
  });
}
