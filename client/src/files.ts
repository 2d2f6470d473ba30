// Files opened or dropped: sent to the server, which finds out by itself what they are.

import { api, type Packet } from "./api";
import { h } from "./dom";
import { Fitting } from "./fitting";
import type { Jobs } from "./jobs";
import type { ClipInfo, JobInfo, PhotoInfo, ScanInfo } from "./schema";
import { keepJob, unfinishedJob, type Begun } from "./storage";
import type { Studio } from "./studio";
import { toast } from "./toast";

export class Files {
  // The scan that was fitted last, while it was.
  fitting: Fitting | null = null;
  #progress = h("div", { class: "progress", role: "status", hidden: true });

  constructor(
    private studio: Studio,
    private jobs: Jobs,
    private stage: HTMLElement,
    private onClip: (clip: ClipInfo) => void,
    private onPhotos: (photos: readonly PhotoInfo[]) => void,
    private onScan: (scan: ScanInfo) => void,
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
      void this.takeAll([...(event.dataTransfer?.files ?? [])]);
    });
  }

  choose(): void {
    const input = h("input", { type: "file", multiple: true, accept: ".pdeface,.jpg,.jpeg,.png,.ply,.obj,.stl,.glb,.csv,.json", id: "file" });
    input.addEventListener("change", () => {
      void this.takeAll([...(input.files ?? [])]);
    });
    input.click();
  }

  // Several photos at once are of one person.
  async takeAll(files: readonly File[]): Promise<void> {
    const photos = files.filter(({ type }) => type.startsWith("image/"));
    if (photos.length > 1) void this.takePhotos(photos);
    for (const file of files) if (photos.length < 2 || !photos.includes(file)) await this.take(file);
  }

  // The face of the person in these photos and in those that the server has already.
  async takePhotos(files: readonly File[], beside: readonly string[] = []): Promise<void> {
    try {
      const added: string[] = [];
      for (const file of files) added.push((await api.addPhoto(file)).id);
      const { job } = await api.person([...beside, ...added]);
      const name = beside.length ? this.studio.doc.name : stem(files[0]!);
      this.#watch(job!, name, `Face of ${beside.length + added.length} photos`);
    } catch (error) {
      toast(error);
    }
  }

  async take(file: File): Promise<void> {
    try {
      const { face, clip, job } = await api.open(file);
      const name = stem(file);
      if (face) await this.studio.adopt({ ...face, name: face.name || name }, `Open ${file.name}`);
      if (clip) this.onClip({ ...clip, name });
      if (job) this.#watch(job, name, `Open ${file.name}`);
    } catch (error) {
      toast(error);
    }
  }

  // What was begun before a reload is waited for again.
  resume(): void {
    const begun = unfinishedJob();
    if (begun) this.jobs.again(begun.id, ...this.#waiting(begun));
  }

  #watch(job: JobInfo, name: string, label: string): void {
    keepJob({ id: job.id, name, label });
    this.jobs.watch(job, ...this.#waiting({ id: job.id, name, label }));
  }

  #waiting({ name, label }: Begun): [(job: JobInfo) => void, (packet: Packet) => void] {
    let fitting: Fitting | null = null;
    const seen = (packet: Packet) => {
      fitting ??= this.fitting = new Fitting(this.studio.viewer);
      fitting.show(packet);
    };
    const told = ({ state, message, share, face, photos, scan }: JobInfo) => {
      if (state !== "running") keepJob(null);
      // Over a dialogue that is open, if one is.
      (document.querySelector<HTMLElement>("dialog[open]") ?? this.stage).append(this.#progress);
      this.#progress.hidden = state !== "running";
      this.#progress.replaceChildren(h("span", { class: "spinner" }), h("div", {},
        `${name}: ${message}…`, h("progress", { value: share, "aria-label": "How far it is" })));
      if (state === "failed") {
        fitting?.end();
        toast(new Error(message));
      }
      if (state !== "done" || !face) return;
      const there = () => {
        fitting?.end();
        if (scan) this.onScan(scan);
      };
      void this.studio.adopt({ ...face, name }, label).then(() => this.studio.arrival(face.id)).then(there);
      for (const note of photos.flatMap(({ notes }) => notes)) toast(note);
      if (photos.length) this.onPhotos(photos);
    };
    return [told, seen];
  }
}

function stem(file: File): string {
  return file.name.replace(/\.[^.]*$/, "");
}
