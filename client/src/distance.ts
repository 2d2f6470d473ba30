// How far the skin is from the scan, as colours: the scale of the library's own reports.

import * as THREE from "three";
import type { Head } from "./head";
import { between, paint } from "./paint";

// Millimetres at which colours are full.
export const FULL = 1;
export const SCALE = ["#edf2eb", "#9ed4bf", "#fac75c", "#db542e", "#6b0a24"] as const;
const STOPS = SCALE.map((c) => new THREE.Color(c));
// Before the first answer, and where the scan has nothing.
const UNMEASURED = new THREE.Color("#c8b8ac");
const UNKNOWN = new THREE.Color("#737378");

export function distanceColours(head: Head, away: Float32Array | null): void {
  const known = away?.length === head.skin.count ? away : null;
  paint(head, (node, colour) => {
    const millimetres = known ? known[node]! : -1;
    if (!known) colour.copy(UNMEASURED);
    else if (millimetres < 0) colour.copy(UNKNOWN);
    else between(STOPS, Math.min(1, millimetres / FULL), colour);
  });
}
