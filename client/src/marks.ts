// Controls that are muted, heard alone or locked. A muted control keeps its value and has no effect;
// a locked one keeps its value whatever is done to all of them.

import type { Weights } from "./api";
import type { ControlInfo } from "./schema";

export type Mark = "mute" | "solo" | "lock";

export class Marks extends EventTarget {
  #marked: Record<Mark, Set<string>> = { mute: new Set(), solo: new Set(), lock: new Set() };
  #kinds: Map<string, string>;

  constructor(controls: readonly ControlInfo[]) {
    super();
    this.#kinds = new Map(controls.map(({ name, kind }) => [name, kind]));
  }

  has(mark: Mark, name: string): boolean {
    return this.#marked[mark].has(name);
  }

  set(mark: Mark, names: readonly string[], on: boolean): void {
    for (const name of names) {
      if (on) this.#marked[mark].add(name);
      else this.#marked[mark].delete(name);
    }
    this.dispatchEvent(new Event("change"));
  }

  get any(): boolean {
    return Object.values(this.#marked).some((names) => names.size > 0);
  }

  clear(): void {
    for (const names of Object.values(this.#marked)) names.clear();
    this.dispatchEvent(new Event("change"));
  }

  // Those weights that have an effect. What is heard alone is so among its own kind: an expression
  // does not take the person's shape away.
  heard(weights: Weights): Weights {
    const { mute, solo } = this.#marked;
    if (!mute.size && !solo.size) return weights;
    const alone = new Set([...solo].map((name) => this.#kinds.get(name)));
    return Object.fromEntries(Object.entries(weights).filter(([name]) =>
      !mute.has(name) && (solo.has(name) || !alone.has(this.#kinds.get(name)))));
  }

  // Those changes that no lock forbids.
  free(changes: Weights): Weights {
    const { lock } = this.#marked;
    if (!lock.size) return changes;
    return Object.fromEntries(Object.entries(changes).filter(([name]) => !lock.has(name)));
  }
}

export const MARKS: readonly { mark: Mark; letter: string; what: string }[] = [
  { mark: "mute", letter: "M", what: "Mute: without effect, its value kept" },
  { mark: "solo", letter: "S", what: "Solo: the others of its kind without effect" },
  { mark: "lock", letter: "L", what: "Lock: keeps its value, whatever is set, drawn or reset" },
];
