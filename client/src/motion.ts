// Motion: a clip over the face, played, scrubbed, looped, faster or slower.

import { api, type Weights } from "./api";
import { download, fileName } from "./dialogs";
import { h } from "./dom";
import { recorded } from "./film";
import { icon } from "./icons";
import type { ClipInfo } from "./schema";
import type { Studio } from "./studio";
import { toast } from "./toast";

export class Motion {
  clip: ClipInfo | null = null;
  time = 0;
  playing = false;
  #loop = true;
  #speed = 1;
  #before = 0;
  #asked = 0;
  #rest: Weights = {};
  #recording = false;
  // Told when a recording has been played to its end.
  #ended: (() => void) | null = null;
  // Clips that came as files, by name.
  #own = new Map<string, ClipInfo>();
  #bar: HTMLElement;
  #choice: HTMLSelectElement;
  #play = h("button", { class: "icon-only", id: "play" });
  #scrub = h("input", { type: "range", min: 0, max: 1, step: 0.001, "aria-label": "Time", id: "scrub" });
  #clock = h("span", { class: "clock" });

  constructor(
    private studio: Studio,
    stage: HTMLElement,
  ) {
    this.#choice = h("select", { "aria-label": "Clip", id: "clip" },
      ...studio.schema.clips.map((name) => h("option", { value: name }, name)));
    this.#choice.addEventListener("change", () => void this.choose(this.#choice.value));
    const loop = h("button", { class: "icon-only", title: "Loop", "aria-label": "Loop", "aria-pressed": "true" }, icon("loop"));
    loop.addEventListener("click", () => {
      this.#loop = !this.#loop;
      loop.setAttribute("aria-pressed", String(this.#loop));
    });
    const speed = h("select", { "aria-label": "Speed", id: "speed" },
      ...[0.25, 0.5, 1, 2].map((x) => h("option", { value: x, selected: x === 1 }, `${x}×`)));
    speed.addEventListener("change", () => (this.#speed = Number(speed.value)));
    this.#play.addEventListener("click", () => this.toggle());
    this.#scrub.addEventListener("input", () => {
      this.pause();
      this.seek(this.#scrub.valueAsNumber * this.duration);
    });
    const film = h("button", {
      class: "icon-only", id: "film", title: "Record as a film (WebM)", "aria-label": "Record",
      onclick: () => void this.record(),
    }, icon("record"));
    const keep = h("button", {
      class: "icon-only", id: "keep-clip", title: "Save the motion as a file (JSON)", "aria-label": "Save the motion",
      onclick: () => void this.#save(),
    }, icon("save"));
    const close = h("button", { class: "icon-only", title: "Stop and close", "aria-label": "Close motion", onclick: () => this.close() }, icon("close"));
    this.#bar = h("div", { class: "float player", role: "group", "aria-label": "Motion", hidden: true },
      this.#play, this.#choice, this.#scrub, this.#clock, speed, loop, film, keep, close);
    stage.append(this.#bar);
    for (const moment of ["change", "marks"]) studio.addEventListener(moment, () => this.#restart());
    this.#show();
  }

  get duration(): number {
    return this.clip?.times.at(-1) ?? 0;
  }

  get open(): boolean {
    return !this.#bar.hidden;
  }

  // Open with a built-in clip, or with one that came as a file.
  async show(clip?: ClipInfo): Promise<void> {
    if (!clip) {
      await this.choose(this.#choice.value);
      return;
    }
    if (![...this.#choice.options].some((option) => option.value === clip.name)) {
      this.#choice.append(h("option", { value: clip.name }, clip.name));
      this.#own.set(clip.name, clip);
    }
    this.#choice.value = clip.name;
    for (const note of clip.notes) toast(note);
    this.#take(clip);
  }

  async choose(name: string): Promise<void> {
    try {
      this.#take(this.#own.get(name) ?? (await api.clip(name)));
    } catch (error) {
      toast(error);
    }
  }

  toggle(): void {
    if (!this.open) void this.show();
    else if (this.playing) this.pause();
    else this.play();
  }

  play(): void {
    if (!this.clip) return;
    if (this.time >= this.duration) this.time = 0;
    this.playing = true;
    this.#before = performance.now();
    this.#asked = requestAnimationFrame((now) => this.#step(now));
    this.#show();
  }

  #finish(): void {
    this.#ended?.();
    this.#ended = null;
  }

  pause(): void {
    this.playing = false;
    cancelAnimationFrame(this.#asked);
    this.#finish();
    this.#show();
  }

  seek(time: number): void {
    this.time = Math.min(Math.max(0, time), this.duration);
    this.#pose();
    this.#show();
  }

  close(): void {
    this.pause();
    this.#bar.hidden = true;
    this.studio.tellDoors();
    this.clip = null;
    this.studio.performing = false;
    this.studio.head?.pivot.rotation.set(0, 0, 0);
    this.studio.redraw();
  }

  // The clip as a file that pdeface animate and this page read.
  async #save(): Promise<void> {
    const { clip } = this;
    if (!clip) return;
    try {
      download(await api.clipFile(clip), fileName(clip.name, ".json"));
    } catch (error) {
      toast(error);
    }
  }

  // Plays once from the beginning and keeps what the stage shows.
  async record(): Promise<void> {
    const { clip, studio } = this;
    if (!clip || this.#recording) return;
    this.#recording = true;
    try {
      const film = await recorded(studio.viewer, () => new Promise((ended) => {
        this.pause();
        this.#ended = ended;
        this.seek(0);
        this.play();
      }));
      download(film, fileName(`${studio.doc.name}-${clip.name}`, ".webm"));
    } catch (error) {
      this.#ended = null;
      toast(error);
    } finally {
      this.#recording = false;
    }
  }

  #take(clip: ClipInfo): void {
    this.pause();
    this.clip = clip;
    this.#bar.hidden = false;
    this.studio.tellDoors();
    this.time = 0;
    this.#restart();
    this.play();
  }

  // The face has changed, and performs on.
  #restart(): void {
    if (!this.clip) return;
    this.studio.performing = true;
    this.#rest = this.studio.doc.weights;
    this.#pose();
  }

  #step(now: number): void {
    if (!this.playing) return;
    this.time += (this.#speed * Math.max(0, now - this.#before)) / 1000;
    this.#before = now;
    if (this.time >= this.duration) {
      if (this.#loop && !this.#ended) this.time %= Math.max(this.duration, 0.001);
      else {
        this.time = this.duration;
        this.playing = false;
      }
    }
    this.#pose();
    this.#show();
    if (this.playing) this.#asked = requestAnimationFrame((next) => this.#step(next));
    else this.#finish();
  }

  #pose(): void {
    const { clip, studio } = this;
    const { head } = studio;
    if (!clip || !head) return;
    const { times } = clip;
    let after = times.findIndex((time) => time > this.time);
    if (after < 0) after = times.length - 1;
    const before = Math.max(0, after - 1);
    const span = times[after]! - times[before]! || 1;
    const share = Math.min(1, Math.max(0, (this.time - times[before]!) / span));
    const mixed = (axis: number) =>
      (1 - share) * clip.head[before]![axis]! + share * clip.head[after]![axis]!;
    head.pivot.rotation.set(mixed(1), mixed(0), mixed(2), "YXZ");
    studio.perform(this.#weights(before, after, share));
  }

  #weights(before: number, after: number, share: number): Weights {
    const { names, weights } = this.clip!;
    const mixed: Record<string, number> = { ...this.#rest };
    names.forEach((name, n) => {
      mixed[name] = (1 - share) * weights[before]![n]! + share * weights[after]![n]!;
    });
    return this.studio.marks.heard(mixed);
  }

  #show(): void {
    this.#play.replaceChildren(icon(this.playing ? "pause" : "play"));
    this.#play.setAttribute("aria-label", this.playing ? "Pause" : "Play");
    const at = this.duration ? this.time / this.duration : 0;
    this.#scrub.value = String(at);
    this.#scrub.style.setProperty("--to", `${100 * at}%`);
    this.#clock.textContent = `${this.time.toFixed(1)} / ${this.duration.toFixed(1)} s`;
  }
}
