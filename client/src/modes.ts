// The ways in which the face is shown.

import * as THREE from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { curvatureColours } from "./curvature";
import { distanceColours } from "./distance";
import { clamp } from "./dom";
import type { Head } from "./head";

export const MODES = [
  { name: "textured", label: "Textured" },
  { name: "shaded", label: "Shaded" },
  { name: "curvature", label: "Curvature" },
  { name: "wireframe", label: "Wireframe" },
  { name: "uvmesh", label: "UV mesh" },
  { name: "curves", label: "Curves" },
  // Shown where there is a scan.
  { name: "distance", label: "Distance" },
] as const;

export type Mode = (typeof MODES)[number]["name"];

const CLAY = { skin: 0xc8b8ac, eye: 0xe9e4dc, teeth: 0xe6dfd2 } as Record<string, number>;
const INK = { dark: 0x9fc4ff, light: 0x2458a8 };
const FILL = { dark: 0x232a35, light: 0xdfe3ea };

export class Display {
  mode: Mode = "textured";
  // Boundary curves over whatever else is shown.
  overlay = false;
  // Millimetres from each vertex of the skin to the scan, -1 where it has none.
  distances: Float32Array | null = null;
  #lines: LineSegments2 | null = null;
  #theme: "dark" | "light" = "dark";
  readonly #clay = new Map<string, THREE.MeshStandardMaterial>();
  readonly #curvature = standard({ vertexColors: true, roughness: 0.85 });
  readonly #wire = new THREE.LineBasicMaterial({ transparent: true });
  readonly #fill = standard({ roughness: 0.9 });
  readonly #line = new LineMaterial({ linewidth: 1.6, worldUnits: false });
  readonly #hidden = new THREE.MeshBasicMaterial({ colorWrite: false, depthWrite: false });
  #grid: THREE.LineSegments | null = null;

