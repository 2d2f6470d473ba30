// The photo behind the face, seen from where the photo was taken: how near the face comes to it.

import * as THREE from "three";
import { api } from "./api";
import { h } from "./dom";
import { gestures, type Step } from "./gestures";
import { icon } from "./icons";
import type { PhotoInfo } from "./schema";
import type { Studio } from "./studio";
import type { Stand } from "./viewer";

const NEAR = 0.05;
const FAR = 10;
// The face takes this part of the stage at first.
const PART = 0.72;

export class Overlay implements Stand {
  readonly camera = new THREE.PerspectiveCamera();
  #photos: readonly PhotoInfo[] = [];
  #photo: PhotoInfo | null = null;
  #image = h("img", { class: "behind", alt: "The photo behind the face", draggable: "false", hidden: true });
  #bar = h("div", { class: "float sculpt", id: "overlay", hidden: true, role: "group", "aria-label": "Photo behind the face" });
  #opacity = h("input", { type: "range", min: 0, max: 1, step: 0.01, value: 0.6, id: "opacity", "aria-label": "Opacity of the face" });
  #does = h("button", { "aria-pressed": "true", title: "The face does what it does in the photo", onclick: () => this.#toggle() }, "Its expression");
  // Pixels of the stage to one of the photo, and where the photo's corner is on the stage.
  #zoom = 1;
  #corner = [0, 0] as [number, number];
  #size = [1, 1] as [number, number];

  constructor(
    private studio: Studio,
    stage: HTMLElement,
  ) {
    const { canvas } = studio.viewer;
    stage.insertBefore(this.#image, canvas);
    stage.append(this.#bar);
    this.#opacity.addEventListener("input", () => this.#fade());
    gestures(canvas, () => this.open && !studio.holding, (step) => this.#move(step));
  }

  get open(): boolean {
    return this.#photo !== null;
  }

  show(photos: readonly PhotoInfo[], photo: PhotoInfo): void {
    this.#photos = photos;
    this.#photo = photo;
    this.#image.src = api.photoUrl(photo.id);
    this.#image.hidden = this.#bar.hidden = false;
    const close = h("button", { class: "icon-only", title: "Without the photo (O)", "aria-label": "Without the photo", onclick: () => this.leave() }, icon("close"));
    this.#bar.replaceChildren(...this.#others(), h("label", { for: "opacity" }, "Face"), this.#opacity, this.#does, close);
    this.#point(photo);
    this.studio.viewer.stand = this;
    this.fit();
    this.#wear();
    this.#fade();
  }

  leave(): void {
    if (!this.#photo) return;
    this.#photo = null;
    this.#image.hidden = this.#bar.hidden = true;
    this.studio.viewer.canvas.style.opacity = "";
    this.studio.viewer.stand = null;
    this.studio.wear({});
  }

  // The face in the middle of the stage.
  fit(): void {
    const { camera } = this.#photo!;
    const [width, height] = this.#size;
    const [x, y] = camera.centre as [number, number];
    this.#zoom = (PART * Math.min(width, height)) / (0.25 * camera.scale);
    this.#corner = [width / 2 - this.#zoom * x, height / 2 - this.#zoom * y];
    this.#place();
  }

  resize(width: number, height: number): void {
    const [x, y] = this.#corner;
    const [before, above] = this.#size;
    const grown = height / above;
    this.#zoom *= grown;
    this.#corner = [(x - before / 2) * grown + width / 2, y * grown];
    this.#size = [width, height];
    if (this.#photo) this.#place();
  }

  // Where a point of the photo is on the stage, for tests.
  onStage(x: number, y: number): [number, number] {
    return [this.#corner[0] + this.#zoom * x, this.#corner[1] + this.#zoom * y];
  }

  #others(): HTMLElement[] {
    if (this.#photos.length < 2) return [];
    const choice = h("select", { "aria-label": "Which photo" },
      ...this.#photos.map((photo, n) => h("option", { value: n, selected: photo === this.#photo }, `Photo ${n + 1}`)));
    choice.addEventListener("change", () => this.show(this.#photos, this.#photos[Number(choice.value)]!));
    return [choice];
  }

  #toggle(): void {
    const on = this.#does.getAttribute("aria-pressed") !== "true";
    this.#does.setAttribute("aria-pressed", String(on));
    this.#wear();
  }

  #wear(): void {
    const on = this.#does.getAttribute("aria-pressed") === "true";
    this.studio.wear(on && this.#photo ? this.#photo.expression : {});
  }

  #fade(): void {
    this.#opacity.style.setProperty("--to", `${100 * this.#opacity.valueAsNumber}%`);
    this.studio.viewer.canvas.style.opacity = this.#opacity.value;
  }

  // Y = R X, seen from (0, 0, d): the camera stands at R' (0, 0, d), turned by R'.
  #point({ camera }: PhotoInfo): void {
    const [a, b, c, d, e, f, g, i, j] = camera.rotation as number[];
    const turn = new THREE.Matrix4().set(a!, d!, g!, 0, b!, e!, i!, 0, c!, f!, j!, 0, 0, 0, 0, 1);
    this.camera.quaternion.setFromRotationMatrix(turn);
    this.camera.position.set(0, 0, camera.distance).applyMatrix4(turn);
    this.camera.updateMatrixWorld();
  }

  // The photo on the stage, and a projection that has the face where the photo has it.
  #place(): void {
    const { width, height, camera } = this.#photo!;
    const [x, y] = this.#corner;
    const zoom = this.#zoom;
    Object.assign(this.#image.style, {
      left: `${x}px`, top: `${y}px`, width: `${zoom * width}px`, height: `${zoom * height}px`,
    });
    const focal = zoom * camera.scale * camera.distance;
    const [middle, level] = [x + zoom * camera.centre[0]!, y + zoom * camera.centre[1]!];
    const [wide, high] = this.#size;
    const at = (pixels: number) => (NEAR * pixels) / focal;
    this.camera.projectionMatrix.makePerspective(
      at(-middle), at(wide - middle), at(level), at(level - high), NEAR, FAR,
    );
    this.camera.projectionMatrixInverse.copy(this.camera.projectionMatrix).invert();
    this.studio.viewer.draw();
  }

  #move({ x, y, dx, dy, by }: Step): void {
    this.#zoom *= by;
    this.#corner = [x + by * (this.#corner[0] - x) + dx, y + by * (this.#corner[1] - y) + dy];
    this.#place();
  }
}
