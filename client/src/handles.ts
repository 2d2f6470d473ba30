// The data points of the boundary curves as handles: hover, drag, with falloff and symmetry.

import * as THREE from "three";
import { api, type Packet } from "./api";
import { h } from "./dom";
import { icon } from "./icons";
import type { Studio } from "./studio";
import { toast } from "./toast";

// Pixels around a handle: a finger is broader than a pointer.
const REACH = { mouse: 11, pen: 16, touch: 26 } as Readonly<Record<string, number>>;
// Pixels that a metre farther behind counts as when a handle is chosen.
const PER_METRE = 400;
const COLOURS = { rest: new THREE.Color(0x8fb7ff), hover: new THREE.Color(0xffc56b) };

// Round dots, a little nearer than the skin that they lie on; those held are larger.
const VERTEX = `
attribute vec3 color;
uniform float size;
varying vec3 vColour;
void main() {
  vColour = color;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  gl_Position.z -= 0.0006 * gl_Position.w;
  gl_PointSize = size * (1.0 + 0.6 * smoothstep(0.6, 1.0, color.r));
}`;
const FRAGMENT = `
varying vec3 vColour;
void main() {
  float away = length(gl_PointCoord - 0.5);
  if (away > 0.5) discard;
  gl_FragColor = vec4(away > 0.34 ? vec3(0.06, 0.08, 0.12) : vColour, 1.0);
  #include <colorspace_fragment>
}`;

interface Place {
  readonly curve: number;
  readonly point: number;
}

interface Drag {
  readonly pointer: number;
  readonly place: Place;
  readonly start: THREE.Vector3;
  readonly plane: THREE.Plane;
  readonly handles: [number, number, number][];
  // Whether the other side makes the mirrored move.
  readonly mirrored: boolean;
  response: Packet | null;
  by: THREE.Vector3;
}

export class Handles {
  on = false;
  #radius = 2;
  // A point alone, or its curve as a whole.
  #whole = false;
  #points: THREE.Points | null = null;
  #hover: Place | null = null;
  #drag: Drag | null = null;
  #hint = h("span", { class: "hint" }, "Drag a point");
  #box: HTMLElement;

