// The studio's state in one place: schema, timeline, the face on the stage, and what keeps the
// server and the page of one mind.

import { api, UnknownFace, type Size, type Weights } from "./api";
import { Timeline, withWeights, type Doc } from "./document";
import { settled } from "./dom";
import { Head } from "./head";
import type { FaceInfo, Schema } from "./schema";
import { keepFace, keptFace } from "./storage";
import { toast } from "./toast";
import type { Viewer } from "./viewer";

const SETTLE = 90;

export class Studio extends EventTarget {
  size: Size;
  symmetric = true;
  info!: FaceInfo;
  #shown = "";
  #loading = 0;
  #asking = false;
  #askAgain = false;
  #refine = settled(() => void this.refine(), SETTLE);

  constructor(
    readonly schema: Schema,
    readonly timeline: Timeline,
    readonly viewer: Viewer,
  ) {
    super();
    this.size = schema.densities[2]!;
    timeline.addEventListener("live", () => this.#follow());
    timeline.addEventListener("change", () => void this.#settle());
  }

  get doc(): Doc {
    return this.timeline.doc;
  }

  get head(): Head | null {
    return this.viewer.head;
  }

  // A slider moves: this control, and its other side where the face is kept symmetric.
  paired(name: string, value: number): Record<string, number> {
    const control = this.schema.controls.find((each) => each.name === name);
    const mirror = this.symmetric ? control?.mirror : null;
    return mirror ? { [name]: value, [mirror]: value } : { [name]: value };
  }

  preview(changes: Weights): void {
    this.timeline.preview(withWeights(this.timeline.doc, changes));
  }

  commit(label: string, changes: Weights = {}): void {
    this.timeline.commit(label, withWeights(this.timeline.doc, changes));
  }

  // Put a face on the stage that the server has just made or opened.
  async adopt(info: FaceInfo, label: string, weights: Weights = info.weights): Promise<void> {
    this.info = info;
    await this.#keep(info);
    this.timeline.commit(label, { face: info.id, name: info.name, weights });
  }

  async setSize(size: Size): Promise<void> {
    this.size = size;
    await this.load();
  }

  // The face of the document on the stage: first as it is, then able to move.
  async load(): Promise<void> {
    const turn = ++this.#loading;
    const { face } = this.timeline.doc;
    const size = this.size;
    try {
      this.info = await this.#known(face);
      const glb = await api.model(face, size);
      const head = await Head.load(glb, size, this.info.curves * this.info.points);
      if (turn !== this.#loading) return;
      this.viewer.show(head);
      this.#shown = face;
      await this.refine();
      this.dispatchEvent(new Event("shown"));
      const columns = await api.columns(face, size);
      if (turn !== this.#loading) return;
      head.morph.setColumns(columns, this.schema.controls.map((control) => control.name));
      this.#follow();
      document.documentElement.dataset.ready = "true";
      this.dispatchEvent(new Event("ready"));
    } catch (error) {
      toast(error);
    }
  }

  // Ask the server where the face is exactly at the weights shown; the latest question wins.
  async refine(): Promise<void> {
    if (this.#asking) {
      this.#askAgain = true;
      return;
    }
    const { head, size } = this;
    const { face, weights } = this.timeline.doc;
    if (!head || face !== this.#shown) return;
    this.#asking = true;
    try {
      const exact = await this.#retold(() => api.evaluate(face, size, [weights]));
      if (head === this.viewer.head) {
        head.anchor(exact, weights);
        this.#redraw();
        this.dispatchEvent(new Event("exact"));
      }
    } catch (error) {
      toast(error);
    } finally {
      this.#asking = false;
      if (this.#askAgain) {
        this.#askAgain = false;
        this.#refine();
      }
    }
  }

  // A server that was started anew is told what it has forgotten.
  async #retold<T>(question: () => Promise<T>): Promise<T> {
    try {
      return await question();
    } catch (error) {
      if (!(error instanceof UnknownFace) || !(await this.retell())) throw error;
      return question();
    }
  }

  async retell(face = this.timeline.doc.face): Promise<boolean> {
    const kept = await keptFace(face);
    return kept !== null && (await api.open(kept)).face?.id === face;
  }

  async #known(face: string): Promise<FaceInfo> {
    return this.#retold(() => api.known(face));
  }

  // The face of the document goes into the browser's storage, to survive the server.
  async keepCurrent(): Promise<void> {
    if (this.info && (await keptFace(this.info.id)) === null) await this.#keep(this.info);
  }

  async #keep(info: FaceInfo): Promise<void> {
    try {
      await keepFace(info.id, await api.save(info.id, info.name, {}));
    } catch (error) {
      toast(error);
    }
  }

  #follow(): void {
    if (this.#redraw()) this.#refine();
    this.dispatchEvent(new Event("live"));
  }

  #redraw(): boolean {
    const { head } = this;
    if (!head || this.timeline.doc.face !== this.#shown) return false;
    head.update(this.timeline.doc.weights);
    this.viewer.display?.moved();
    this.viewer.draw();
    return true;
  }

  async #settle(): Promise<void> {
    this.dispatchEvent(new Event("change"));
    if (this.timeline.doc.face !== this.#shown) await this.load();
  }
}
