// Two faces as one: a file is chosen, and a slider goes from this face to that.

import { api, type Weights } from "./api";
import type { Doc } from "./document";
import { h } from "./dom";
import { icon } from "./icons";
import type { FaceInfo } from "./schema";
import type { Studio } from "./studio";
import { toast } from "./toast";

export class Blend {
  #bar = h("div", { class: "float sculpt", hidden: true, role: "group", "aria-label": "Blend" });
  #range = h("input", { type: "range", min: 0, max: 1, step: 0.05, value: 0, id: "share", "aria-label": "Share of the other face" });
  #percent = h("output", { for: "share" });
  #one: Doc | null = null;
  #other: FaceInfo | null = null;

  constructor(
    private studio: Studio,
    stage: HTMLElement,
  ) {
    this.#range.addEventListener("input", () => this.#show());
    this.#range.addEventListener("change", () => void this.mix(this.#range.valueAsNumber));
    stage.append(this.#bar);
  }

  choose(): void {
    const input = h("input", { type: "file", accept: ".pdeface" });
    input.addEventListener("change", () => {
      const file = input.files?.[0];
      if (file) void this.with(file);
    });
    input.click();
  }

  async with(file: File): Promise<void> {
    try {
      const { face } = await api.open(file);
      if (!face) throw new Error("a face is blended with another, a .pdeface file; choose one");
      this.#one = this.studio.doc;
      this.#other = face;
      this.#range.value = "0";
      const close = h("button", { class: "icon-only", "aria-label": "Close blend", onclick: () => (this.#bar.hidden = true) }, icon("close"));
      const name = (text: string) => h("span", {}, text || "face");
      this.#bar.replaceChildren(name(this.#one.name), this.#range, name(face.name), this.#percent, close);
      this.#bar.hidden = false;
      this.#show();
    } catch (error) {
      toast(error);
    }
  }

  async mix(share: number): Promise<void> {
    const [one, other] = [this.#one, this.#other];
    if (!one || !other) return;
    try {
      const info = await api.blend(one.face, other.id, share);
      const weights = mixed(one.weights, other.weights, share);
      await this.studio.adopt({ ...info, name: one.name }, `Blend ${Math.round(100 * share)} %`, weights);
    } catch (error) {
      toast(error);
    }
  }

  #show(): void {
    const percent = Math.round(100 * this.#range.valueAsNumber);
    this.#range.style.setProperty("--to", `${percent}%`);
    this.#percent.textContent = `${percent} %`;
  }
}

function mixed(one: Weights, other: Weights, share: number): Weights {
  const weights: Record<string, number> = {};
  for (const name of [...Object.keys(one), ...Object.keys(other)]) {
    const value = (1 - share) * (one[name] ?? 0) + share * (other[name] ?? 0);
    if (value) weights[name] = value;
  }
  return weights;
}
