// The tracker in its worker, asked for one picture at a time.

import { api } from "./api";
import type { Answer, Question } from "./tracking";

type Face = Answer & { kind: "face" };

export class Tracker {
  #worker: Worker;
  #waiting: ((answer: Answer) => void) | null = null;

  private constructor(worker: Worker) {
    this.#worker = worker;
    worker.addEventListener("message", ({ data }: MessageEvent<Answer>) => this.#answered(data));
    worker.addEventListener("error", ({ message }) =>
      this.#answered({ kind: "failed", message: message || "it could not be started" }));
  }

  static async begin(): Promise<Tracker> {
    const model = await api.trackerModel();
    const worker = new Worker(new URL("./tracker.worker.ts", import.meta.url), { type: "module" });
    const tracker = new Tracker(worker);
    const at = (name: string) => new URL(`tracker/${name}`, document.baseURI).href;
    const loader = at("vision_wasm_module_internal.js");
    const wasm = at("vision_wasm_module_internal.wasm");
    const answer = await tracker.#ask({ kind: "begin", model, loader, wasm }, [model]);
    if (answer.kind === "failed") {
      tracker.end();
      throw new Error(`the tracker cannot begin: ${answer.message}`);
    }
    return tracker;
  }

  get busy(): boolean {
    return this.#waiting !== null;
  }

  // The face in a picture; null if there is none.
  async look(picture: ImageBitmap, time: number): Promise<Face | null> {
    const answer = await this.#ask({ kind: "look", picture, time }, [picture]);
    if (answer.kind === "failed") throw new Error(`the tracker failed: ${answer.message}`);
    return answer.kind === "face" ? answer : null;
  }

  end(): void {
    this.#worker.terminate();
  }

  #ask(question: Question, given: Transferable[]): Promise<Answer> {
    return new Promise((resolve) => {
      this.#waiting = resolve;
      this.#worker.postMessage(question, given);
    });
  }

  #answered(answer: Answer): void {
    const waiting = this.#waiting;
    this.#waiting = null;
    waiting?.(answer);
  }
}
