// A colour for each vertex of the skin.

import * as THREE from "three";
import type { Head } from "./head";

export function paint(head: Head, pick: (node: number, colour: THREE.Color) => void): void {
  const { mesh, count } = head.skin;
  let colours = mesh.geometry.getAttribute("color") as THREE.BufferAttribute | undefined;
  if (!colours) {
    colours = new THREE.BufferAttribute(new Float32Array(3 * count), 3);
    mesh.geometry.setAttribute("color", colours);
  }
  const colour = new THREE.Color();
  for (let node = 0; node < count; node++) {
    pick(node, colour);
    colours.setXYZ(node, colour.r, colour.g, colour.b);
  }
  colours.needsUpdate = true;
}

// The colour at a share, 0 to 1, of the way through evenly spaced ones.
export function between(stops: readonly THREE.Color[], share: number, out: THREE.Color): void {
  const at = share * (stops.length - 1);
  const low = Math.min(stops.length - 2, Math.floor(at));
  out.lerpColors(stops[low]!, stops[low + 1]!, at - low);
}
