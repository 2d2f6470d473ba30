// What a camera says of a face: expressions and the turn of the head, calibrated and smoothed.

import * as THREE from "three";
import type { Weights } from "./api";
import { clamp } from "./dom";

export type Question =
  | { kind: "begin"; model: ArrayBuffer; loader: string; wasm: string }
  | { kind: "look"; picture: ImageBitmap; time: number };

export type Answer =
  | { kind: "ready" }
  | { kind: "nobody"; time: number }
  | { kind: "face"; time: number; scores: Record<string, number>; pose: number[] }
  | { kind: "failed"; message: string };

// What the face does: weights, and the head's yaw, pitch and roll, radians.
export interface Performed {
  readonly weights: Weights;
  readonly head: readonly [number, number, number];
}

// What is left of an expression's way is stretched to the whole, but noise not without bounds.
const LEAST_WAY = 0.25;

// The neutral face: what the tracker says of a person who does nothing, and how the head is held.
export class Calibration {
  #scores: Record<string, number> = {};
  #inverse: THREE.Matrix4 | null = null;

  // The mean of some frames, and the pose of the last.
  set(frames: readonly (Answer & { kind: "face" })[]): void {
    const last = frames.at(-1);
    if (!last) return;
    this.#scores = {};
    for (const { scores } of frames) {
      for (const [name, score] of Object.entries(scores)) {
        this.#scores[name] = (this.#scores[name] ?? 0) + score / frames.length;
      }
    }
    this.#inverse = turnOf(last.pose).invert();
  }

  hold(pose: readonly number[]): void {
    this.#inverse ??= turnOf(pose).invert();
  }

  applied({ scores, pose }: Answer & { kind: "face" }): Performed {
    this.hold(pose);
    const weights: Record<string, number> = {};
    for (const [name, score] of Object.entries(scores)) {
      const neutral = this.#scores[name] ?? 0;
      weights[name] = clamp((score - neutral) / Math.max(1 - neutral, LEAST_WAY), 0, 1);
    }
    const turn = this.#inverse!.clone().multiply(turnOf(pose));
    const angles = new THREE.Euler().setFromRotationMatrix(turn, "YXZ");
    return { weights, head: [angles.y, angles.x, angles.z] };
  }
}

// The rotation of a pose, whose columns may be scaled.
function turnOf(pose: readonly number[]): THREE.Matrix4 {
  return new THREE.Matrix4().extractRotation(new THREE.Matrix4().fromArray(pose));
}

// Casiez, Roussel and Vogel, 1 euro filter, 2012: steady at rest, quick when things move.
export class OneEuro {
  #value: number | null = null;
  #speed = 0;
  #time = 0;

  // rest: cutoff of a value at rest, Hz; quick: how much of its speed is added to that.
  constructor(public rest: number, public quick: number) {}

  next(value: number, seconds: number): number {
    const step = seconds - this.#time;
    this.#time = seconds;
    if (this.#value === null || step <= 0) {
      this.#value = value;
      return value;
    }
    this.#speed += share(step, 1) * ((value - this.#value) / step - this.#speed);
    this.#value += share(step, this.rest + this.quick * Math.abs(this.#speed)) * (value - this.#value);
    return this.#value;
  }
}

// How far a first-order low pass of this cutoff goes in a step.
function share(step: number, cutoff: number): number {
  const rate = 2 * Math.PI * cutoff * step;
  return rate / (rate + 1);
}

// All channels of a performance through filters of their own.
export class Smoother {
  #filters = new Map<string, OneEuro>();
  #rest = 1.5;

  // 0: as it comes; 1: as steady as it gets.
  set strength(strength: number) {
    this.#rest = 30 * (0.4 / 30) ** strength;
    for (const filter of this.#filters.values()) filter.rest = this.#rest;
  }

  next({ weights, head }: Performed, seconds: number): Performed {
    const through = (name: string, value: number) => {
      let filter = this.#filters.get(name);
      if (!filter) this.#filters.set(name, (filter = new OneEuro(this.#rest, 1.2)));
      return filter.next(value, seconds);
    };
    const smooth = Object.entries(weights).map(([name, value]) => [name, through(name, value)]);
    const [yaw, pitch, roll] = head.map((angle, axis) => through(`head${axis}`, angle));
    return { weights: Object.fromEntries(smooth) as Weights, head: [yaw!, pitch!, roll!] };
  }
}

// As a mirror shows it: left is right.
export function mirrored({ weights, head: [yaw, pitch, roll] }: Performed): Performed {
  const other = (name: string) =>
    name.endsWith("Left") ? name.replace(/Left$/, "Right") : name.replace(/Right$/, "Left");
  const swapped = Object.entries(weights).map(([name, value]) => [other(name), value]);
  return { weights: Object.fromEntries(swapped) as Weights, head: [-yaw, pitch, -roll] };
}
