// The three small buttons of a control or of a group: mute, solo, lock.

import { h } from "./dom";
import { MARKS, type Mark, type Marks } from "./marks";

export function markButtons(marks: Marks, label: string, names: () => readonly string[]): HTMLElement {
  const toggle = (mark: Mark) => {
    const all = names();
    marks.set(mark, all, !all.every((name) => marks.has(mark, name)));
  };
  return h("span", { class: "marks" }, ...MARKS.map(({ mark, letter, what }) =>
    h("button", {
      "data-mark": mark, title: what, "aria-label": `${mark[0]!.toUpperCase()}${mark.slice(1)} ${label}`,
      "aria-pressed": "false", onclick: () => toggle(mark),
    }, letter)));
}

export function showMarks(place: HTMLElement, marks: Marks, names: readonly string[]): void {
  for (const button of place.querySelectorAll<HTMLElement>(":scope > .marks > button")) {
    const mark = button.dataset.mark as Mark;
    button.setAttribute("aria-pressed", String(names.length > 0 && names.every((name) => marks.has(mark, name))));
  }
}
