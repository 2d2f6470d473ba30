// A photo and its feature points (the paper's Fig. 5): each can be moved, and the texture that the
// five steps make of them is shown beside it at once.

import { api } from "./api";
import { dialog, download, fileName } from "./dialogs";
import { h, settled } from "./dom";
import { PhotoView } from "./photo_view";
import type { TextureWay } from "./api";
import type { PhotoInfo } from "./schema";
import type { Studio } from "./studio";
import { toast } from "./toast";

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
  #view = new PhotoView({
    moved: () => {
      if (this.#way !== "warp") this.#choose("warp");
      this.#warp();
    },
    chosen: (name) => (this.#name.textContent = name.replaceAll("_", " ")),
  });
  #strip = h("div", { class: "strip", role: "group", "aria-label": "Photos of this person" });
  #ways = new Map<TextureWay, HTMLButtonElement>();
  #what = h("p", {});
  #texture = h("img", { alt: "Texture of the photo", id: "texture" });
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
    const ways = h("div", { class: "tabs two", role: "group", "aria-label": "How the texture is made" });
    for (const { way, label, what } of WAYS) {
      const button = h("button", { title: what, onclick: () => this.#choose(way) }, label);
      this.#ways.set(way, button);
      ways.append(button);
    }
    const button = (label: string, act: () => void, more = {}) => h("button", { onclick: act, ...more }, label);
    this.#box = dialog("Photo and its points", "desk",
      h("div", { class: "sides" },
        h("div", { class: "seen" }, this.#view.element, this.#strip),
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
    this.#view.show(photo);
    this.#fillStrip();
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
    const frame = h("button", {
      class: "quiet", id: "frame", title: "The face or the whole photo (double-click it); wheel or pinch to zoom",
      onclick: () => this.#view.turn(),
    }, "Face or all");
    this.#strip.replaceChildren(...this.#photos.map(thumb), add, frame, ...(this.#photos.length > 1 ? [less] : []));
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
    this.#view.element.classList.toggle("warped", way === "warp");
    if (this.#photo) void this.#show();
  }

  #say(): void {
    const { notes } = this.#photo;
    this.#name.textContent = this.#view.points.length
      ? "Drag a point, or choose one and use the arrow keys: the texture is warped by them."
      : (notes.at(-1) ?? "");
  }

  #reset(): void {
    this.#view.reset();
    this.#warp();
  }

  get #chosen(): Record<string, readonly number[]> {
    return Object.fromEntries(this.#view.points.map(({ name, x, y }) => [name, [x, y]]));
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
      if (warped) this.#view.drawMesh((await api.photoMesh(this.#photo.id, this.#chosen)).mesh);
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
