// The export dialogue: which format, how fine, which targets; and pictures.

import { dialog, download, fileName } from "./dialogs";
import { h } from "./dom";
import { clipFilm, turntable, type Turn } from "./film";
import type { Motion } from "./motion";
import type { Studio } from "./studio";
import { toast } from "./toast";

interface Format {
  readonly suffix: string;
  readonly label: string;
  readonly hint: string;
  readonly mesh?: boolean;
  readonly targets?: boolean;
  readonly film?: boolean;
}

const FORMATS: readonly Format[] = [
  { suffix: ".glb", label: "GLB", hint: "Engines and viewers, with expressions", mesh: true, targets: true },
  { suffix: ".vrm", label: "VRM", hint: "An avatar, VRM 1.0", mesh: true, targets: true },
  { suffix: ".obj", label: "OBJ", hint: "Modellers, with its texture, as a ZIP", mesh: true },
  { suffix: ".ply", label: "PLY", hint: "Mesh tools, with its texture, as a ZIP", mesh: true },
  { suffix: ".stl", label: "STL", hint: "3D printing", mesh: true },
  { suffix: ".pdeface", label: "pdeface", hint: "The curves themselves: 4 kB and a texture" },
  { suffix: ".png", label: "Texture", hint: "The texture, PNG" },
  { suffix: "still", label: "Picture", hint: "What the stage shows, PNG without background" },
  { suffix: "turn", label: "Turntable", hint: "The face turning, MP4", film: true },
  { suffix: "clip", label: "Clip", hint: "The motion that is open, MP4", film: true },
];

const MESHES = [[28, 41], [55, 81], [109, 161], [217, 321], [541, 321]] as const;
const FILMS = [[480, 600], [720, 900], [1080, 1080], [1920, 1080], [1080, 1920]] as const;
const STILLS = [[1600, 1200], [2400, 1800], [3840, 2160], [1080, 1350]] as const;

export function exportDialog(studio: Studio, motion: Motion): void {
  const pick = (name: string, format: Format, index: number) => {
    const input = h("input", { type: "radio", name, value: format.suffix, checked: index === 0 });
    return h("label", { class: "card" }, input, h("b", {}, format.label), h("span", {}, format.hint));
  };
  const size = (name: string, sizes: readonly (readonly [number, number])[], chosen: number) => {
    const options = sizes.map(([a, b], i) => h("option", { value: i, selected: i === chosen }, `${a} x ${b}`));
    return h("select", { id: name, "aria-label": name }, ...options);
  };
  const check = (name: string, label: string, on: boolean) =>
    h("label", { class: "check" }, h("input", { type: "checkbox", id: name, checked: on }), label);
  const meshes = h("label", { class: "row" }, h("span", {}, "Mesh"), size("mesh", MESHES, 1));
  const stills = h("label", { class: "row" }, h("span", {}, "Pixels"), size("pixels", STILLS, 0));
  const films = h("label", { class: "row" }, h("span", {}, "Pixels"), size("film-pixels", FILMS, 1));
  const turns = h("label", { class: "row" }, h("span", {}, "Turn"),
    h("select", { id: "turn", "aria-label": "turn" },
      h("option", { value: "sides" }, "From side to side and back"), h("option", { value: "round" }, "All the way round")));
  const targets = h("div", { class: "checks" },
    check("expressions", "Expressions as morph targets", true),
    check("visemes", "Visemes of speech as well", false));
  const go = h("button", { class: "primary", id: "export" }, "Export");
  const form = h("div", { class: "cards", role: "radiogroup", "aria-label": "Format" }, ...FORMATS.map((f, i) => pick("format", f, i)));
  const box = dialog("Export", "exports", form, meshes, stills, films, turns, targets, h("footer", {}, go));
  const chosen = () =>
    FORMATS.find(({ suffix }) => suffix === form.querySelector<HTMLInputElement>(":checked")!.value)!;
  const fitting = () => {
    const { mesh, targets: moving, suffix, film } = chosen();
    films.hidden = !film;
    turns.hidden = suffix !== "turn";
    go.disabled = suffix === "clip" && !motion.clip;
    go.title = go.disabled ? "Open a motion first" : "";
    meshes.hidden = !mesh;
    stills.hidden = suffix !== "still";
    targets.hidden = !moving;
  };
  const of = (id: string) => box.querySelector<HTMLInputElement & HTMLSelectElement>(`#${id}`)!;
  form.addEventListener("change", fitting);
  fitting();
  go.addEventListener("click", async () => {
    const { suffix } = chosen();
    const { face, name } = studio.doc;
    // As it is seen: without what is muted. A .pdeface file keeps all.
    const own = (suffix: string) => suffix === ".pdeface" ? studio.doc.weights : studio.marks.heard(studio.doc.weights);
    go.disabled = true;
    go.textContent = "Writing…";
    try {
      if (suffix === "turn" || suffix === "clip") {
        const pixels = FILMS[Number(of("film-pixels").value)]!;
        const tell = (share: number) => {
          if (!box.open) throw new Error("the film was given up; nothing was written");
          go.textContent = `Filming… ${Math.round(100 * share)} %`;
        };
        const { viewer } = studio;
        const film = suffix === "turn" ? await turntable(viewer, pixels, of("turn").value as Turn, tell) : await clipFilm(motion, viewer, pixels, tell);
        download(film, fileName(`${name}-${suffix === "turn" ? "turntable" : motion.clip!.name}`, ".mp4"));
      } else if (suffix === "still") {
        const [width, height] = STILLS[Number(of("pixels").value)]!;
        download(await studio.viewer.still(width, height), fileName(name, ".png"));
      } else {
        const [rows, columns] = MESHES[Number(of("mesh").value)]!;
        const blob = await studio.exported({
          weights: own(suffix), name, format: suffix, rows, columns, join: studio.size.join ?? "smooth",
          expressions: of("expressions").checked, visemes: of("visemes").checked,
        }, face);
        const zip = blob.type === "application/zip";
        const ending = suffix === ".png" ? "-texture.png" : zip ? `${suffix}.zip` : suffix;
        download(blob, fileName(name, "") + ending);
      }
      box.close();
    } catch (error) {
      toast(error);
      go.disabled = false;
      go.textContent = "Export";
    }
  });
}
