// Line icons of 20 x 20, drawn for this page.

const PATHS: Record<string, string> = {
  undo: "M7 4 3.5 7.5 7 11M4 7.5h7.5a4.5 4.5 0 0 1 0 9H8",
  redo: "M13 4l3.5 3.5L13 11M16 7.5H8.5a4.5 4.5 0 0 0 0 9H12",
  history: "M3.5 10a6.5 6.5 0 1 1 2 4.7M3.5 15v-3.2h3.2M10 6.5V10l2.5 1.7",
  open: "M3 15.5v-11h5l1.6 2H17v9zM3 9h14",
  save: "M4 3.5h9.5l3 3v10h-12.5zM7 3.5v4h5.5v-4M6.5 16.5v-5h7v5",
  export: "M10 12.5v-9M6.5 6.5 10 3l3.5 3.5M4 11.5v5h12v-5",
  theme: "M10 3.5a6.5 6.5 0 1 0 0 13zM10 3.5a6.5 6.5 0 0 1 0 13",
  help: "M10 17a7 7 0 1 0 0-14 7 7 0 0 0 0 14zM8 8.2a2 2 0 1 1 2.9 1.8c-.6.3-.9.7-.9 1.5M10 13.7v.1",
  play: "M6.5 4.5v11l9-5.5z",
  pause: "M7 4.5v11M13 4.5v11",
  loop: "M4 9.5v-1a3 3 0 0 1 3-3h8M13 3.5l2 2-2 2M16 10.5v1a3 3 0 0 1-3 3H5M7 16.5l-2-2 2-2",
  close: "M5 5l10 10M15 5 5 15",
  search: "M9 14.5a5.5 5.5 0 1 0 0-11 5.5 5.5 0 0 0 0 11zM13 13l4 4",
  fit: "M3.5 7.5v-4h4M12.5 3.5h4v4M16.5 12.5v4h-4M7.5 16.5h-4v-4",
  symmetry: "M10 3v14M7.5 6 3 10l4.5 4zM12.5 6l4.5 4-4.5 4z",
  dice: "M4 4h12v12H4zM7.3 7.3v.1M12.7 7.3v.1M10 10v.1M7.3 12.7v.1M12.7 12.7v.1",
  photo: "M3 4.5h14v11H3zM3 13l4-3.5 3 2.5 3.5-3L17 12.5M13 7.5v.1",
  motion: "M3 10h2l2-5 3.5 10L13 7l1.5 3H17",
  camera: "M3 6h9.5v8.5H3zM12.5 9 17 6.5V14l-4.5-2.5",
  projection: "M4 6.5 10 3l6 3.5v7L10 17l-6-3.5zM4 6.5l6 3.5 6-3.5M10 10v7",
  record: "M10 15a5 5 0 1 0 0-10 5 5 0 0 0 0 10z",
  curves: "M3 6c4-2.5 10-2.5 14 0M3 10c4-2.5 10-2.5 14 0M3 14c4-2.5 10-2.5 14 0",
  compare: "M10 3v14M4 5h4v10H4zM12 5h4v10h-4z",
};

export function icon(name: string): SVGSVGElement {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", "0 0 20 20");
  svg.setAttribute("aria-hidden", "true");
  svg.classList.add("icon");
  const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  path.setAttribute("d", PATHS[name] ?? "");
  svg.append(path);
  return svg;
}
