// Dialogues: the browser's own, which keep the focus and close with Escape.

import { h } from "./dom";
import { icon } from "./icons";

export function dialog(title: string, name: string, ...children: HTMLElement[]): HTMLDialogElement {
  const element = h("dialog", { class: name, "aria-label": title });
  const close = h("button", { class: "tool", "aria-label": "Close", onclick: () => element.close() }, icon("close"));
  element.append(h("header", {}, h("h2", {}, title), close), ...children);
  element.addEventListener("close", () => element.remove());
  element.addEventListener("pointerdown", (event) => {
    if (event.target === element) element.close();
  });
  document.body.append(element);
  element.showModal();
  return element;
}

export function download(blob: Blob, name: string): void {
  const url = URL.createObjectURL(blob);
  const link = h("a", { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 30_000);
}

// A file's name from a face's: letters of any script, digits, hyphens.
export function fileName(name: string, suffix: string): string {
  const plain = name.trim().replace(/[^\p{L}\p{N}_-]+/gu, "-").replace(/^-+|-+$/g, "");
  return `${plain || "face"}${suffix}`;
}
