// The bar on top: whose face it is, undo and redo, files, theme, help.

import { h } from "./dom";
import { icon } from "./icons";
import type { Studio } from "./studio";

// What opens beside the stage and stays until it is closed.
const DOORS = ["motion", "webcam", "sculpt"] as const;
type Door = (typeof DOORS)[number];

export interface Commands {
  readonly open: () => void;
  readonly save: () => void;
  readonly exports: () => void;
  readonly photo: () => void;
  readonly motion: () => void;
  readonly webcam: () => void;
  readonly sculpt: () => void;
  readonly theme: () => void;
  readonly help: () => void;
  // What is open now.
  readonly isOpen: () => Readonly<Record<Door, boolean>>;
}

export class Bar {
  #doors: Record<Door, HTMLButtonElement>;
  #undo: HTMLButtonElement;
  #redo: HTMLButtonElement;
  #name: HTMLInputElement;
  #history = h("div", { class: "menu", id: "history", hidden: true, role: "menu" });

  constructor(
    private studio: Studio,
    place: HTMLElement,
    private commands: Commands,
  ) {
    const { timeline } = studio;
    const tool = (name: string, label: string, act: () => void, text = "") =>
      h("button", { class: text ? "tool named" : "tool", title: label, "aria-label": text || label, onclick: act },
        icon(name), text || null);
    this.#undo = tool("undo", "Undo (Ctrl+Z)", () => timeline.undo());
    this.#redo = tool("redo", "Redo (Ctrl+Shift+Z)", () => timeline.redo());
    const past = tool("history", "History", () => this.#toggleHistory());
    this.#name = h("input", { class: "name", "aria-label": "Name of the face", maxlength: 120, spellcheck: "false" });
    this.#name.addEventListener("change", () =>
      timeline.commit("Rename", { ...timeline.doc, name: this.#name.value.trim() || "face" }));
    this.#doors = {
      motion: tool("motion", "Motion (Space)", commands.motion, "Motion"),
      webcam: tool("camera", "Webcam: the face does what you do (W)", commands.webcam, "Webcam"),
      sculpt: tool("curves", "Drag points of the boundary curves (D)", commands.sculpt, "Sculpt"),
    };
    place.append(
      h("div", { class: "brand" }, h("b", {}, "pdeface"), " studio"),
      this.#name,
      h("div", { class: "cluster past" }, this.#undo, this.#redo, h("div", { class: "anchor" }, past, this.#history)),
      h("div", { class: "space" }),
      h("div", { class: "cluster doors" },
        tool("open", "Open a photo, a scan, a face or a motion (Ctrl+O)", commands.open, "Open"),
        tool("photo", "Photo and its points", commands.photo, "Photo"),
        this.#doors.motion, this.#doors.webcam, this.#doors.sculpt,
        tool("save", "Save as .pdeface (Ctrl+S)", commands.save, "Save"),
        tool("export", "Export (Ctrl+E)", commands.exports, "Export")),
      h("div", { class: "cluster" },
        tool("theme", "Light or dark (L)", commands.theme),
        tool("help", "Help and shortcuts (?)", commands.help)),
    );
    timeline.addEventListener("change", () => this.#show());
    studio.addEventListener("doors", () => this.#show());
    document.addEventListener("pointerdown", (event) => {
      if (!(event.target as Element).closest(".anchor")) this.#history.hidden = true;
    });
    this.#show();
  }

  #show(): void {
    const { timeline } = this.studio;
    this.#undo.disabled = !timeline.canUndo;
    this.#redo.disabled = !timeline.canRedo;
    this.#name.value = timeline.doc.name;
    const open = this.commands.isOpen();
    for (const door of DOORS) this.#doors[door].setAttribute("aria-pressed", String(open[door]));
    if (!this.#history.hidden) this.#fillHistory();
  }

  #toggleHistory(): void {
    this.#history.hidden = !this.#history.hidden;
    if (!this.#history.hidden) this.#fillHistory();
  }

  #fillHistory(): void {
    const { timeline } = this.studio;
    const line = (label: string, index: number) =>
      h("button", {
        role: "menuitem", class: index > timeline.at ? "undone" : "",
        "aria-current": index === timeline.at ? "step" : undefined,
        onclick: () => timeline.go(index),
      }, label);
    this.#history.replaceChildren(...timeline.steps.map((step, i) => line(step.label, i)).reverse());
  }
}
