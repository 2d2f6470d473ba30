// A scan while it is fitted: the scan as a veil, and the face that moves onto it, round by round.

import * as THREE from "three";
import type { Packet } from "./api";
import { veil } from "./scan";
import type { Viewer } from "./viewer";

// Milliseconds from one round to the next.
const ON_ITS_WAY = 260;
// The grid that the server shows: rows and columns, and every so many-th row as a line.
const [ROWS, COLUMNS, LINE] = [55, 46, 2];

export class Fitting {
  rounds = 0;
  #viewer: Viewer;
  #scene = new THREE.Group();
  #from: Float32Array = new Float32Array(0);
  #to: Float32Array = new Float32Array(0);
  #began = 0;
  #face: { skin: THREE.Mesh; at: THREE.BufferAttribute } | null = null;

  constructor(viewer: Viewer) {
    this.#viewer = viewer;
    viewer.scene.add(this.#scene);
  }

  show({ arrays }: Packet): void {
    const vertices = arrays.get("vertices") as Float32Array | undefined;
    if (vertices) {
      this.#scene.add(veil(vertices, arrays.get("triangles") as Int32Array));
      this.#viewer.draw();
    }
    const face = arrays.get("face") as Float32Array | undefined;
    if (face?.length === 3 * ROWS * COLUMNS) this.#move(face);
  }

  // The face that was fitted takes its place.
  end(): void {
    this.#scene.removeFromParent();
    this.#scene.traverse((each) => each instanceof THREE.Mesh && each.geometry.dispose());
    this.#to = new Float32Array(0);
    if (this.#viewer.head) this.#viewer.head.root.visible = true;
    this.#viewer.draw();
  }

  #move(face: Float32Array): void {
    this.rounds++;
    if (!this.#face) {
      this.#face = made(face);
      this.#scene.add(this.#face.skin);
      if (this.#viewer.head) this.#viewer.head.root.visible = false;
    }
    this.#from = (this.#face.at.array as Float32Array).slice();
    this.#to = face;
    const moving = this.#began > 0;
    this.#began = performance.now();
    if (!moving) requestAnimationFrame((now) => this.#step(now));
  }

  #step(now: number): void {
    if (!this.#to.length) return;
    const share = Math.min(1, Math.max(0, (now - this.#began) / ON_ITS_WAY));
    const { skin, at } = this.#face!;
    for (let i = 0; i < at.array.length; i++) at.array[i] = this.#from[i]! + share * (this.#to[i]! - this.#from[i]!);
    at.needsUpdate = true;
    skin.geometry.computeVertexNormals();
    this.#viewer.draw();
    if (share < 1) requestAnimationFrame((next) => this.#step(next));
    else this.#began = 0;
  }
}

// The grid as a surface, with lines along its rows that move with it.
function made(points: Float32Array): { skin: THREE.Mesh; at: THREE.BufferAttribute } {
  const at = new THREE.BufferAttribute(points.slice(), 3);
  const [cells, lines]: [number[], number[]] = [[], []];
  for (let row = 0; row < ROWS; row++) {
    for (let column = 0; column + 1 < COLUMNS; column++) {
      const node = row * COLUMNS + column;
      if (row + 1 < ROWS) cells.push(node, node + COLUMNS, node + 1, node + 1, node + COLUMNS, node + COLUMNS + 1);
      if (row % LINE === 0) lines.push(node, node + 1);
    }
  }
  const surface = new THREE.BufferGeometry().setAttribute("position", at).setIndex(cells);
  surface.computeVertexNormals();
  const skin = new THREE.Mesh(surface, new THREE.MeshStandardMaterial({
    color: 0xe0b183, roughness: 0.7, side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 2,
  }));
  const rows = new THREE.BufferGeometry().setAttribute("position", at).setIndex(lines);
  skin.add(new THREE.LineSegments(rows, new THREE.LineBasicMaterial({ color: 0x5b3413, transparent: true, opacity: 0.7 })));
  skin.frustumCulled = skin.children[0]!.frustumCulled = false;
  return { skin, at };
}
