// The face in a notebook: the studio's stage and its sliders, as an anywidget.

import type { Packet, Weights } from "./api";
import { h, settled } from "./dom";
import { Head } from "./head";
import { unpacked } from "./packet";
import type { ControlInfo } from "./schema";
import { Viewer } from "./viewer";

// What anywidget hands over: https://anywidget.dev/en/afm
interface Model {
  get(name: string): unknown;
  set(name: string, value: unknown): void;
  save_changes(): void;
  on(event: string, act: (...args: never[]) => void): void;
  off(event: string, act: (...args: never[]) => void): void;
  send(content: unknown): void;
}

const SETTLE = 90;

function bytes(view: unknown): ArrayBuffer {
  const { buffer, byteOffset, byteLength } = view as DataView;
  return buffer.slice(byteOffset, byteOffset + byteLength) as ArrayBuffer;
}

class FaceView {
  #viewer: Viewer;
  #head: Head | null = null;
  #sliders = new Map<string, HTMLInputElement>();
  #refine = settled(() => this.#model.send({ kind: "exact", weights: this.#weights }), SETTLE);
  #model: Model;

  constructor(model: Model, place: HTMLElement) {
    this.#model = model;
    const stage = h("div", { class: "stage" });
    const panel = h("div", { class: "panel" });
    place.classList.add("pdeface-widget");
    place.replaceChildren(stage, panel);
    stage.style.height = panel.style.height = `${model.get("height") as number}px`;
    this.#viewer = new Viewer(stage, () => stage.append(h("p", {}, "The browser can no longer draw in 3D; run the cell again.")));
    this.#fill(panel);
  }

  async begin(): Promise<void> {
    const [rows, columns] = this.#model.get("mesh") as [number, number];
    const [curves, points] = this.#model.get("_curves") as [number, number];
    this.#head = await Head.load(bytes(this.#model.get("_glb")), { rows, columns }, curves, points);
    this.#viewer.show(this.#head);
    const columnsOf = unpacked(bytes(this.#model.get("_columns")));
    this.#head.morph.setColumns(columnsOf, this.#controls.map(({ name }) => name));
    this.follow();
  }

  get #controls(): readonly ControlInfo[] {
    return this.#model.get("_controls") as ControlInfo[];
  }

  get #weights(): Weights {
    return this.#model.get("weights") as Weights;
  }

  // The face as the model's weights say, whoever set them; then exactly, when they are at rest.
  follow = (): void => {
    for (const [name, slider] of this.#sliders) show(slider, this.#weights[name] ?? 0);
    this.#head?.update(this.#weights);
    this.#viewer.display?.moved();
    this.#viewer.draw();
    this.#refine();
  };

  told = (content: { kind: string; weights: Weights }, buffers: DataView[]): void => {
    if (content.kind !== "exact" || !this.#head) return;
    this.#head.anchor(unpacked(bytes(buffers[0])) as Packet, content.weights);
    this.#head.update(this.#weights);
    this.#viewer.draw();
  };

  end(): void {
    this.#head?.dispose();
    this.#viewer.renderer.dispose();
  }

  #fill(panel: HTMLElement): void {
    const search = h("input", { type: "search", placeholder: "Search controls", "aria-label": "Search controls" });
    const groups = new Map<string, HTMLDetailsElement>();
    for (const control of this.#controls) {
      const key = `${control.kind} ${control.group}`;
      let group = groups.get(key);
      if (!group) {
        group = h("details", { open: ["nasal", "mouth"].includes(control.group) }, h("summary", {}, title(control)));
        groups.set(key, group);
      }
      group.append(this.#slider(control));
    }
    search.addEventListener("input", () => filter(groups, search.value));
    panel.append(search, ...groups.values());
  }

  #slider({ name, label, low, high, description }: ControlInfo): HTMLElement {
    const range = h("input", { type: "range", min: low, max: high, step: (high - low) / 200, "data-control": name });
    range.addEventListener("input", () => {
      const { [name]: _, ...others } = this.#weights;
      const value = range.valueAsNumber;
      this.#model.set("weights", value ? { ...others, [name]: value } : others);
      this.#model.save_changes();
    });
    range.addEventListener("dblclick", () => {
      range.value = "0";
      range.dispatchEvent(new Event("input"));
    });
    this.#sliders.set(name, range);
    const number = h("output", {});
    return h("label", { title: `${description} (double-click resets)`, "data-words": `${name} ${label}`.toLowerCase() },
      h("span", {}, label), number, range);
  }
}

function title({ kind, group }: ControlInfo): string {
  const name = group[0]!.toUpperCase() + group.slice(1);
  return kind === "expression" && group !== kind ? `${name}, expression` : name;
}

function show(slider: HTMLInputElement, value: number): void {
  slider.value = String(value);
  slider.parentElement!.querySelector("output")!.value = value.toFixed(2);
  slider.parentElement!.classList.toggle("set", value !== 0);
}

function filter(groups: ReadonlyMap<string, HTMLDetailsElement>, text: string): void {
  const words = text.toLowerCase().split(/\s+/).filter(Boolean);
  for (const group of groups.values()) {
    const labels = [...group.querySelectorAll<HTMLElement>("label")];
    for (const label of labels) label.hidden = !words.every((word) => label.dataset.words!.includes(word));
    group.hidden = labels.every(({ hidden }) => hidden);
    if (words.length) group.open = true;
  }
}

async function render({ model, el }: { model: Model; el: HTMLElement }): Promise<() => void> {
  const view = new FaceView(model, el);
  model.on("change:weights", view.follow);
  model.on("msg:custom", view.told);
  await view.begin();
  return () => {
    model.off("change:weights", view.follow);
    model.off("msg:custom", view.told);
    view.end();
  };
}

export default { render };
