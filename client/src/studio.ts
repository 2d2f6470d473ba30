// The studio's state in one place: schema, timeline, the face on the stage, and what keeps the
// server and the page of one mind.

import { api, UnknownFace, type Size, type Weights } from "./api";
import { Timeline, withWeights, type Doc } from "./document";
import { settled } from "./dom";
import { Head } from "./head";
import { Marks } from "./marks";
import type { ExportRequest, FaceInfo, Schema } from "./schema";
import { keepFace, keptFace } from "./storage";
import { toast } from "./toast";
import type { Viewer } from "./viewer";

const SETTLE = 90;

export class Studio extends EventTarget {
  size: Size;
  readonly marks: Marks;
  symmetric = true;
  info!: FaceInfo;
  // A motion moves the face: the document's own expressions wait.
  performing = false;
  // The face as it was opened is shown instead.
  comparing = false;
  // A handle is held: what the server says of the face without it would be a step back.
  holding = false;
  // What the face does besides what the document says: what it did in a photo that lies behind it.
  #worn: Weights = {};
  #shown = "";
  #infos = new Map<string, FaceInfo>();
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
    this.marks = new Marks(schema.controls);
    this.marks.addEventListener("change", () => {
      this.dispatchEvent(new Event("marks"));
      if (this.redraw()) this.#refine();
    });
    this.size = schema.densities[2]!;
    timeline.addEventListener("live", () => this.#follow());
    timeline.addEventListener("change", () => void this.#settle());
  }

  get doc(): Doc {
    return this.timeline.doc;
  }

  // The id of the face on the stage: behind the document's while another is loaded.
  get shown(): string {
    return this.#shown;
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
    if (this.comparing) this.compare(false);
    this.timeline.preview(withWeights(this.timeline.doc, this.marks.free(changes)));
  }

  commit(label: string, changes: Weights = {}): void {
    this.timeline.commit(label, withWeights(this.timeline.doc, this.marks.free(changes)));
  }

  // Put a face on the stage that the server has just made or opened.
  async adopt(info: FaceInfo, label: string, weights: Weights = info.weights): Promise<void> {
    this.#infos.set(info.id, info);
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
    delete document.documentElement.dataset.meetings;
    const { face } = this.timeline.doc;
    const size = this.size;
    try {
      this.info = await this.#known(face);
      const glb = await api.model(face, size);
      const head = await Head.load(glb, size, this.info.curves, this.info.points);
      if (turn !== this.#loading) return;
      this.viewer.show(head);
      this.#shown = face;
      await this.refine();
      performance.mark("shown");
      this.dispatchEvent(new Event("shown"));
      const columns = await api.columns(face, size);
      if (turn !== this.#loading) return;
      const names = this.schema.controls.map((control) => control.name);
      head.morph.setColumns(columns, names);
      this.#follow();
      document.documentElement.dataset.ready = "true";
      performance.mark("ready");
      this.dispatchEvent(new Event("ready"));
      void this.#meet(head, face, size, names);
    } catch (error) {
      toast(error);
    }
  }

  // Until this has come, which takes the server seconds, lids that meet are a little off while they
  // move.
  async #meet(head: Head, face: string, size: Size, names: readonly string[]): Promise<void> {
    try {
      const meetings = await api.meetings(face, size);
      if (head !== this.head) return;
      head.morph.setMeetings(meetings, names);
      document.documentElement.dataset.meetings = "true";
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
    const { face } = this.timeline.doc;
    const weights = this.seen;
    if (!head || face !== this.#shown) return;
    this.#asking = true;
    try {
      const exact = await this.#retold(() => api.evaluate(face, size, [weights]));
      if (head === this.viewer.head) {
        if (!this.holding && !this.performing) head.morph.setExtra(null);
        head.anchor(exact, weights);
        this.redraw();
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
    const known = this.#infos.get(face) ?? (await this.#retold(() => api.known(face)));
    this.#infos.set(face, known);
    return known;
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

  // The face as the document says, drawn with the next frame.
  redraw(): boolean {
    if (this.timeline.doc.face !== this.#shown) return false;
    if (!this.performing && !this.comparing) this.perform(this.seen);
    return true;
  }

  // The weights at which the face is shown.
  get seen(): Weights {
    return this.marks.heard({ ...this.timeline.doc.weights, ...this.#worn });
  }

  wear(expression: Weights): void {
    this.#worn = expression;
    if (this.redraw()) this.#refine();
  }

  // Before and after: the weights with which this face was opened, until it is told otherwise.
  compare(before: boolean): void {
    const first = this.timeline.steps.find(({ doc }) => doc.face === this.timeline.doc.face);
    this.comparing = before && first !== undefined;
    if (this.comparing) this.perform(this.marks.heard(first!.doc.weights));
    else this.redraw();
    this.dispatchEvent(new Event("shown-otherwise"));
  }

  // The face at other weights than the document's, as a motion has them.
  perform(weights: Weights): void {
    this.head?.update(weights);
    this.viewer.display?.moved();
    this.viewer.draw();
  }

  exported(request: ExportRequest, face: string): Promise<Blob> {
    return this.#retold(() => api.export(face, request));
  }

  saved(): Promise<Blob> {
    const { face, name, weights } = this.timeline.doc;
    return this.#retold(() => api.save(face, name, weights));
  }

  // The face is on the stage, or another one is wanted meanwhile.
  arrival(face: string): Promise<void> {
    return new Promise((there) => {
      const look = () => {
        if (this.#shown !== face && this.timeline.doc.face === face) return;
        this.removeEventListener("exact", look);
        there();
      };
      this.addEventListener("exact", look);
      look();
    });
  }

  // Something beside the stage has been opened or closed.
  tellDoors(): void {
    this.dispatchEvent(new Event("doors"));
  }

  #follow(): void {
    if (this.redraw()) this.#refine();
    this.dispatchEvent(new Event("live"));
  }

  async #settle(): Promise<void> {
    this.dispatchEvent(new Event("change"));
    const { face } = this.timeline.doc;
    if (face === this.#shown || !this.head) return;
    try {
      const next = await this.#known(face);
      // Other curves alone want no other meshes: the server says where they are now.
      const alike = next.texture === this.info.texture && next.curves === this.info.curves;
      if (!alike) {
        await this.load();
        return;
      }
      this.info = next;
      this.#shown = face;
      await this.refine();
    } catch (error) {
      toast(error);
    }
  }
}
