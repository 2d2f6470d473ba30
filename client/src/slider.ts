// One control: its name, a range, its number.

import { clamp, h } from "./dom";
import { markButtons, showMarks } from "./mark_buttons";
import type { ControlInfo } from "./schema";
import type { Studio } from "./studio";

export class Slider {
  readonly element: HTMLElement;
  #range: HTMLInputElement;
  #number: HTMLInputElement;
  #title: HTMLLabelElement;

  constructor(
    private studio: Studio,
    readonly control: ControlInfo,
  ) {
    const { name, label, low, high, description } = control;
    const step = (high - low) / 200;
    this.#range = h("input", { type: "range", min: low, max: high, step, id: `c-${name}` });
    this.#number = h("input", {
      type: "number", min: low, max: high, step: 10 * step, "aria-label": `${label}, exact value`,
    });
    const title = h("label", { for: `c-${name}`, title: `${description} (double-click resets)` }, label);
    this.#title = title;
    this.element = h("div", { class: "slider", "data-control": name },
      title, markButtons(studio.marks, label, () => this.names), this.#number, this.#range);
    this.#range.addEventListener("input", () => this.#set(this.#range.valueAsNumber, false));
    this.#range.addEventListener("change", () => this.#set(this.#range.valueAsNumber, true));
    this.#number.addEventListener("change", () => this.#set(this.#number.valueAsNumber || 0, true));
    for (const target of [title, this.#range]) {
      target.addEventListener("dblclick", (event) => {
        event.preventDefault();
        this.#set(0, true);
      });
    }
    this.show();
  }

  // The controls that move with this slider.
  get names(): string[] {
    return Object.keys(this.studio.paired(this.control.name, 0));
  }

  matches(words: readonly string[]): boolean {
    const text = `${this.control.name} ${this.control.label} ${this.control.group}`.toLowerCase();
    return words.every((word) => text.includes(word));
  }

  // Where both sides move together, the left one stands for both.
  get isSecond(): boolean {
    const { name, mirror } = this.control;
    return this.studio.symmetric && mirror !== null && name.endsWith("Right");
  }

  show(): void {
    const { name, low, high, label, mirror } = this.control;
    const both = this.studio.symmetric && mirror !== null;
    this.#title.textContent = both ? label.replace(/ left$/, "") : label;
    const value = this.studio.doc.weights[name] ?? 0;
    const { marks } = this.studio;
    const locked = marks.has("lock", name);
    this.#range.disabled = this.#number.disabled = locked;
    const silent = value !== 0 && marks.heard({ [name]: value })[name] === undefined;
    this.element.classList.toggle("silent", silent || marks.has("mute", name));
    showMarks(this.element, marks, this.names);
    this.#range.value = String(value);
    if (document.activeElement !== this.#number) this.#number.value = value.toFixed(2);
    this.element.classList.toggle("set", value !== 0);
    const at = (x: number) => (100 * (x - low)) / (high - low);
    const [from, to] = [Math.min(at(value), at(0)), Math.max(at(value), at(0))];
    this.#range.style.setProperty("--from", `${from}%`);
    this.#range.style.setProperty("--to", `${to}%`);
  }

  #set(value: number, ended: boolean): void {
    const { name, label, low, high } = this.control;
    const changes = this.studio.paired(name, clamp(value, low, high));
    this.studio.preview(changes);
    if (ended) {
      this.studio.commit(label);
      this.#number.value = (this.studio.doc.weights[name] ?? 0).toFixed(2);
    }
  }
}
