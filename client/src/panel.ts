// The controls: three kinds, their groups, a search, and what concerns a kind as a whole.

import { h } from "./dom";
import { icon } from "./icons";
import { markButtons, showMarks } from "./mark_buttons";
import { Slider } from "./slider";
import type { Studio } from "./studio";

const KINDS = [
  { kind: "shape", label: "Shape", hint: "Who it is, by the bones of the skull" },
  { kind: "identity", label: "Identity", hint: "Who it is, by how heads differ" },
  { kind: "expression", label: "Expression", hint: "What it does" },
] as const;

const OPEN_AT_FIRST = new Set(["nasal", "mandible", "identity", "eyes", "mouth"]);

export class Panel {
  #sliders: Slider[];
  #groups: { box: HTMLElement; element: HTMLDetailsElement; kind: string; sliders: Slider[] }[] = [];
  #kind: string = "shape";
  #search: HTMLInputElement;
  #unmark: HTMLButtonElement;
  #tabs = new Map<string, HTMLButtonElement>();
  #foot = h("div", { class: "foot" });
  #empty = h("p", { class: "empty", hidden: true }, "No control is called that.");

  constructor(
    private studio: Studio,
    place: HTMLElement,
    private blend: () => void,
  ) {
    this.#sliders = studio.schema.controls.map((control) => new Slider(studio, control));
    this.#search = h("input", {
      type: "search", placeholder: "Search controls", "aria-label": "Search controls", id: "search",
    });
    this.#search.addEventListener("input", () => this.#filter());
    const tabs = h("div", { class: "tabs", role: "tablist", "aria-label": "Kinds of controls" });
    for (const { kind, label, hint } of KINDS) {
      const tab = h("button", { role: "tab", title: hint, onclick: () => this.choose(kind) }, label);
      this.#tabs.set(kind, tab);
      tabs.append(tab);
    }
    const list = h("div", { class: "list" }, ...this.#buildGroups(), this.#empty);
    this.#unmark = h("button", {
      class: "quiet", id: "unmark", hidden: true, title: "No control muted, solo or locked",
      onclick: () => studio.marks.clear(),
    }, "Unmark");
    const search = h("div", { class: "search" }, icon("search"), this.#search, this.#unmark);
    place.append(h("div", { class: "head" }, tabs, search), list, this.#foot);
    for (const moment of ["live", "marks"]) studio.addEventListener(moment, () => this.#show());
    studio.addEventListener("marks", () => (this.#unmark.hidden = !studio.marks.any));
    this.choose("shape");
  }

  choose(kind: string): void {
    this.#kind = kind;
    for (const [name, tab] of this.#tabs) tab.setAttribute("aria-selected", String(name === kind));
    this.#buildFoot();
    this.#filter();
  }

  focusSearch(): void {
    this.#search.focus();
    this.#search.select();
  }

  #buildGroups(): HTMLElement[] {
    const { studio } = this;
    return studio.schema.groups.map((group) => {
      const own = this.#sliders.filter(
        ({ control }) => control.group === group.name && control.kind === group.kind,
      );
      const element = h(
        "details",
        { class: "group", open: OPEN_AT_FIRST.has(group.name) },
        h("summary", {}, group.label, h("span", { class: "count" })),
        ...own.map((slider) => slider.element),
      );
      // Beside what opens and closes the group, not in it: a button in a button is none.
      const marks = markButtons(studio.marks, group.label, () => own.map(({ control }) => control.name));
      const box = h("div", { class: "box" }, element, marks);
      this.#groups.push({ box, element, kind: group.kind, sliders: own });
      return box;
    });
  }

  #buildFoot(): void {
    const { studio } = this;
    const button = (label: string, act: () => void, title = "", name = "") =>
      h("button", { onclick: act, title }, name ? icon(name) : null, label);
    const reset = (kinds: string[], label: string) => () => {
      const zero: Record<string, number> = {};
      for (const c of studio.schema.controls) if (kinds.includes(c.kind)) zero[c.name] = 0;
      studio.commit(label, zero);
    };
    const children: HTMLElement[] = [];
    if (this.#kind === "expression") {
      const choice = h("select", { "aria-label": "Preset expression", id: "preset" },
        h("option", { value: "" }, "Preset…"),
        ...studio.schema.presets.map(({ name, label }) => h("option", { value: name }, label)));
      choice.addEventListener("change", () => {
        const preset = studio.schema.presets.find(({ name }) => name === choice.value);
        choice.value = "";
        if (!preset) return;
        const zero: Record<string, number> = {};
        for (const c of studio.schema.controls) if (c.kind === "expression") zero[c.name] = 0;
        studio.commit(preset.label, { ...zero, ...preset.weights });
      });
      children.push(choice, button("Reset expression", reset(["expression"], "Reset expression")));
      if (!studio.symmetric) children.push(button("L to R", () => this.#copy(), "Copy the left side to the right"));
    } else {
      children.push(
        button("Random", () => studio.commit("Random face", this.#random()), "Someone new (R)", "dice"),
        button("Blend", () => this.blend(), "Blend with another face, a .pdeface file"),
        button("Reset shape", reset(["shape", "identity"], "Reset shape")),
      );
    }
    const symmetry = h("button", {
      class: "toggle", id: "symmetry", title: "Both sides move together (Y)",
      "aria-pressed": String(studio.symmetric), "aria-label": "Symmetry",
      onclick: () => this.toggleSymmetry(),
    }, icon("symmetry"));
    this.#foot.replaceChildren(...children, symmetry);
  }

  #copy(): void {
    const changes: Record<string, number> = {};
    for (const { name, mirror } of this.studio.schema.controls) {
      if (mirror && name.endsWith("Left")) changes[mirror] = this.studio.doc.weights[name] ?? 0;
    }
    this.studio.commit("Copy left to right", changes);
  }

  toggleSymmetry(): void {
    this.studio.symmetric = !this.studio.symmetric;
    this.#buildFoot();
    this.#filter();
  }

  randomFace(): void {
    this.studio.commit("Random face", this.#random());
  }

  // Each identity mode normally distributed and at most three deviations, as pdeface.random.
  #random(): Record<string, number> {
    const weights: Record<string, number> = {};
    for (const { name, kind, low, high } of this.studio.schema.controls) {
      if (kind !== "identity") continue;
      const [one, two] = [1 - Math.random(), Math.random()];
      const normal = Math.sqrt(-2 * Math.log(one)) * Math.cos(2 * Math.PI * two);
      weights[name] = Number(Math.min(high, Math.max(low, normal)).toFixed(3));
    }
    return weights;
  }

  #filter(): void {
    const words = this.#search.value.toLowerCase().split(/\s+/).filter(Boolean);
    let any = false;
    for (const { box, element, kind, sliders } of this.#groups) {
      let found = 0;
      for (const slider of sliders) {
        const wanted = words.length ? slider.matches(words) : kind === this.#kind;
        const seen = wanted && (!slider.isSecond || words.includes("right"));
        slider.element.hidden = !seen;
        found += Number(seen);
      }
      box.hidden = found === 0;
      if (words.length && found) element.open = true;
      any ||= found > 0;
    }
    this.#empty.hidden = any;
    this.#show();
  }

  #show(): void {
    const { weights } = this.studio.doc;
    for (const { box, element, sliders } of this.#groups) {
      if (box.hidden) continue;
      const set = sliders.filter((s) => weights[s.control.name] && !s.isSecond).length;
      element.querySelector(".count")!.textContent = set ? String(set) : "";
      showMarks(box, this.studio.marks, sliders.map((s) => s.control.name));
      for (const slider of sliders) if (!slider.element.hidden) slider.show();
    }
  }
}
