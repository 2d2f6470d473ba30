// A photo with its feature points (the paper's Fig. 5) and its 7 x 7 mesh (Fig. 6): points are
// dragged, the photo is moved and magnified.

import { api } from "./api";
import { clamp, h } from "./dom";
import { gestures, type Step } from "./gestures";
import type { PhotoInfo, PhotoPoint } from "./schema";

const SVG = "http://www.w3.org/2000/svg";
const LOUPE = 132;
// The loupe shows what is seen this many times as large.
const ZOOM = 3;
const GRID = 5;
const NODES = 7;
// Pixels of the screen: of a point, and how far from it a finger still has it.
const RADIUS = 5.5;
const FINGER = 28;
const CLOSEST = 12;
// Pixels that a pointer may tremble before it moves a point.
const SLOP = { mouse: 0, pen: 1, touch: 4 } as Readonly<Record<string, number>>;
// What is seen at first, in widths of the face's points.
const ROOM = 1.9;

type Spot = readonly [number, number];

export interface PhotoViewActions {
  readonly moved: (points: readonly PhotoPoint[]) => void;
  readonly chosen: (name: string) => void;
}

export class PhotoView {
  readonly element: HTMLElement;
  points: readonly PhotoPoint[] = [];
  #photo: PhotoInfo | null = null;
  // The corner of what is seen and its width, pixels of the photo.
  #seen = { x: 0, y: 0, width: 1 };
  #held: string | null = null;
  // Gives up the point that is held, if it has not been moved.
  #letGo: () => void = () => {};
  #marks = new Map<string, SVGElement>();
  #links = svg("path", { class: "links" });
  #mesh = svg("path", { class: "mesh", id: "mesh" });
  #overlay = svg("svg", {});
  #image = h("img", { alt: "The photo", draggable: "false" });
  #loupe = h("canvas", { class: "loupe", width: LOUPE, height: LOUPE, hidden: true });

