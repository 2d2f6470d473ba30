// The document: immutable, and the history of it. One step a gesture.

import type { Weights } from "./api";

export interface Doc {
  readonly face: string;
  readonly name: string;
  readonly weights: Weights;
}

export interface Step {
  readonly label: string;
  readonly doc: Doc;
}

const MOST_STEPS = 200;

export class Timeline extends EventTarget {
  #steps: Step[];
  #at: number;
  // What a gesture shows before it ends; null between gestures.
  #live: Doc | null = null;

  constructor(steps: readonly Step[], at = steps.length - 1) {
    super();
    this.#steps = [...steps];
    this.#at = at;
  }

  get doc(): Doc {
    return this.#live ?? this.#steps[this.#at]!.doc;
  }

  get committed(): Doc {
    return this.#steps[this.#at]!.doc;
  }

  get steps(): readonly Step[] {
    return this.#steps;
  }

  get at(): number {
    return this.#at;
  }

  get canUndo(): boolean {
    return this.#at > 0;
  }

  get canRedo(): boolean {
    return this.#at < this.#steps.length - 1;
  }

  // Show a change that a gesture has not ended yet.
  preview(doc: Doc): void {
    this.#live = doc;
    this.dispatchEvent(new Event("live"));
  }

  // End a gesture: one step, or none if nothing changed.
  commit(label: string, doc: Doc = this.doc): void {
    this.#live = null;
    if (!same(doc, this.committed)) {
      this.#steps = [...this.#steps.slice(0, this.#at + 1), { label, doc }].slice(-MOST_STEPS);
      this.#at = this.#steps.length - 1;
    }
    this.#changed();
  }

  cancel(): void {
    this.#live = null;
    this.#changed();
  }

  go(to: number): void {
    if (to < 0 || to >= this.#steps.length) return;
    this.#live = null;
    this.#at = to;
    this.#changed();
  }

  undo(): void {
    this.go(this.#at - 1);
  }

  redo(): void {
    this.go(this.#at + 1);
  }

  // Go on where another window ended.
  replace(steps: readonly Step[], at: number): void {
    this.#steps = [...steps];
    this.go(at);
  }

  #changed(): void {
    this.dispatchEvent(new Event("live"));
    this.dispatchEvent(new Event("change"));
  }
}

export function same(one: Doc, other: Doc): boolean {
  if (one.face !== other.face || one.name !== other.name) return false;
  const names = new Set([...Object.keys(one.weights), ...Object.keys(other.weights)]);
  return [...names].every((name) => (one.weights[name] ?? 0) === (other.weights[name] ?? 0));
}

// The document with some weights changed; those that are 0 are left out, as Python does.
export function withWeights(doc: Doc, changes: Weights): Doc {
  const weights = { ...doc.weights, ...changes };
  for (const [name, value] of Object.entries(weights)) if (value === 0) delete weights[name];
  return { ...doc, weights };
}
