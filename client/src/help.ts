// Help: what to do first, and every shortcut.

import { dialog } from "./dialogs";
import { h } from "./dom";
import { tour } from "./tour";
import { keysOf, type Shortcut } from "./keys";

const NAMES: Record<string, string> = {
  ArrowLeft: "←", ArrowRight: "→", ArrowUp: "↑", ArrowDown: "↓", " ": "Space",
};

export function help(shortcuts: readonly Shortcut[]): void {
  const key = (keys: string) =>
    keysOf(keys).map((one) => h("kbd", {}, (one === "+" ? [one] : one.split("+")).map((k) => NAMES[k] ?? k.toUpperCase().replace("CTRL", "Ctrl").replace("SHIFT", "Shift")).join(" ")));
  const rows = shortcuts.map(({ keys, what }) => h("div", {}, h("span", {}, what), h("span", {}, ...key(keys))));
  const box = dialog("Help", "help",
    h("p", {}, "Drag to turn the face, wheel or pinch to zoom, drag with the right button or two fingers to move it. Sliders on the right shape it; double-click one to reset it. Drop a photo, a scan, a .pdeface file or a Live Link Face CSV anywhere."),
    h("p", {}, "The face is 28 boundary curves and the exact solution of one equation between them. Nothing leaves this machine."),
    h("div", { class: "keys" }, ...rows),
    h("footer", {}, h("button", {
      id: "tour",
      onclick: () => {
        box.close();
        tour();
      },
    }, "What is where")));
}