  constructor(private actions: PhotoViewActions) {
    this.element = h("div", { class: "photo" }, this.#image, this.#overlay, this.#loupe);
    this.element.addEventListener("pointerdown", (event) => this.#near(event), { capture: true });
    gestures(this.element, () => this.#held === null, (step) => this.#magnified(step));
    this.element.addEventListener("dblclick", (event) => {
      if (!(event.target as Element).matches("circle")) this.turn();
    });
    new ResizeObserver(() => {
      if (this.#photo) this.#look(this.#seen.x, this.#seen.y, this.#seen.width);
    }).observe(this.element);
  }

  show(photo: PhotoInfo): void {
    this.#photo = photo;
    this.points = [...photo.points];
    this.#image.src = api.photoUrl(photo.id);
    this.element.style.setProperty("--aspect", String(photo.width / photo.height));
    this.#overlay.replaceChildren(this.#mesh, this.#links);
    this.#marks.clear();
    for (const { name } of this.points) this.#addMark(name);
    this.drawMesh(photo.mesh);
    this.showFace();
    this.#place();
  }

  // The whole photo where a part of it was seen, and the face where all was.
  turn(): void {
    const { width } = this.#photo!;
    if (this.#seen.width < width) this.#look(0, 0, width);
    else this.showFace();
  }

  // The face with some room around it, which in a large photo may be small.
  showFace(): void {
    const { width, height } = this.#photo!;
    if (!this.points.length) return this.#look(0, 0, width);
    const [xs, ys] = [this.points.map(({ x }) => x), this.points.map(({ y }) => y)];
    const across = Math.max(...xs) - Math.min(...xs);
    const down = ((Math.max(...ys) - Math.min(...ys)) * width) / height;
    const wide = Math.min(width, ROOM * Math.max(across, down));
    const middle = (all: number[]) => (Math.max(...all) + Math.min(...all)) / 2;
    this.#look(middle(xs) - wide / 2, middle(ys) - (wide * height) / width / 2, wide);
  }

  reset(): void {
    this.points = [...this.#photo!.points];
    this.#place();
  }

  // The 7 x 7 nodes of Fig. 6, row after row.
  drawMesh(nodes: PhotoInfo["mesh"]): void {
    this.#mesh.setAttribute("d", lattice(nodes as readonly Spot[], NODES));
  }

  // What is seen of the photo, never beyond its edges.
  #look(x: number, y: number, wide: number): void {
    const { width, height } = this.#photo!;
    const seen = clamp(wide, width / CLOSEST, width);
    const high = (seen * height) / width;
    this.#seen = { x: clamp(x, 0, width - seen), y: clamp(y, 0, height - high), width: seen };
    this.#overlay.setAttribute("viewBox", `${this.#seen.x} ${this.#seen.y} ${seen} ${high}`);
    Object.assign(this.#image.style, {
      width: `${(100 * width) / seen}%`, height: `${(100 * height) / high}%`,
      left: `${(-100 * this.#seen.x) / seen}%`, top: `${(-100 * this.#seen.y) / high}%`,
    });
    for (const mark of this.#marks.values()) mark.setAttribute("r", String(RADIUS * this.#pixel));
  }

  #magnified({ x, y, dx, dy, by }: Step): void {
    const { x: left, y: top, width } = this.#seen;
    const was = this.#pixel;
    const now = clamp(width / by, this.#photo!.width / CLOSEST, this.#photo!.width) / width * was;
    this.#look(left + x * was - (x + dx) * now, top + y * was - (y + dy) * now, (width * now) / was);
  }

  // Pixels of the photo to one of the screen.
  get #pixel(): number {
    return this.#seen.width / (this.#overlay.getBoundingClientRect().width || this.#seen.width);
  }

  #at(event: MouseEvent): Spot {
    const frame = this.#overlay.getBoundingClientRect();
    const pixel = this.#pixel;
    return [this.#seen.x + (event.clientX - frame.left) * pixel, this.#seen.y + (event.clientY - frame.top) * pixel];
  }

  #addMark(name: string): void {
    const mark = svg("circle", { r: 1, tabindex: 0, role: "button", "aria-label": name.replaceAll("_", " "), "data-point": name });
    mark.addEventListener("keydown", (event) => this.#nudge(name, event as KeyboardEvent));
    mark.addEventListener("focus", () => this.actions.chosen(name));
    this.#marks.set(name, mark);
    this.#overlay.append(mark);
  }

  // The point that a pointer is on, or that a finger is near.
  #near(event: PointerEvent): void {
    // A second finger says that the first one did not mean the point, unless that has moved.
    if (this.#held !== null) this.#letGo();
    if (this.#held !== null || event.button !== 0 || !event.isPrimary) return;
    const [x, y] = this.#at(event);
    const reach = (event.pointerType === "mouse" ? RADIUS + 2 : FINGER) * this.#pixel;
    const away = (point: PhotoPoint) => Math.hypot(point.x - x, point.y - y);
    const [nearest] = [...this.points].sort((one, other) => away(one) - away(other));
    if (nearest && away(nearest) < reach) this.#grab(nearest, [x, y], event);
  }

  #grab({ name, x, y }: PhotoPoint, from: Spot, event: PointerEvent): void {
    event.preventDefault();
    const mark = this.#marks.get(name)!;
    mark.focus({ preventScroll: true });
    mark.classList.add("held");
    this.#held = name;
    this.element.setPointerCapture(event.pointerId);
    let moved = false;
    const move = (now: PointerEvent) => {
      if (now.pointerId !== event.pointerId) return;
      moved ||= Math.hypot(now.clientX - event.clientX, now.clientY - event.clientY) > SLOP[event.pointerType]!;
      if (!moved) return;
      const [toX, toY] = this.#at(now);
      // A finger that was beside the point stays beside it.
      this.#move(name, x + toX - from[0], y + toY - from[1], true);
    };
    const end = (now?: PointerEvent) => {
      if (now && now.pointerId !== event.pointerId) return;
      this.#letGo = () => {};
      this.element.removeEventListener("pointermove", move);
      this.element.removeEventListener("lostpointercapture", end);
      mark.classList.remove("held");
      this.#held = null;
      this.#loupe.hidden = true;
    };
    this.element.addEventListener("pointermove", move);
    this.element.addEventListener("lostpointercapture", end);
    this.#letGo = () => moved || end();
  }

  #nudge(name: string, event: KeyboardEvent): void {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (!step) return;
    event.preventDefault();
    const far = (event.shiftKey ? 10 : 1) * Math.max(0.25, this.#photo!.width / 1024);
    const { x, y } = this.points.find((point) => point.name === name)!;
    this.#move(name, x + far * step[0]!, y + far * step[1]!, false);
  }

  #move(name: string, x: number, y: number, loupe: boolean): void {
    const { width, height } = this.#photo!;
    const at = { name, x: clamp(x, 0, width), y: clamp(y, 0, height) };
    this.points = this.points.map((point) => (point.name === name ? at : point));
    this.#place();
    if (loupe) this.#magnify(at);
    this.actions.moved(this.points);
  }

  #place(): void {
    for (const { name, x, y } of this.points) {
      const mark = this.#marks.get(name)!;
      mark.setAttribute("cx", String(x));
      mark.setAttribute("cy", String(y));
    }
    const grid = this.points.slice(0, GRID * GRID).map(({ x, y }): Spot => [x, y]);
    this.#links.setAttribute("d", lattice(grid, GRID));
  }

  // What is under the finger, larger than it is seen, away from where the finger is.
  #magnify({ x, y }: PhotoPoint): void {
    const half = (LOUPE * this.#pixel) / (2 * ZOOM);
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
    this.#loupe.classList.toggle("left", x > this.#seen.x + this.#seen.width / 2);
    this.#loupe.hidden = false;
  }
}

// Lines along rows and columns of points that come row after row.
function lattice(points: readonly Spot[], side: number): string {
  const at = (n: number) => `${points[n]![0]} ${points[n]![1]}`;
  let path = "";
  for (let n = 0; n < points.length; n++) {
    if ((n + 1) % side && n + 1 < points.length) path += `M${at(n)}L${at(n + 1)}`;
    if (n + side < points.length) path += `M${at(n)}L${at(n + side)}`;
  }
  return path;
}

function svg(tag: string, attributes: Record<string, string | number>): SVGElement {
  const element = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  return element;
}
