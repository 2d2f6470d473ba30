// What floats on the stage: how the face is shown, from where, and how finely.

import type { Join } from "./api";
import { h } from "./dom";
import { icon } from "./icons";
import { MODES, type Mode } from "./modes";
import type { Studio } from "./studio";
import type { View } from "./viewer";

const VIEW_LABELS: [View, string, string][] = [
  ["front", "Front", "1"],
  ["threeQuarter", "Three-quarter", "2"],
  ["profile", "Left side", "3"],
  ["otherProfile", "Right side", "4"],
];

export class Tools {
  #modes = new Map<Mode, HTMLButtonElement>();
  #curves: HTMLButtonElement;
  #projection: HTMLButtonElement;
  #compare: HTMLButtonElement;
  #density: HTMLSelectElement;

  constructor(
    private studio: Studio,
    stage: HTMLElement,
  ) {
    const { viewer, schema } = studio;
    const modes = h("div", { class: "float modes", role: "group", "aria-label": "How it is shown" });
    MODES.forEach(({ name, label }) => {
      const button = h("button", { onclick: () => this.mode(name), title: `${label} (M for the next)` }, label);
      button.hidden = name === "distance";
      this.#modes.set(name, button);
      modes.append(button);
    });
    const views = h("div", { class: "float views", role: "group", "aria-label": "From where" });
    for (const [view, label, key] of VIEW_LABELS) {
      views.append(h("button", { title: `${label} (${key})`, onclick: () => viewer.look(view) }, label));
    }
    this.#curves = h("button", { class: "icon-only", title: "Boundary curves on top (C)", "aria-label": "Boundary curves on top", onclick: () => this.curves() }, icon("curves"));
    this.#projection = h("button", { class: "icon-only", title: "Perspective or orthographic (P)", "aria-label": "Orthographic", onclick: () => this.projection() }, icon("projection"));
    this.#compare = h("button", {
      class: "icon-only", title: "Before and after (B)", "aria-label": "Before and after",
      onclick: () => studio.compare(!studio.comparing),
    }, icon("compare"));
    const fit = h("button", { class: "icon-only", title: "Fit (F)", "aria-label": "Fit", onclick: () => viewer.fit() }, icon("fit"));
    views.append(h("span", { class: "rule" }), fit, this.#projection, this.#curves, this.#compare);
    this.#density = h("select", { "aria-label": "Density of the mesh", id: "density", title: "Density of the mesh" },
      ...schema.densities.map(({ label }, i) => h("option", { value: i }, label)));
    this.#density.value = String(schema.densities.findIndex((d) => d.rows === studio.size.rows));
    const join = h("select", { "aria-label": "Join of the patches", id: "join", title: "How the surface goes on from patch to patch" },
      h("option", { value: "smooth" }, "Smooth"), h("option", { value: "patchwise" }, "Patchwise"));
    const mesh = () => {
      const { rows, columns } = schema.densities[Number(this.#density.value)]!;
      void studio.setSize({ rows, columns, join: join.value as Join });
    };
    for (const choice of [this.#density, join]) choice.addEventListener("change", mesh);
    modes.append(h("span", { class: "rule" }), this.#density, join);
    stage.append(views, modes);
    for (const moment of ["shown", "shown-otherwise"]) studio.addEventListener(moment, () => this.#show());
    this.#show();
  }

  mode(name: Mode): void {
    const { display } = this.studio.viewer;
    if (!display) return;
    display.mode = name;
    display.apply();
    this.studio.viewer.draw();
    this.#show();
    this.studio.dispatchEvent(new Event("shown-otherwise"));
  }

  nextMode(): void {
    const offered = MODES.filter(({ name }) => !this.#modes.get(name)!.hidden);
    const at = offered.findIndex(({ name }) => name === this.studio.viewer.display?.mode);
    this.mode(offered[(at + 1) % offered.length]!.name);
  }

  offer(name: Mode, offered: boolean): void {
    this.#modes.get(name)!.hidden = !offered;
  }

  curves(): void {
    const { display } = this.studio.viewer;
    if (!display) return;
    display.overlay = !display.overlay;
    display.apply();
    this.studio.viewer.draw();
    this.#show();
  }

  projection(): void {
    this.studio.viewer.orthographic = !this.studio.viewer.orthographic;
    this.#show();
  }

  #show(): void {
    const { display, orthographic } = this.studio.viewer;
    for (const [name, button] of this.#modes) {
      button.setAttribute("aria-pressed", String(name === (display?.mode ?? "textured")));
    }
    this.#curves.setAttribute("aria-pressed", String(display?.overlay ?? false));
    this.#compare.setAttribute("aria-pressed", String(this.studio.comparing));
    this.#projection.setAttribute("aria-pressed", String(orthographic));
  }
}
