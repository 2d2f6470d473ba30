// The webcam: the face does what you do, live, and keeps it as a clip.

import { h } from "./dom";
import { icon } from "./icons";
import type { ClipInfo } from "./schema";
import type { Studio } from "./studio";
import { toast } from "./toast";
import { Tracker } from "./tracker";
import { Calibration, mirrored, Smoother, type Answer, type Performed } from "./tracking";

const NEUTRAL_FRAMES = 12;
// Seconds of a clip.
const LONGEST = 240;
const DIGITS = 1e4;

interface Taken {
  readonly time: number;
  readonly done: Performed;
}

type Face = Answer & { kind: "face" };

export class Webcam {
  // What is seen now, as it is recorded: not mirrored.
  latest: Performed | null = null;
  frames = 0;
  #tracker: Tracker | null = null;
  #stream: MediaStream | null = null;
  #calibration = new Calibration();
  #smoother = new Smoother();
  #neutral: Face[] | null = null;
  #take: { began: number; frames: Taken[] } | null = null;
  #takes = 0;
  #seen: number[] = [];
  #video = h("video", { muted: true, playsinline: true, "aria-label": "The camera" });
  #state = h("span", { class: "state", role: "status" });
  #mirror = h("button", { "aria-pressed": "true", title: "As a mirror shows you", onclick: () => this.#flip() }, "Mirror");
  #smooth = h("input", { type: "range", min: 0, max: 1, step: 0.05, value: 0.6, id: "smoothing", "aria-label": "Smoothing" });
  #record = h("button", { id: "take", title: "Record a clip; again to end it", "aria-pressed": "false", onclick: () => this.#toggle() }, icon("record"), "Record");
  #bar: HTMLElement;

