// A photo and its feature points (the paper's Fig. 5): each can be moved, and the texture that the
// five steps make of them is shown beside it at once.

import { api } from "./api";
import { dialog, download, fileName } from "./dialogs";
import { clamp, h, settled } from "./dom";
import type { TextureWay } from "./api";
import type { PhotoInfo, PhotoPoint } from "./schema";
import type { Studio } from "./studio";
import { toast } from "./toast";

const SVG = "http://www.w3.org/2000/svg";
const LOUPE = 132;
const ZOOM = 4;
const GRID = 5;
const NODES = 7;

function svg(tag: string, attributes: Record<string, string | number>): SVGElement {
  const element = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  return element;
}

export interface PhotoActions {
  readonly add: (files: readonly File[], beside: readonly string[]) => Promise<void>;
  readonly overlay: (photo: PhotoInfo) => void;
}

const WAYS: readonly { way: TextureWay; label: string; what: string }[] = [
  { way: "project", label: "Projected", what: "Read through the fitted face, all photos together: teeth stay off the lips, and what a photo does not show comes from the other side." },
  { way: "warp", label: "Warped", what: "The paper's five steps: the photo's 7 x 7 mesh, warped onto the uv mesh. It is pinned to (u, v): any shape and any expression wears it." },
];

// The photos of one person, their points and what becomes of them.
export class PhotoDesk {
  #photos: readonly PhotoInfo[];
  #photo!: PhotoInfo;
  #way: TextureWay = "project";
  #points: PhotoPoint[] = [];
  #marks = new Map<string, SVGElement>();
  #links = svg("path", { class: "links" });
  #mesh = svg("path", { class: "mesh", id: "mesh" });
  #overlay = svg("svg", {});
  #image = h("img", { alt: "The photo", draggable: "false" });
  #stage: HTMLElement;
  #strip = h("div", { class: "strip", role: "group", "aria-label": "Photos of this person" });
  #ways = new Map<TextureWay, HTMLButtonElement>();
  #what = h("p", {});
  #texture = h("img", { alt: "Texture of the photo", id: "texture" });
  #loupe = h("canvas", { class: "loupe", width: LOUPE, height: LOUPE, hidden: true });
  #name = h("p", { class: "point" });
  #warp = settled(() => void this.#show(), 60);
  #busy = false;
  #box: HTMLDialogElement;

