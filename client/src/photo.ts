// A photo and its feature points (the paper's Fig. 5): each can be moved, and the texture that the
// five steps make of them is shown beside it at once.

import { api } from "./api";
import { dialog, download, fileName } from "./dialogs";
import { clamp, h, settled } from "./dom";
import type { PhotoInfo, PhotoPoint } from "./schema";
import type { Studio } from "./studio";
import { toast } from "./toast";

const SVG = "http://www.w3.org/2000/svg";
const LOUPE = 132;
const ZOOM = 4;
const GRID = 5;

function svg(tag: string, attributes: Record<string, string | number>): SVGElement {
  const element = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  return element;
}

export function photoDialog(studio: Studio, photo: PhotoInfo): void {
  new PhotoDesk(studio, photo);
}

class PhotoDesk {
  #points: PhotoPoint[];
  #marks = new Map<string, SVGElement>();
  #lines = svg("path", { class: "links" });
  #overlay: SVGElement;
  #image: HTMLImageElement;
  #texture = h("img", { alt: "Texture made of the points", id: "texture" });
  #loupe = h("canvas", { class: "loupe", width: LOUPE, height: LOUPE, hidden: true });
  #name = h("p", { class: "point" }, "Drag a point, or choose one and use the arrow keys.");
  #warp = settled(() => void this.#show(), 60);
  #busy = false;

