// Lines that come and go: what went wrong and what to do, or what was done.

import { h } from "./dom";

interface Action {
  readonly label: string;
  readonly act: () => void;
}

const SHOWN = 7000;

export function toast(what: unknown, action?: Action): void {
  const failed = what instanceof Error;
  const text = failed ? what.message : String(what);
  const place = document.getElementById("toasts")!;
  for (const old of place.children) if (old.firstChild?.textContent === text) old.remove();
  const line = h("div", { class: failed ? "toast bad" : "toast" }, h("span", {}, text));
  const close = () => line.remove();
  if (action) {
    const act = () => {
      close();
      action.act();
    };
    line.append(h("button", { class: "quiet", onclick: act }, action.label));
  }
  line.append(h("button", { class: "quiet", "aria-label": "Dismiss", onclick: close }, "×"));
  place.append(line);
  setTimeout(close, action ? 3 * SHOWN : SHOWN);
}
