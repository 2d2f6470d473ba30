// The face in the scene: the GLB's meshes, whose vertices are moved by Morph.

import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import type { Packet, Size, Weights } from "./api";
import { Morph, triangleNormals } from "./morph";

export interface Primitive {
  readonly mesh: THREE.Mesh;
  readonly kind: string;
  readonly start: number;
  readonly count: number;
  readonly index: ArrayLike<number>;
  readonly own: THREE.Material;
}

export class Head {
  readonly primitives: Primitive[];
  readonly morph: Morph;
  readonly normals: Float32Array;
  // Turns about the neck.
  readonly pivot: THREE.Object3D;
  #anchorNormals: Float32Array;
  #anchorFlat: Float32Array;
  #flat: Float32Array;

  private constructor(
    readonly root: THREE.Group,
    readonly size: Size,
    readonly curves: number,
    curvePoints: number,
  ) {
    const meshes: THREE.Mesh[] = [];
    root.traverse((node) => node instanceof THREE.Mesh && meshes.push(node));
    const counts = meshes.map((mesh) => mesh.geometry.getAttribute("position").count);
    const total = counts.reduce((sum, count) => sum + count, 0);
    const base = new Float32Array(3 * (total + curvePoints));
    this.normals = new Float32Array(3 * total);
    let start = 0;
    this.primitives = meshes.map((mesh, i) => {
      const material = mesh.material as THREE.Material;
      const primitive = {
        mesh,
        kind: i === 0 ? "skin" : material.name,
        start,
        count: counts[i]!,
        index: mesh.geometry.getIndex()!.array,
        own: material,
      };
      base.set(mesh.geometry.getAttribute("position").array, 3 * start);
      this.normals.set(mesh.geometry.getAttribute("normal").array, 3 * start);
      mesh.frustumCulled = false;
      start += counts[i]!;
      return primitive;
    });
    this.morph = new Morph([...counts, curvePoints], base);
    for (const { mesh, start: s, count } of this.primitives) {
      const view = (array: Float32Array) =>
        new THREE.BufferAttribute(array.subarray(3 * s, 3 * (s + count)), 3).setUsage(
          THREE.DynamicDrawUsage,
        );
      mesh.geometry.setAttribute("position", view(this.morph.positions));
      mesh.geometry.setAttribute("normal", view(this.normals));
    }
    this.#anchorNormals = this.normals.slice();
    this.#flat = new Float32Array(3 * total);
    this.#shade(this.#flat);
    this.#anchorFlat = this.#flat.slice();
    this.pivot = root.getObjectByName("head") ?? root;
  }

  static async load(glb: ArrayBuffer, size: Size, curves: number, points: number): Promise<Head> {
    const { scene } = await new GLTFLoader().parseAsync(glb, "");
    return new Head(scene, size, curves, curves * points);
  }

  get skin(): Primitive {
    return this.primitives[0]!;
  }

  // Positions at these weights, with normals that turn as the triangles do.
  update(weights: Weights): void {
    this.morph.update(weights);
    this.#shade(this.#flat);
    const out = this.normals;
    for (let i = 0; i < out.length; i++) {
      out[i] = this.#anchorNormals[i]! + this.#flat[i]! - this.#anchorFlat[i]!;
    }
    this.#refresh();
  }

  // Where the server says that everything is, with the surface's own normals.
  anchor({ arrays }: Packet, weights: Weights): void {
    const positions = arrays.get("positions") as Float32Array;
    this.morph.anchor(positions.subarray(0, this.morph.positions.length), weights);
    this.morph.update(weights);
    this.#anchorNormals.set(arrays.get("normals") as Float32Array);
    this.#shade(this.#anchorFlat);
  }

  dispose(): void {
    for (const { mesh, own } of this.primitives) {
      mesh.geometry.dispose();
      own.dispose();
    }
  }

  #shade(out: Float32Array): void {
    for (const { start, count, index } of this.primitives) {
      triangleNormals(this.morph.positions, start, count, index, out);
    }
  }

  #refresh(): void {
    for (const { mesh } of this.primitives) {
      mesh.geometry.getAttribute("position").needsUpdate = true;
      mesh.geometry.getAttribute("normal").needsUpdate = true;
    }
  }
}