  constructor(
    private studio: Studio,
    private photo: PhotoInfo,
  ) {
    this.#points = [...photo.points];
    const { width, height } = photo;
    this.#image = h("img", { src: api.photoUrl(photo.id), alt: "The photo", draggable: "false" });
    this.#overlay = svg("svg", { viewBox: `0 0 ${width} ${height}` });
    this.#overlay.append(this.#lines);
    const radius = Math.max(width, height) / 110;
    for (const { name } of this.#points) this.#addMark(name, radius);
    const stage = h("div", { class: "photo" }, this.#image, this.#overlay, this.#loupe);
    stage.style.setProperty("--aspect", String(width / height));
    const apply = h("button", { class: "primary", id: "apply" }, "Use this texture");
    const reset = h("button", { onclick: () => this.#reset() }, "Points as found");
    const keep = h("button", { onclick: () => void this.#keep() }, "Save points");
    const box = dialog("Photo and its points", "desk",
      h("div", { class: "sides" }, stage,
        h("div", { class: "made" }, this.#texture, this.#name,
          h("p", {}, "The texture by the paper's five steps. It is pinned to (u, v): any shape and any expression wears it."))),
      h("footer", {}, keep, h("span", { class: "space" }), reset, apply));
    apply.addEventListener("click", () => void this.#apply(box));
    this.#place();
    void this.#show();
  }

  #addMark(name: string, radius: number): void {
    const mark = svg("circle", { r: radius, tabindex: 0, role: "button", "aria-label": name.replaceAll("_", " "), "data-point": name });
    mark.addEventListener("pointerdown", (event) => this.#grab(name, mark, event as PointerEvent));
    mark.addEventListener("keydown", (event) => this.#nudge(name, event as KeyboardEvent));
    mark.addEventListener("focus", () => (this.#name.textContent = name.replaceAll("_", " ")));
    this.#marks.set(name, mark);
    this.#overlay.append(mark);
  }

  #grab(name: string, mark: SVGElement, event: PointerEvent): void {
    event.preventDefault();
    mark.focus();
    mark.setPointerCapture(event.pointerId);
    const move = (at: PointerEvent) => {
      const frame = this.#overlay.getBoundingClientRect();
      this.#move(name,
        ((at.clientX - frame.left) / frame.width) * this.photo.width,
        ((at.clientY - frame.top) / frame.height) * this.photo.height);
    };
    const end = () => {
      mark.removeEventListener("pointermove", move);
      this.#loupe.hidden = true;
    };
    mark.addEventListener("pointermove", move);
    mark.addEventListener("lostpointercapture", end, { once: true });
  }

  #nudge(name: string, event: KeyboardEvent): void {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (!step) return;
    event.preventDefault();
    const far = (event.shiftKey ? 10 : 1) * Math.max(0.25, this.photo.width / 1024);
    const { x, y } = this.#points.find((point) => point.name === name)!;
    this.#move(name, x + far * step[0]!, y + far * step[1]!);
  }

  #move(name: string, x: number, y: number): void {
    const at = { name, x: clamp(x, 0, this.photo.width), y: clamp(y, 0, this.photo.height) };
    this.#points = this.#points.map((point) => (point.name === name ? at : point));
    this.#place();
    this.#magnify(at);
    this.#warp();
  }

  #reset(): void {
    this.#points = [...this.photo.points];
    this.#place();
    this.#warp();
  }

  #place(): void {
    for (const { name, x, y } of this.#points) {
      const mark = this.#marks.get(name)!;
      mark.setAttribute("cx", String(x));
      mark.setAttribute("cy", String(y));
    }
    const at = (n: number) => `${this.#points[n]!.x} ${this.#points[n]!.y}`;
    let path = "";
    for (let n = 0; n < Math.min(GRID * GRID, this.#points.length); n++) {
      if ((n + 1) % GRID) path += `M${at(n)}L${at(n + 1)}`;
      if (n + GRID < GRID * GRID) path += `M${at(n)}L${at(n + GRID)}`;
    }
    this.#lines.setAttribute("d", path);
  }

  // What is under the finger, four times as large as on the screen.
  #magnify({ x, y }: PhotoPoint): void {
    const frame = this.#overlay.getBoundingClientRect();
    const scale = frame.width / this.photo.width;
    const half = LOUPE / (2 * ZOOM * scale);
    const pen = this.#loupe.getContext("2d")!;
    pen.fillStyle = "#000";
    pen.fillRect(0, 0, LOUPE, LOUPE);
    pen.drawImage(this.#image, x - half, y - half, 2 * half, 2 * half, 0, 0, LOUPE, LOUPE);
    pen.strokeStyle = "#ffffffcc";
    pen.beginPath();
    pen.moveTo(LOUPE / 2, LOUPE / 2 - 14);
    pen.lineTo(LOUPE / 2, LOUPE / 2 + 14);
    pen.moveTo(LOUPE / 2 - 14, LOUPE / 2);
    pen.lineTo(LOUPE / 2 + 14, LOUPE / 2);
    pen.stroke();
    const right = x * scale > frame.width / 2;
    this.#loupe.classList.toggle("left", right);
    this.#loupe.hidden = false;
  }

  get #chosen(): Record<string, readonly number[]> {
    return Object.fromEntries(this.#points.map(({ name, x, y }) => [name, [x, y]]));
  }

  async #show(): Promise<void> {
    if (this.#busy) {
      this.#warp();
      return;
    }
    this.#busy = true;
    try {
      const url = URL.createObjectURL(await api.warp(this.photo.id, this.#chosen));
      const old = this.#texture.src;
      this.#texture.src = url;
      if (old.startsWith("blob:")) URL.revokeObjectURL(old);
      this.#texture.classList.remove("wrong");
    } catch (error) {
      this.#texture.classList.add("wrong");
      this.#name.textContent = (error as Error).message;
    } finally {
      this.#busy = false;
    }
  }

  async #keep(): Promise<void> {
    try {
      const file = await api.pointsFile(this.photo.id, this.#chosen);
      download(file, fileName(`${this.studio.doc.name}-points`, ".json"));
    } catch (error) {
      toast(error);
    }
  }

  async #apply(box: HTMLDialogElement): Promise<void> {
    try {
      const { doc } = this.studio;
      const info = await api.applyPhoto(this.photo.id, doc.face, this.#chosen);
      box.close();
      await this.studio.adopt({ ...info, name: doc.name }, "Texture of the photo", doc.weights);
    } catch (error) {
      toast(error);
    }
  }
}