  constructor(
    private studio: Studio,
    photos: readonly PhotoInfo[],
    private actions: PhotoActions,
  ) {
    this.#photos = photos;
    this.#stage = h("div", { class: "photo" }, this.#image, this.#overlay, this.#loupe);
    const ways = h("div", { class: "tabs two", role: "group", "aria-label": "How the texture is made" });
    for (const { way, label, what } of WAYS) {
      const button = h("button", { title: what, onclick: () => this.#choose(way) }, label);
      this.#ways.set(way, button);
      ways.append(button);
    }
    const button = (label: string, act: () => void, more = {}) => h("button", { onclick: act, ...more }, label);
    this.#box = dialog("Photo and its points", "desk",
      h("div", { class: "sides" },
        h("div", { class: "seen" }, this.#stage, this.#strip),
        h("div", { class: "made" }, ways, this.#texture, this.#what, this.#name)),
      h("footer", {},
        button("Save points", () => void this.#keep()),
        button("Points as found", () => this.#reset()),
        h("span", { class: "space" }),
        button("Compare on the stage", () => this.#compare(), { id: "compare" }),
        button("Use this texture", () => void this.#apply(), { class: "primary", id: "apply" })));
    this.#choose("project");
    this.#turnTo(photos[0]!);
  }

  get isOpen(): boolean {
    return this.#box.open;
  }

  // The person has other photos now.
  update(photos: readonly PhotoInfo[]): void {
    const at = photos.find(({ id }) => id === this.#photo.id);
    this.#photos = photos;
    this.#turnTo(at ?? photos[0]!);
  }

  #turnTo(photo: PhotoInfo): void {
    this.#photo = photo;
    this.#points = [...photo.points];
    const { width, height } = photo;
    this.#image.src = api.photoUrl(photo.id);
    this.#overlay.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.#overlay.replaceChildren(this.#mesh, this.#links);
    this.#marks.clear();
    for (const { name } of this.#points) this.#addMark(name, Math.max(width, height) / 110);
    this.#stage.style.setProperty("--aspect", String(width / height));
    this.#fillStrip();
    this.#drawMesh(photo.mesh);
    this.#place();
    this.#say();
    void this.#show();
  }

  #fillStrip(): void {
    const thumb = (photo: PhotoInfo, n: number) =>
      h("button", {
        class: "thumb", "aria-label": `Photo ${n + 1}`, "aria-pressed": String(photo === this.#photo),
        onclick: () => this.#turnTo(photo),
      }, h("img", { src: api.photoUrl(photo.id), alt: "" }));
    const add = h("button", { class: "quiet", id: "add-photo", title: "More photos of the same person: from the sides, say", onclick: () => this.#ask() }, "Add photos…");
    const less = h("button", {
      class: "quiet", title: "Make the face without this photo", disabled: this.#photos.length < 2,
      onclick: () => void this.#without(),
    }, "Leave out");
    this.#strip.replaceChildren(...this.#photos.map(thumb), add, ...(this.#photos.length > 1 ? [less] : []));
  }

  #ask(): void {
    const input = h("input", { type: "file", accept: "image/jpeg,image/png", multiple: true });
    input.addEventListener("change", () => void this.actions.add([...(input.files ?? [])], this.#ids));
    input.click();
  }

  #without(): Promise<void> {
    return this.actions.add([], this.#ids.filter((id) => id !== this.#photo.id));
  }

  #compare(): void {
    this.#box.close();
    this.actions.overlay(this.#photo);
  }

  // The photo that is looked at first: it is the one that is warped.
  get #ids(): string[] {
    const { id } = this.#photo;
    return [id, ...this.#photos.map((photo) => photo.id).filter((other) => other !== id)];
  }

  #choose(way: TextureWay): void {
    this.#way = way;
    for (const [name, button] of this.#ways) button.setAttribute("aria-pressed", String(name === way));
    this.#what.textContent = WAYS.find((each) => each.way === way)!.what;
    this.#stage.classList.toggle("warped", way === "warp");
    if (this.#photo) void this.#show();
  }

  #say(): void {
    const { notes } = this.#photo;
    this.#name.textContent = this.#points.length
      ? "Drag a point, or choose one and use the arrow keys: the texture is warped by them."
      : (notes.at(-1) ?? "");
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
        ((at.clientX - frame.left) / frame.width) * this.#photo.width,
        ((at.clientY - frame.top) / frame.height) * this.#photo.height);
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
    const far = (event.shiftKey ? 10 : 1) * Math.max(0.25, this.#photo.width / 1024);
    const { x, y } = this.#points.find((point) => point.name === name)!;
    this.#move(name, x + far * step[0]!, y + far * step[1]!);
  }

  #move(name: string, x: number, y: number): void {
    const at = { name, x: clamp(x, 0, this.#photo.width), y: clamp(y, 0, this.#photo.height) };
    this.#points = this.#points.map((point) => (point.name === name ? at : point));
    this.#place();
    this.#magnify(at);
    if (this.#way !== "warp") this.#choose("warp");
    this.#warp();
  }

  #reset(): void {
    this.#points = [...this.#photo.points];
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
    this.#links.setAttribute("d", path);
  }

  // The 7 x 7 nodes of Fig. 6, row after row.
  #drawMesh(nodes: PhotoInfo["mesh"]): void {
    const at = (n: number) => `${nodes[n]![0]} ${nodes[n]![1]}`;
    let path = "";
    for (let n = 0; n < nodes.length; n++) {
      if ((n + 1) % NODES) path += `M${at(n)}L${at(n + 1)}`;
      if (n + NODES < nodes.length) path += `M${at(n)}L${at(n + NODES)}`;
    }
    this.#mesh.setAttribute("d", path);
  }

  // What is under the finger, four times as large as on the screen.
  #magnify({ x, y }: PhotoPoint): void {
    const frame = this.#overlay.getBoundingClientRect();
    const scale = frame.width / this.#photo.width;
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
      const warped = this.#way === "warp";
      const blob = await api.texture(this.#ids, this.#way, this.#chosen);
      if (warped) this.#drawMesh((await api.photoMesh(this.#photo.id, this.#chosen)).mesh);
      const old = this.#texture.src;
      this.#texture.src = URL.createObjectURL(blob);
      this.#texture.dataset.way = warped ? "warp" : "project";
      if (old.startsWith("blob:")) URL.revokeObjectURL(old);
      this.#texture.classList.remove("wrong");
      if (warped !== (this.#way === "warp")) this.#warp();
    } catch (error) {
      this.#texture.classList.add("wrong");
      this.#name.textContent = (error as Error).message;
    } finally {
      this.#busy = false;
    }
  }

  async #keep(): Promise<void> {
    try {
      const file = await api.pointsFile(this.#photo.id, this.#chosen);
      download(file, fileName(`${this.studio.doc.name}-points`, ".json"));
    } catch (error) {
      toast(error);
    }
  }

  async #apply(): Promise<void> {
    try {
      const { doc } = this.studio;
      const info = await api.applyTexture(doc.face, this.#ids, this.#way, this.#chosen);
      this.#box.close();
      await this.studio.adopt({ ...info, name: doc.name }, "Texture of the photo", doc.weights);
    } catch (error) {
      toast(error);
    }
  }
}
