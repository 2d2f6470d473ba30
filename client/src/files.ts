// Files opened or dropped: sent to the server, which finds out by itself what they are.

import { api } from "./api";
import { h } from "./dom";
import type { Jobs } from "./jobs";
import type { ClipInfo, PhotoInfo } from "./schema";
import type { Studio } from "./studio";
import { toast } from "./toast";

export class Files {
  #progress = h("div", { class: "progress", role: "status", hidden: true });

  constructor(
    private studio: Studio,
    private jobs: Jobs,
    stage: HTMLElement,
    private onClip: (clip: ClipInfo) => void,
    private onPhoto: (photo: PhotoInfo) => void,
  ) {
    stage.append(this.#progress);
    const over = (event: DragEvent) => {
      event.preventDefault();
      stage.classList.add("dropping");
    };
    document.addEventListener("dragover", over);
    document.addEventListener("dragleave", (event) => {
      if (!event.relatedTarget) stage.classList.remove("dropping");
    });
    document.addEventListener("drop", (event) => {
      event.preventDefault();
      stage.classList.remove("dropping");
      for (const file of event.dataTransfer?.files ?? []) void this.take(file);
    });
  }

  choose(): void {
    const input = h("input", { type: "file", accept: ".pdeface,.jpg,.jpeg,.png,.ply,.obj,.stl,.glb,.csv,.json", id: "file" });
    input.addEventListener("change", () => {
      for (const file of input.files ?? []) void this.take(file);
    });
    input.click();
  }

  async take(file: File): Promise<void> {
    try {
      const { face, clip, job } = await api.open(file);
      const name = file.name.replace(/\.[^.]*$/, "");
      if (face) await this.studio.adopt({ ...face, name: face.name || name }, `Open ${file.name}`);
      if (clip) this.onClip({ ...clip, name });
      if (job) {
        this.jobs.watch(job, ({ state, message, face: made, photo }) => {
          this.#progress.hidden = state !== "running";
          this.#progress.replaceChildren(h("span", { class: "spinner" }), `${name}: ${message}…`);
          if (state === "failed") toast(new Error(message));
          if (state !== "done" || !made) return;
          void this.studio.adopt({ ...made, name }, `Open ${file.name}`);
          if (photo) {
            for (const note of photo.notes) toast(note);
            this.onPhoto(photo);
          }
        });
      }
    } catch (error) {
      toast(error);
    }
  }
}
