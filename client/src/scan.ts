// The scan that the face was fitted to: how far the face is from it, and the scan itself over it.

import * as THREE from "three";
import { api } from "./api";
import { FULL, SCALE } from "./distance";
import { h } from "./dom";
import { icon } from "./icons";
import type { ScanInfo } from "./schema";
import type { Studio } from "./studio";
import { toast } from "./toast";
import type { Tools } from "./tools";

const VEIL = 0x7fa8d8;

export class ScanView {
  info: ScanInfo | null = null;
  #legend = h("div", { class: "float legend", hidden: true, role: "group", "aria-label": "Distance to the scan" });
  #veil: THREE.Object3D | null = null;
  #asking = false;
  #again = false;

  constructor(
    private studio: Studio,
    private tools: Tools,
    stage: HTMLElement,
  ) {
    stage.append(this.#legend);
    studio.addEventListener("exact", () => void this.#measure());
    studio.addEventListener("shown-otherwise", () => this.#follow());
  }

  // A face has been fitted to a scan: what there is to see of it.
  show(info: ScanInfo): void {
    this.#unveil();
    this.info = info;
    const show = h("button", { class: "quiet", id: "veil", "aria-pressed": "false", title: "The scan itself, over the face", onclick: () => void this.#toggle(show) }, "Show scan");
    const close = h("button", { class: "icon-only", title: "Without the scan", "aria-label": "Without the scan", onclick: () => this.close() }, icon("close"));
    const bar = h("div", { class: "scale", role: "img", "aria-label": `Colours from 0 to ${FULL} millimetre and more` });
    bar.style.background = `linear-gradient(to right, ${SCALE.join(", ")})`;
    const number = (x: number) => x.toFixed(2);
    this.#legend.replaceChildren(
      h("div", { class: "map" }, h("span", {}, "Distance to the scan"), bar,
        h("div", { class: "ticks" }, h("span", {}, "0"), h("span", {}, `${FULL / 2}`), h("span", {}, `${FULL} mm`))),
      h("div", { class: "fit" },
        h("span", { title: "Root mean square over the front of the face" }, `RMS ${number(info.rms)} mm`),
        h("span", {}, `median ${number(info.median)}`),
        h("span", { title: "Share of the face's front that the scan has" }, `${Math.round(100 * info.coverage)} % covered`)),
      show, close);
    this.tools.offer("distance", true);
    this.tools.mode("distance");
    this.#follow();
    void this.#measure();
  }

  close(): void {
    this.#unveil();
    this.info = null;
    if (this.studio.viewer.display?.mode === "distance") this.tools.mode("textured");
    this.tools.offer("distance", false);
    this.#follow();
  }

  #follow(): void {
    const shown = this.info !== null && this.studio.viewer.display?.mode === "distance";
    if (shown && this.#legend.hidden) void this.#measure();
    this.#legend.hidden = this.info === null || !(shown || this.#veil);
  }

  // The latest question wins: the face may have moved on meanwhile.
  async #measure(): Promise<void> {
    const { display, head } = this.studio.viewer;
    if (!this.info || !head || display?.mode !== "distance") return;
    if (this.#asking) {
      this.#again = true;
      return;
    }
    this.#asking = true;
    try {
      const { arrays } = await api.distances(this.info.id, this.studio.shown, head.size, this.studio.seen);
      display.distances = arrays.get("away") as Float32Array;
      display.moved();
      this.studio.viewer.draw();
    } catch (error) {
      toast(error);
    } finally {
      this.#asking = false;
      if (this.#again) {
        this.#again = false;
        void this.#measure();
      }
    }
  }

  async #toggle(button: HTMLElement): Promise<void> {
    if (this.#veil) this.#unveil();
    else if (this.info) {
      try {
        const { arrays } = await api.scan(this.info.id);
        this.#veil = veil(arrays.get("vertices") as Float32Array, arrays.get("triangles") as Int32Array);
        this.studio.viewer.scene.add(this.#veil);
      } catch (error) {
        toast(error);
      }
    }
    button.setAttribute("aria-pressed", String(this.#veil !== null));
    this.#follow();
    this.studio.viewer.draw();
  }

  #unveil(): void {
    this.#veil?.removeFromParent();
    this.#veil = null;
    this.studio.viewer.draw();
  }
}

// A scan that is seen through; a cloud as its points.
export function veil(vertices: Float32Array, triangles: Int32Array): THREE.Object3D {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(vertices, 3));
  if (triangles.length === 0) {
    return new THREE.Points(geometry, new THREE.PointsMaterial({ color: VEIL, size: 0.0012 }));
  }
  geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(triangles), 1));
  geometry.computeVertexNormals();
  const material = new THREE.MeshStandardMaterial({
    color: VEIL, transparent: true, opacity: 0.4, side: THREE.DoubleSide, depthWrite: false, roughness: 0.8,
  });
  return new THREE.Mesh(geometry, material);
}
