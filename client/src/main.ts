// The page: everything made, and introduced to each other.

import { api } from "./api";
import { Bar } from "./bar";
import { Blend } from "./blend";
import { Timeline, type Step } from "./document";
import { download, fileName } from "./dialogs";
import { settled } from "./dom";
import { exportDialog } from "./exports";
import { Files } from "./files";
import { Handles } from "./handles";
import { help } from "./help";
import { Jobs } from "./jobs";
import { listen, type Shortcut } from "./keys";
import { Motion } from "./motion";
import { Panel } from "./panel";
import { Overlay } from "./overlay";
import { PhotoDesk } from "./photo";
import type { ClipInfo, PhotoInfo } from "./schema";
import { ScanView } from "./scan";
import { keepSession, lastSession, ownSession, type Session } from "./storage";
import { Studio } from "./studio";
import { setTheme, theme } from "./theme";
import { toast } from "./toast";
import { Tools } from "./tools";
import { tour } from "./tour";
import { Viewer } from "./viewer";
import { Webcam } from "./webcam";

async function start(): Promise<void> {
  setTheme(theme());
  const stage = document.getElementById("stage")!;
  const [schema, first] = await Promise.all([api.schema(), api.first()]);
  const own = ownSession();
  const left = own ?? lastSession();
  const opened: Step = { label: "Opened", doc: { face: first.id, name: first.name, weights: first.weights } };
  const timeline = own ? new Timeline(own.steps, own.at) : new Timeline([opened]);
  const viewer = new Viewer(stage, () =>
    toast(new Error("the browser can no longer draw in 3D; reload the page, your work is kept")));
  const studio = new Studio(schema, timeline, viewer);
  const tools = new Tools(studio, stage);
  const blend = new Blend(studio, stage);
  const panel = new Panel(studio, document.getElementById("panel")!, () => blend.choose());
  const switchTheme = () => {
    setTheme(theme() === "dark" ? "light" : "dark");
    dress();
  };
  const dress = () => {
    if (viewer.display) viewer.display.theme = theme();
    viewer.draw();
  };
  const jobs = new Jobs(() => void studio.refine());
  const motion = new Motion(studio, stage);
  const handles = new Handles(studio, stage);
  const scan = new ScanView(studio, tools, stage);
  const overlay = new Overlay(studio, stage);
  const webcam = new Webcam(studio, stage, (clip) => show(clip));
  let photos: readonly PhotoInfo[] | null = null;
  let desk: PhotoDesk | null = null;
  const show = (clip?: ClipInfo) => {
    overlay.leave();
    webcam.close();
    void motion.show(clip);
  };
  const files = new Files(studio, jobs, stage, show, (found) => {
    photos = found;
    overlay.leave();
    if (desk?.isOpen) desk.update(found);
  }, (found) => {
    overlay.leave();
    scan.show(found);
  });
  // Of these photos the face was made; else there is the bundled portrait to try.
  const film = () => {
    overlay.leave();
    if (motion.open) motion.close();
    if (webcam.open) webcam.close();
    else void webcam.show();
  };
  const withPhotos = async (act: (all: readonly PhotoInfo[]) => void) => {
    try {
      photos ??= (await api.firstPhotos()).photos;
      act(photos);
    } catch (error) {
      toast(error);
    }
  };
  const compare = (photo?: PhotoInfo) => withPhotos((all) => {
    if (overlay.open) overlay.leave();
    else {
      if (motion.open) motion.close();
      webcam.close();
      overlay.show(all, photo ?? all[0]!);
    }
  });
  const showPhoto = () => withPhotos((all) => {
    desk = new PhotoDesk(studio, all, {
      add: (chosen, beside) => files.takePhotos(chosen, beside), overlay: (photo) => void compare(photo),
    });
  });
  const save = async () => {
    try {
      download(await studio.saved(), fileName(timeline.doc.name, ".pdeface"));
    } catch (error) {
      toast(error);
    }
  };
  const shortcuts: Shortcut[] = [
    { keys: "1", what: "From the front", act: () => viewer.look("front") },
    { keys: "2", what: "Three-quarter", act: () => viewer.look("threeQuarter") },
    { keys: "3", what: "From the left side", act: () => viewer.look("profile") },
    { keys: "4", what: "From the right side", act: () => viewer.look("otherProfile") },
    { keys: "ArrowLeft", what: "Turn left", act: () => viewer.turn(-1, 0) },
    { keys: "ArrowRight", what: "Turn right", act: () => viewer.turn(1, 0) },
    { keys: "ArrowUp", what: "Turn up", act: () => viewer.turn(0, 1) },
    { keys: "ArrowDown", what: "Turn down", act: () => viewer.turn(0, -1) },
    { keys: "+ =", what: "Nearer", act: () => viewer.zoom(0.9) },
    { keys: "-", what: "Farther", act: () => viewer.zoom(1 / 0.9) },
    { keys: "f", what: "Fit", act: () => viewer.fit() },
    { keys: "p", what: "Perspective or orthographic", act: () => tools.projection() },
    { keys: "m", what: "Next way of showing", act: () => tools.nextMode() },
    { keys: "b", what: "Before and after", act: () => studio.compare(!studio.comparing) },
    { keys: "c", what: "Boundary curves on top", act: () => tools.curves() },
    { keys: "o", what: "The photo behind the face", act: () => void compare() },
    { keys: "y", what: "Symmetry", act: () => panel.toggleSymmetry() },
    { keys: "r", what: "Random face", act: () => panel.randomFace() },
    { keys: "/", what: "Search controls", act: () => panel.focusSearch() },
    { keys: "Ctrl+z", what: "Undo", act: () => timeline.undo() },
    { keys: "Ctrl+Shift+z Ctrl+y", what: "Redo", act: () => timeline.redo() },
    { keys: "d", what: "Drag the curves", act: () => handles.toggle() },
    { keys: "w", what: "Webcam on or off", act: film },
    { keys: " ", what: "Play or pause motion", act: () => (motion.open ? motion.toggle() : show()) },
    { keys: "Ctrl+o", what: "Open", act: () => files.choose() },
    { keys: "Ctrl+s", what: "Save", act: () => void save() },
    { keys: "Ctrl+e", what: "Export", act: () => exportDialog(studio, motion) },
    { keys: "l", what: "Light or dark", act: switchTheme },
    { keys: "?", what: "This help", act: () => help(shortcuts) },
  ];
  new Bar(studio, document.getElementById("bar")!, {
    open: () => files.choose(), save: () => void save(), exports: () => exportDialog(studio, motion),
    photo: () => void showPhoto(), motion: () => (motion.open ? motion.close() : show()), webcam: film,
    sculpt: () => handles.toggle(), theme: switchTheme, help: () => help(shortcuts),
    isOpen: () => ({ motion: motion.open, webcam: webcam.open, sculpt: handles.on }),
  });
  listen(shortcuts);
  const keep = settled(() => keepSession(timeline.steps, timeline.at), 150);
  timeline.addEventListener("change", keep);
  studio.addEventListener("shown", dress);
  if (own) toast("Your work was recovered.");
  else if (left && worthIt(left)) offer(left, timeline);
  Object.assign(window, { studio, viewer, motion, handles, files, blend, overlay, scan, webcam, api });
  await studio.load();
  welcome();
  files.resume();
  await studio.keepCurrent();
  keep();
}

const SEEN = "pdeface.studio.1.seen";

// Once: what is where.
function welcome(): void {
  if (localStorage.getItem(SEEN)) return;
  localStorage.setItem(SEEN, "yes");
  tour();
}

function worthIt({ steps }: Session): boolean {
  return steps.length > 1;
}

function offer(left: Session, timeline: Timeline): void {
  toast("There is unsaved work from an earlier window.", {
    label: "Resume",
    act: () => timeline.replace(left.steps, left.at),
  });
}

start().catch((error: unknown) => {
  document.documentElement.dataset.failed = "true";
  toast(error instanceof Error ? error : new Error(String(error)));
});