  constructor(
    private studio: Studio,
    stage: HTMLElement,
    private onClip: (clip: ClipInfo) => void,
  ) {
    this.#smooth.addEventListener("input", () => this.#steady());
    this.#bar = h("div", { class: "float webcam", hidden: true, role: "group", "aria-label": "Webcam" },
      this.#video,
      h("div", { class: "side" },
        this.#state,
        h("div", { class: "line" },
          h("button", { id: "neutral", title: "Hold a calm face and look at the camera: this is where all expressions are 0", onclick: () => (this.#neutral = []) }, "Set neutral"),
          this.#mirror),
        h("div", { class: "line" }, h("label", { for: "smoothing" }, "Smooth"), this.#smooth),
        h("div", { class: "line" }, this.#record, h("span", { class: "space" }),
          h("button", { class: "quiet", "aria-label": "Close webcam", onclick: () => this.close() }, "Close"))));
    stage.append(this.#bar);
    this.#steady();
  }

  get open(): boolean {
    return !this.#bar.hidden;
  }

  async show(): Promise<void> {
    if (this.open) return;
    this.#bar.hidden = false;
    this.studio.tellDoors();
    this.#say("Starting the camera…");
    try {
      if (!navigator.mediaDevices) throw new Error("the browser gives no camera to this address; use http://127.0.0.1");
      this.#stream = await navigator.mediaDevices.getUserMedia({ video: { width: 640, height: 480, facingMode: "user" } });
      this.#video.srcObject = this.#stream;
      await this.#video.play();
      this.#say("Loading the tracker…");
      this.#tracker = await Tracker.begin();
      if (!this.open) throw new Error("the camera was closed");
      this.#calibration = new Calibration();
      this.studio.performing = true;
      this.#next();
    } catch (error) {
      const denied = (error as Error).name === "NotAllowedError";
      if (this.open) toast(denied ? new Error("the browser may not use the camera; allow it and try again") : error);
      this.close();
    }
  }

  // A take that is running becomes a clip.
  close(): void {
    if (!this.open) return;
    const take = this.#take;
    this.#take = null;
    this.#record.setAttribute("aria-pressed", "false");
    this.#bar.hidden = true;
    this.studio.tellDoors();
    for (const track of this.#stream?.getTracks() ?? []) track.stop();
    this.#stream = null;
    this.#video.srcObject = null;
    this.#tracker?.end();
    this.#tracker = null;
    this.latest = null;
    if (this.studio.performing) {
      this.studio.performing = false;
      this.studio.head?.pivot.rotation.set(0, 0, 0);
      this.studio.redraw();
    }
    if (take) this.#finish(take.frames);
  }

  // With the next picture of the camera, but never two at a time: a slow machine leaves some out.
  #next(): void {
    const video = this.#video;
    video.requestVideoFrameCallback(async (now) => {
      const tracker = this.#tracker;
      if (!tracker) return;
      try {
        const picture = await createImageBitmap(video);
        const face = await tracker.look(picture, now);
        if (tracker !== this.#tracker) return;
        this.#count(now);
        if (face) this.#follow(face, now / 1000);
        this.#tell(face !== null);
        this.#next();
      } catch (error) {
        if (tracker !== this.#tracker) return;
        toast(error);
        this.close();
      }
    });
  }

  #follow(face: Face, seconds: number): void {
    if (this.#neutral) {
      this.#neutral.push(face);
      if (this.#neutral.length >= NEUTRAL_FRAMES) {
        this.#calibration.set(this.#neutral);
        this.#neutral = null;
      }
    }
    const done = this.#smoother.next(this.#calibration.applied(face), seconds);
    this.latest = done;
    this.#keep(done, seconds);
    this.#pose(this.#isMirror ? mirrored(done) : done);
  }

  #pose({ weights, head: [yaw, pitch, roll] }: Performed): void {
    const { studio } = this;
    studio.head?.pivot.rotation.set(pitch, yaw, roll, "YXZ");
    studio.perform(studio.marks.heard({ ...studio.doc.weights, ...known(studio, weights) }));
  }

  #keep(done: Performed, seconds: number): void {
    const take = this.#take;
    if (!take) return;
    take.began ||= seconds;
    take.frames.push({ time: seconds - take.began, done });
    if (seconds - take.began > LONGEST) this.close();
  }

  #toggle(): void {
    if (this.#take) {
      this.close();
      return;
    }
    this.#take = { began: 0, frames: [] };
    this.#record.setAttribute("aria-pressed", "true");
  }

  #finish(frames: readonly Taken[]): void {
    if (frames.length < 2) {
      toast("Nothing was recorded: no face was seen.");
      return;
    }
    const names = Object.keys(known(this.studio, frames[0]!.done.weights));
    const clip: ClipInfo = {
      name: `take ${++this.#takes}`,
      times: frames.map(({ time }) => time),
      names,
      weights: frames.map(({ done }) => names.map((name) => Math.round(DIGITS * (done.weights[name] ?? 0)) / DIGITS)),
      head: frames.map(({ done }) => [...done.head]),
      notes: [],
    };
    this.onClip(clip);
  }

  #count(now: number): void {
    this.frames++;
    this.#seen = [...this.#seen.filter((time) => now - time < 2000), now];
  }

  #tell(found: boolean): void {
    const [first, last] = [this.#seen[0]!, this.#seen.at(-1)!];
    const rate = last > first ? (1000 * (this.#seen.length - 1)) / (last - first) : 0;
    if (!found) this.#say("No face in the picture");
    else if (this.#neutral) this.#say("Hold still…");
    else if (this.#take) this.#say(`Recording ${(this.#take.frames.at(-1)?.time ?? 0).toFixed(1)} s`);
    else this.#say(`Following, ${rate.toFixed(0)} a second`);
  }

  #say(text: string): void {
    this.#state.textContent = text;
  }

  get #isMirror(): boolean {
    return this.#mirror.getAttribute("aria-pressed") === "true";
  }

  #flip(): void {
    this.#mirror.setAttribute("aria-pressed", String(!this.#isMirror));
    this.#video.classList.toggle("plain", !this.#isMirror);
  }

  #steady(): void {
    this.#smoother.strength = this.#smooth.valueAsNumber;
    this.#smooth.style.setProperty("--to", `${100 * this.#smooth.valueAsNumber}%`);
  }
}

// Those of the tracker's expressions that the face has.
function known(studio: Studio, weights: Performed["weights"]): Record<string, number> {
  const has = new Set(studio.schema.controls.map(({ name }) => name));
  return Object.fromEntries(Object.entries(weights).filter(([name]) => has.has(name)));
}
