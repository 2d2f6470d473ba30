// A picture moved and magnified: one pointer drags it, two pinch and drag it, a wheel zooms.

import { clamp } from "./dom";

// Magnified by `by` about (x, y), pixels of the element, then moved by (dx, dy).
export interface Step {
  readonly x: number;
  readonly y: number;
  readonly dx: number;
  readonly dy: number;
  readonly by: number;
}

type Spot = readonly [number, number];

// isFree: whether the picture is there to be moved, and nothing else is held.
export function gestures(element: HTMLElement, isFree: () => boolean, act: (step: Step) => void): void {
  const held = new Map<number, Spot>();
  const inside = (event: MouseEvent): Spot => {
    const frame = element.getBoundingClientRect();
    return [event.clientX - frame.left, event.clientY - frame.top];
  };
  element.addEventListener("pointerdown", (event) => {
    if (held.size === 2) return;
    if (isFree()) element.setPointerCapture(event.pointerId);
    held.set(event.pointerId, inside(event));
  });
  element.addEventListener("pointermove", (event) => {
    if (!held.has(event.pointerId)) return;
    const before = seen(held);
    held.set(event.pointerId, inside(event));
    const after = seen(held);
    const by = before.spread > 0 ? after.spread / before.spread : 1;
    if (isFree()) act({ x: before.x, y: before.y, dx: after.x - before.x, dy: after.y - before.y, by });
  });
  for (const end of ["pointerup", "pointercancel", "lostpointercapture"] as const) {
    element.addEventListener(end, (event) => held.delete(event.pointerId));
  }
  element.addEventListener("wheel", (event) => {
    if (!isFree()) return;
    event.preventDefault();
    const [x, y] = inside(event);
    // A pinch on a touchpad comes as a wheel with Ctrl, in small steps.
    const by = clamp(Math.exp(-event.deltaY / (event.ctrlKey ? 120 : 600)), 0.5, 2);
    act({ x, y, dx: 0, dy: 0, by });
  }, { passive: false });
}

// The middle of what is held, and how far it is apart.
function seen(held: ReadonlyMap<number, Spot>): { x: number; y: number; spread: number } {
  const all = [...held.values()];
  const mean = (axis: 0 | 1) => all.reduce((sum, spot) => sum + spot[axis], 0) / all.length;
  const [one, other] = all;
  return { x: mean(0), y: mean(1), spread: other ? Math.hypot(one![0] - other[0], one![1] - other[1]) : 0 };
}