  constructor(private head: Head) {
    for (const material of [this.#fill, this.#curvature]) pushBack(material);
    this.apply();
  }

  setHead(head: Head): void {
    this.#forgetLines();
    this.head = head;
    this.apply();
  }

  set theme(theme: "dark" | "light") {
    this.#theme = theme;
    this.apply();
  }

  apply(): void {
    const { mode, head } = this;
    for (const primitive of head.primitives) {
      primitive.mesh.material = this.#material(primitive.kind, primitive.own, mode);
    }
    this.#wire.color.setHex(INK[this.#theme]);
    // Fine meshes have so many lines that full ones would leave no form to see.
    this.#wire.opacity = clamp(6000 / head.skin.count + 0.25, 0.4, 0.9);
    this.#fill.color.setHex(FILL[this.#theme]);
    this.#line.color.setHex(mode === "curves" ? INK[this.#theme] : 0xffc56b);
    this.#forgetLines();
    if (mode === "wireframe") {
      this.#grid = new THREE.LineSegments(cells(head), this.#wire);
      this.#grid.frustumCulled = false;
      head.skin.mesh.add(this.#grid);
    }
    if (mode === "curves" || mode === "uvmesh" || this.overlay) this.#addLines();
    this.moved();
  }

  // Vertices have moved: what is drawn from them follows.
  moved(): void {
    if (this.mode === "curvature") curvatureColours(this.head);
    if (this.mode === "distance") distanceColours(this.head, this.distances);
    if (this.#lines) this.#lines.geometry.setPositions(this.#segments());
  }

  // Whether what is seen is a picture, which has its own light.
  get wearsPhoto(): boolean {
    const own = this.head.skin.own as THREE.MeshStandardMaterial;
    return (this.mode === "textured" || this.mode === "uvmesh") && own.map !== null;
  }

  resize(width: number, height: number): void {
    this.#line.resolution.set(width, height);
  }

  #material(kind: string, own: THREE.Material, mode: Mode): THREE.Material {
    pushBack(own);
    if (mode === "textured" || mode === "uvmesh") return own;
    if (mode === "shaded") return this.#clayOf(kind);
    if (kind === "skin") {
      return {
        curvature: this.#curvature, distance: this.#curvature, wireframe: this.#fill, curves: this.#fill,
      }[mode];
    }
    if (mode === "curvature" || mode === "distance") return this.#clayOf(kind);
    return kind === "eye" ? this.#fill : this.#hidden;
  }

  #clayOf(kind: string): THREE.MeshStandardMaterial {
    let material = this.#clay.get(kind);
    if (!material) {
      material = standard({ color: CLAY[kind] ?? 0x9a837a, roughness: kind === "eye" ? 0.35 : 0.62 });
      pushBack(material);
      this.#clay.set(kind, material);
    }
    return material;
  }

  #addLines(): void {
    this.#lines = new LineSegments2(new LineSegmentsGeometry(), this.#line);
    this.#lines.frustumCulled = false;
    this.#line.linewidth = this.mode === "uvmesh" && !this.overlay ? 1 : 1.7;
    this.head.skin.mesh.add(this.#lines);
  }

  #forgetLines(): void {
    // The skin's own vertices stay with the skin.
    this.#grid?.geometry.deleteAttribute("position");
    for (const object of [this.#lines, this.#grid]) {
      object?.removeFromParent();
      object?.geometry.dispose();
    }
    this.#lines = this.#grid = null;
  }

  // Rows of the mesh that lie on the boundary curves; for the uv mesh, columns as well.
  #segments(): Float32Array {
    const { rows, columns } = this.head.size;
    // A mesh coarser than its curves shows some of them.
    const { curves } = this.head;
    const across = steps(rows, rows >= curves ? curves - 1 : 27);
    const down = this.mode === "uvmesh" && !this.overlay ? steps(columns, 40) : [];
    const used = this.#usedNodes();
    const found: number[] = [];
    const add = (a: number, b: number) => used[a] && used[b] && found.push(a, b);
    for (const row of across) {
      for (let j = 0; j + 1 < columns; j++) add(row * columns + j, row * columns + j + 1);
    }
    for (const column of down) {
      for (let i = 0; i + 1 < rows; i++) add(i * columns + column, (i + 1) * columns + column);
    }
    const positions = this.head.morph.positions;
    const out = new Float32Array(3 * found.length);
    found.forEach((node, i) => out.set(positions.subarray(3 * node, 3 * node + 3), 3 * i));
    return out;
  }

  // Nodes inside an opening belong to no triangle.
  #usedNodes(): Uint8Array {
    const used = new Uint8Array(this.head.skin.count);
    const { index } = this.head.skin;
    for (let i = 0; i < index.length; i++) used[index[i]!] = 1;
    return used;
  }
}

// The sides of the mesh's cells, each once, without the diagonals that make triangles of them; they
// move with the skin's own vertices.
function cells({ skin, size: { columns } }: Head): THREE.BufferGeometry {
  const { index, count } = skin;
  const seen = new Set<number>();
  for (let t = 0; t < index.length; t++) {
    const [a, b] = [index[t]!, index[t % 3 === 2 ? t - 2 : t + 1]!];
    const step = Math.abs(a - b);
    if (step === 1 || step === columns) seen.add(Math.min(a, b) * count + Math.max(a, b));
  }
  const ends = new Uint32Array(2 * seen.size);
  let at = 0;
  for (const side of seen) {
    ends[at++] = Math.floor(side / count);
    ends[at++] = side % count;
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", skin.mesh.geometry.getAttribute("position"));
  return geometry.setIndex(new THREE.BufferAttribute(ends, 1));
}

// About `parts` + 1 lines through `count` nodes, both ends among them.
function steps(count: number, parts: number): number[] {
  const kept = new Set<number>();
  for (let i = 0; i <= parts; i++) kept.add(Math.round((i * (count - 1)) / parts));
  return [...kept];
}

function standard(options: THREE.MeshStandardMaterialParameters): THREE.MeshStandardMaterial {
  return new THREE.MeshStandardMaterial({ metalness: 0, side: THREE.DoubleSide, ...options });
}

// Lines on a surface are drawn in front of it.
function pushBack(material: THREE.Material): void {
  material.polygonOffset = true;
  material.polygonOffsetFactor = 1;
  material.polygonOffsetUnits = 2;
}
