// Every shortcut, in one table: what the help shows is what the page obeys.

export interface Shortcut {
  readonly keys: string;
  readonly what: string;
  readonly act: () => void;
}

// "Ctrl+Shift+z", "ArrowLeft", "?": Ctrl stands for the Mac's command key as well.
function pressed(event: KeyboardEvent): string {
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  const control = event.ctrlKey || event.metaKey ? "Ctrl+" : "";
  return control + (event.shiftKey && (control || key.length > 1) ? "Shift+" : "") + key;
}

// Keys that a field, a list or a slider needs for itself.
function isTaken(event: KeyboardEvent): boolean {
  const target = event.target as HTMLElement;
  if (target.closest("dialog")) return true;
  if (event.ctrlKey || event.metaKey) return target.matches("input:not([type=range])") && /^[zyacvx]$/i.test(event.key);
  if (target.matches("input[type=range]")) return event.key.startsWith("Arrow") || /^[-+]$/.test(event.key);
  if (target.matches("button, summary")) return event.key === " " || event.key === "Enter";
  return target.matches("input, select, textarea");
}

// Several keys are parted by spaces; a space alone is the space bar.
export function keysOf(keys: string): string[] {
  return keys === " " ? [" "] : keys.split(" ");
}

export function listen(shortcuts: readonly Shortcut[]): void {
  const table = new Map<string, Shortcut>();
  for (const shortcut of shortcuts) for (const key of keysOf(shortcut.keys)) table.set(key, shortcut);
  // A button that was clicked does not keep the keys: the space bar is to play, not to click again.
  document.addEventListener("click", (event) => {
    if (event.detail > 0) (event.target as Element).closest<HTMLElement>("button")?.blur();
  }, { capture: true });
  document.addEventListener("keydown", (event) => {
    const shortcut = table.get(pressed(event));
    if (!shortcut || isTaken(event)) return;
    event.preventDefault();
    shortcut.act();
  });
}