  constructor(
    private studio: Studio,
    stage: HTMLElement,
  ) {
    const { canvas } = studio.viewer;
    canvas.addEventListener("pointermove", (event) => this.#moved(event));
    // Before the orbit hears of it.
    canvas.addEventListener("pointerdown", (event) => this.#grab(event), { capture: true });
    canvas.addEventListener("pointerup", (event) => this.#drag?.pointer === event.pointerId && void this.#drop());
    canvas.addEventListener("pointercancel", (event) => this.#drag?.pointer === event.pointerId && this.#cancel());
    const radius = h("input", {
      type: "range", min: 0, max: 6, step: 0.5, value: 2, id: "falloff", "aria-label": "Falloff",
    });
    const show = () => {
      this.#radius = radius.valueAsNumber;
      radius.style.setProperty("--to", `${(100 * this.#radius) / 6}%`);
      this.studio.viewer.draw();
    };
    radius.addEventListener("input", show);
    const close = h("button", { class: "icon-only", title: "Without the points (D)", "aria-label": "Close sculpting", onclick: () => this.toggle() }, icon("close"));
    this.#box = h("div", { class: "float sculpt", hidden: true, role: "group", "aria-label": "Sculpt" },
      this.#hint,
      this.#choice(), h("label", { for: "falloff" }, "Falloff"), radius, close);
    stage.append(this.#box);
    show();
    studio.addEventListener("shown", () => this.#rebuild());
    for (const moment of ["live", "exact"]) studio.addEventListener(moment, () => this.#place());
  }

  #choice(): HTMLElement {
    const ways = [
      { whole: false, label: "Point", what: "Drag a point; its neighbours along and across curves follow" },
      { whole: true, label: "Curve", what: "Drag a curve as a whole; the curves beside it follow" },
    ];
    const buttons = ways.map(({ whole, label, what }) =>
      h("button", {
        title: what, "aria-pressed": String(whole === this.#whole),
        onclick: () => {
          this.#whole = whole;
          this.#hint.textContent = `Drag a ${label.toLowerCase()}`;
          buttons.forEach((button, n) => button.setAttribute("aria-pressed", String(ways[n]!.whole === whole)));
        },
      }, label));
    return h("span", { class: "cluster", role: "group", "aria-label": "What is dragged" }, ...buttons);
  }

  toggle(): void {
    this.on = !this.on;
    this.#box.hidden = !this.on;
    this.studio.tellDoors();
    this.#rebuild();
    const { display } = this.studio.viewer;
    if (display) {
      display.overlay = this.on;
      display.apply();
      this.studio.dispatchEvent(new Event("shown-otherwise"));
    }
    this.studio.viewer.draw();
  }

  // Screen position of a handle, for tests and for picking.
  screen({ curve, point }: Place): { x: number; y: number; depth: number } {
    const { viewer, head } = this.studio;
    const at = this.#world({ curve, point });
    const frame = viewer.canvas.getBoundingClientRect();
    const depth = at.distanceTo(viewer.eye.position);
    at.project(viewer.eye);
    return {
      x: frame.left + ((at.x + 1) / 2) * frame.width,
      y: frame.top + ((1 - at.y) / 2) * frame.height,
      depth: head ? depth : Infinity,
    };
  }

  get #half(): number {
    return this.studio.info.points / 2;
  }

  #index({ curve, point }: Place): number {
    const { morph } = this.studio.head!;
    return morph.start(morph.counts.length - 1) + curve * this.studio.info.points + point;
  }

  #world(place: Place): THREE.Vector3 {
    const { head } = this.studio;
    const at = new THREE.Vector3().fromArray(head!.morph.positions, 3 * this.#index(place));
    return head!.skin.mesh.localToWorld(at);
  }

  #rebuild(): void {
    this.#points?.removeFromParent();
    this.#points?.geometry.dispose();
    this.#points = null;
    const { head, info } = this.studio;
    if (!this.on || !head) return;
    const count = info.curves * this.#half;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * count), 3));
    geometry.setAttribute("color", new THREE.BufferAttribute(new Float32Array(3 * count), 3));
    const size = 7 * this.studio.viewer.renderer.getPixelRatio();
    const material = new THREE.ShaderMaterial({
      uniforms: { size: { value: size } }, vertexShader: VERTEX, fragmentShader: FRAGMENT,
    });
    this.#points = new THREE.Points(geometry, material);
    this.#points.frustumCulled = false;
    head.skin.mesh.add(this.#points);
    this.#place();
  }

  #place(): void {
    const { head, info } = this.studio;
    if (!this.#points || !head) return;
    const positions = this.#points.geometry.getAttribute("position") as THREE.BufferAttribute;
    const colours = this.#points.geometry.getAttribute("color") as THREE.BufferAttribute;
    const held = this.#drag?.place ?? this.#hover;
    const shares = new Map(held ? this.#shares(held).map(([c, p, w]) => [c * this.#half + p, w]) : []);
    const colour = new THREE.Color();
    for (let curve = 0; curve < info.curves; curve++) {
      for (let point = 0; point < this.#half; point++) {
        const n = curve * this.#half + point;
        const from = 3 * this.#index({ curve, point });
        positions.array.set(head.morph.positions.subarray(from, from + 3), 3 * n);
        colour.lerpColors(COLOURS.rest, COLOURS.hover, shares.get(n) ?? 0);
        colours.setXYZ(n, colour.r, colour.g, colour.b);
      }
    }
    positions.needsUpdate = colours.needsUpdate = true;
  }

  // Handles around one, and the share of its move that each makes, along and across curves.
  #shares({ curve, point }: Place): [number, number, number][] {
    const { curves } = this.studio.info;
    const found: [number, number, number][] = [];
    if (this.#whole) return this.#across(curve);
    const reach = Math.ceil(2 * this.#radius);
    for (let c = Math.max(0, curve - reach); c <= Math.min(curves - 1, curve + reach); c++) {
      for (let p = Math.max(0, point - reach); p <= Math.min(this.#half - 1, point + reach); p++) {
        const share = this.#share(Math.hypot(c - curve, p - point));
        if (share > 0.01) found.push([c, p, share]);
      }
    }
    return found;
  }

  // All points of a curve, and of its neighbours the less the farther they are.
  #across(curve: number): [number, number, number][] {
    const found: [number, number, number][] = [];
    for (let c = 0; c < this.studio.info.curves; c++) {
      const share = this.#share(c - curve);
      for (let p = 0; share > 0.01 && p < this.#half; p++) found.push([c, p, share]);
    }
    return found;
  }

  #share(steps: number): number {
    const away = Math.abs(steps) / Math.max(this.#radius, 0.01);
    return away < 2 ? (1 - (away / 2) ** 2) ** 2 : 0;
  }

  #pick(event: PointerEvent): Place | null {
    const { info, viewer, head } = this.studio;
    if (!head) return null;
    let best: Place | null = null;
    let nearest = Infinity;
    const reach = REACH[event.pointerType] ?? 11;
    for (let curve = 0; curve < info.curves; curve++) {
      for (let point = 0; point < this.#half; point++) {
        const place = { curve, point };
        const { x, y, depth } = this.screen(place);
        const away = Math.hypot(x - event.clientX, y - event.clientY);
        // Of handles near the pointer the nearest, but none on the far side.
        if (away < reach && away + PER_METRE * depth < nearest) {
          nearest = away + PER_METRE * depth;
          best = place;
        }
      }
    }
    viewer.canvas.style.cursor = best ? "grab" : "";
    return best;
  }

  #moved(event: PointerEvent): void {
    if (this.#drag) {
      if (event.pointerId === this.#drag.pointer) this.#pull(event);
      return;
    }
    if (!this.on || event.buttons || event.pointerType === "touch") return;
    const hover = this.#pick(event);
    if (hover?.curve === this.#hover?.curve && hover?.point === this.#hover?.point) return;
    this.#hover = hover;
    this.#place();
    this.studio.viewer.draw();
  }

  #grab(event: PointerEvent): void {
    if (!this.on || event.button !== 0) return;
    // A second finger neither turns the face nor takes another handle while one is held.
    if (this.#drag) {
      event.stopImmediatePropagation();
      return;
    }
    const place = this.#pick(event);
    if (!place) return;
    event.stopImmediatePropagation();
    const { viewer, doc, size, symmetric } = this.studio;
    viewer.canvas.setPointerCapture(event.pointerId);
    const towards = viewer.eye.getWorldDirection(new THREE.Vector3());
    const plane = new THREE.Plane().setFromNormalAndCoplanarPoint(towards, this.#world(place));
    // Where the pointer is, which need not be on the handle: nothing jumps.
    const start = this.#under(event, plane);
    if (!start) return;
    // A whole curve has both sides in it already.
    const mirrored = symmetric && !this.#whole;
    const drag: Drag = {
      pointer: event.pointerId, place, start, plane, mirrored, handles: this.#shares(place), response: null, by: new THREE.Vector3(),
    };
    this.#drag = drag;
    this.studio.holding = true;
    this.#place();
    viewer.draw();
    api.response(doc.face, size, drag.handles, mirrored).then(
      (response) => {
        drag.response = response;
        if (this.#drag === drag) this.#bend();
      },
      (error: unknown) => {
        toast(error);
        this.#cancel();
      },
    );
  }

  #pull(event: PointerEvent): void {
    const drag = this.#drag!;
    const hit = this.#under(event, drag.plane);
    if (!hit) return;
    drag.by = hit.sub(drag.start);
    // What lies on the middle stays there where both sides move together.
    const middle = !drag.mirrored || 2 * drag.place.point === this.#half - 1;
    if (this.studio.symmetric && middle) drag.by.x = 0;
    // Where both sides reach the handle that is held, it is to follow the pointer all the same.
    const also = drag.mirrored ? this.#share(this.#half - 1 - 2 * drag.place.point) : 0;
    drag.by.y /= 1 + also;
    drag.by.z /= 1 + also;
    this.#bend();
  }

  // Where on a plane the pointer is.
  #under(event: PointerEvent, plane: THREE.Plane): THREE.Vector3 | null {
    const { viewer } = this.studio;
    const frame = viewer.canvas.getBoundingClientRect();
    const at = new THREE.Vector2(
      (2 * (event.clientX - frame.left)) / frame.width - 1,
      1 - (2 * (event.clientY - frame.top)) / frame.height,
    );
    const ray = new THREE.Raycaster();
    ray.setFromCamera(at, viewer.eye);
    return ray.ray.intersectPlane(plane, new THREE.Vector3());
  }

  // The surface is linear in its curves: the move times the response, no server asked.
  #bend(): void {
    const { response, by } = this.#drag!;
    const { head } = this.studio;
    if (!response || !head) return;
    const extra = new Float32Array(head.morph.positions.length);
    const add = (from: number, array: Float32Array) => {
      for (let i = 0; i < array.length; i += 3) {
        extra[from + i] = array[i]! * by.x;
        extra[from + i + 1] = array[i + 1]! * by.y;
        extra[from + i + 2] = array[i + 2]! * by.z;
      }
    };
    add(0, response.arrays.get("skin") as Float32Array);
    add(3 * head.morph.start(head.morph.counts.length - 1), response.arrays.get("curves") as Float32Array);
    head.morph.setExtra(extra);
    this.studio.redraw();
    this.#place();
  }

  #cancel(): void {
    this.#drag = null;
    this.studio.holding = false;
    this.studio.head?.morph.setExtra(null);
    this.studio.redraw();
    this.#place();
  }

  async #drop(): Promise<void> {
    const drag = this.#drag;
    if (!drag) return;
    this.#drag = null;
    const { x, y, z } = drag.by;
    if (Math.hypot(x, y, z) < 1e-6) {
      this.#cancel();
      return;
    }
    const moves = drag.handles.map(([c, p, w]) => [c, p, w * x, w * y, w * z]);
    if (drag.mirrored) {
      for (const [c, p, w] of drag.handles) moves.push([c, this.#half - 1 - p, -w * x, w * y, w * z]);
    }
    try {
      const { doc } = this.studio;
      const info = await api.edit(doc.face, moves);
      this.studio.holding = false;
      await this.studio.adopt({ ...info, name: doc.name }, `Curve ${drag.place.curve + 1}`, doc.weights);
    } catch (error) {
      toast(error);
      this.#cancel();
    }
  }
}
