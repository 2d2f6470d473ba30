// The first screen: what is where, said once, on the page itself.

import { h } from "./dom";

interface Note {
  // What it is about, and on which side of that it stands.
  readonly about: string;
  readonly side: "below" | "above" | "left" | "middle";
  readonly title: string;
  readonly text: string;
}

const NOTES: readonly Note[] = [
  { about: "#bar .cluster.doors", side: "below", title: "Begin here", text: "Open a photo or a scan, move the face by a clip or your webcam, pull its curves, export it. Files can be dropped anywhere." },
  { about: "#bar .cluster.past", side: "below", title: "Nothing is lost", text: "Every gesture can be undone; the work is kept in this browser." },
  { about: "#panel", side: "left", title: "Shape and expression", text: "A slider for everything; double-click resets one. M, S and L mute it, hear it alone, lock it." },
  { about: "#stage .modes", side: "above", title: "Ways of showing", text: "The picture, the surface, its curvature, its mesh, or the curves it is made of." },
  { about: "#stage", side: "middle", title: "The face", text: "Drag to turn, wheel or pinch to zoom, right button or two fingers to move." },
];

const GAP = 14;

export function tour(): void {
  const box = h("dialog", { class: "tour", "aria-label": "What is where" });
  const close = h("button", { class: "primary", onclick: () => box.close() }, "Begin");
  const all = NOTES.map((note) =>
    h("section", { class: note.side }, h("h3", {}, note.title), h("p", {}, note.text)));
  all.at(-1)!.append(close);
  box.append(...all);
  const place = () => NOTES.forEach((note, n) => put(all[n]!, note));
  box.addEventListener("close", () => {
    removeEventListener("resize", place);
    box.remove();
  });
  addEventListener("resize", place);
  document.body.append(box);
  box.showModal();
  place();
  close.focus();
}

// A note beside what it is about, on the page whatever that is.
function put(note: HTMLElement, { about, side }: Note): void {
  const frame = document.querySelector(about)!.getBoundingClientRect();
  const { offsetWidth: width, offsetHeight: height } = note;
  const middle = frame.left + frame.width / 2;
  const place = {
    below: [middle - width / 2, frame.bottom + GAP],
    above: [middle - width / 2, frame.top - height - GAP],
    left: [frame.left - width - GAP, frame.top + frame.height / 3],
    middle: [middle - width / 2, frame.top + 0.42 * frame.height - height / 2],
  }[side];
  const left = Math.max(GAP, Math.min(innerWidth - width - GAP, place[0]!));
  const top = Math.max(GAP, Math.min(innerHeight - height - GAP, place[1]!));
  Object.assign(note.style, { left: `${left}px`, top: `${top}px` });
}
