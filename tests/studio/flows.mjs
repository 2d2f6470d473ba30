// What a person does in the studio, one flow after the other, and what is seen of it.
import { readFile } from "node:fs/promises";
import { join } from "node:path";

// Of 256 levels of a colour: what a change must reach to be seen.
export const VISIBLE = 8;

export async function flows(page, { folder, gone, expecting }) {
  const report = {};
  const timed = async (name, flow) => {
    const began = Date.now();
    report[name] = await flow();
    console.error(name, Date.now() - began, "ms");
  };
  await ready(page);
  report.tour = await toured(page);
  await page.evaluate(help, VISIBLE);
  await page.locator("#density").selectOption("0");
  await page.waitForFunction(() => studio.head.size.rows === 28 && studio.head.morph.ready, null, { polling: 50 });
  await timed("modes", () => modes(page));
  await timed("views", () => views(page));
  await timed("slider", () => slider(page, expecting));
  await timed("contact", () => contact(page));
  await timed("company", () => company(page, expecting));
  await timed("controls", () => controls(page));
  await timed("marks", () => marks(page));
  await timed("motion", () => motion(page));
  await timed("sculpt", () => sculpt(page));
  await timed("photo", () => photo(page));
  await timed("behind", () => behind(page));
  await timed("barriers", () => barriers(page));
  await timed("shown", () => shown(page, folder));
  if (process.env.PDEFACE_MODEL) {
    await timed("camera", () => camera(page, folder));
    await timed("scan", () => scanned(page, folder));
  }
  await timed("files", () => files(page, folder, expecting));
  await timed("alone", () => alone(page, gone));
  expecting(false);
  await timed("lost", () => lost(page));
  await timed("recovered", () => recovered(page));
  if (process.env.PDEFACE_MODEL) await timed("waited", () => waited(page, folder));
  return report;
}

async function ready(page) {
  await page.waitForFunction(() => document.documentElement.dataset.ready, null, { polling: 100 });
}

// The first screen says what is where, each note on the page, and comes but once.
async function toured(page) {
  const notes = page.locator("dialog.tour section");
  const gone = () => page.waitForFunction(() => !document.querySelector("dialog"));
  await notes.last().waitFor();
  const boxes = await notes.evaluateAll((all) => all.map((note) => {
    const { left, top, right, bottom } = note.getBoundingClientRect();
    return [left, top, right, bottom];
  }));
  await page.getByRole("button", { name: "Begin", exact: true }).click();
  await gone();
  await page.keyboard.press("?");
  await page.locator("#tour").click();
  await notes.last().waitFor();
  const again = await notes.count();
  await page.keyboard.press("Escape");
  await gone();
  return { boxes, again, left: await page.locator("dialog").count(), view: page.viewportSize() };
}

// Functions of the page for the flows below.
export function help(visible) {
  window.pixels = () => {
    viewer.drawNow();
    const gl = viewer.renderer.getContext();
    const { drawingBufferWidth: width, drawingBufferHeight: height } = gl;
    const found = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, found);
    return found;
  };
  window.changed = (one, other) => {
    let count = 0;
    for (let i = 0; i < one.length; i += 4) {
      count += Number([0, 1, 2].some((k) => Math.abs(one[i + k] - other[i + k]) >= visible));
    }
    return count;
  };
  window.skin = () => [...studio.head.morph.positions.subarray(0, 3 * studio.head.skin.count)];
  // The server has said where the face is at the weights of the document.
  window.exact = () => {
    const anchor = studio.head.morph.anchorWeights;
    if (studio.shown !== studio.doc.face || !studio.head.morph.ready) return false;
    return JSON.stringify(anchor) === JSON.stringify(studio.doc.weights);
  };
}

const settle = (page) => page.waitForFunction(() => exact(), null, { polling: 30 });

const arrived = (page) => page.waitForFunction(() => !viewer.moving, null, { polling: 30 });

async function modes(page) {
  const found = {};
  await page.evaluate(() => (window.kept = []));
  for (const label of ["Textured", "Shaded", "Curvature", "Wireframe", "UV mesh", "Curves"]) {
    await page.getByRole("button", { name: label, exact: true }).click();
    found[label] = await page.evaluate(() => {
      const now = pixels();
      const least = Math.min(...kept.map((before) => changed(before, now)), 1e9);
      kept.push(now);
      return least;
    });
  }
  await page.getByRole("button", { name: "Curvature", exact: true }).click();
  await page.evaluate(() => (window.smooth = pixels()));
  const joined = async (join) => {
    await page.locator("#join").selectOption(join);
    await page.waitForFunction((wanted) => studio.head.size.join === wanted && studio.head.morph.ready, join, { polling: 50 });
    await page.waitForTimeout(300);
  };
  await joined("patchwise");
  found.patchwise = { seen: await page.evaluate(() => changed(smooth, pixels())), skin: await page.evaluate(() => skin()) };
  await joined("smooth");
  await page.getByRole("button", { name: "Textured", exact: true }).click();
  found.back = await page.evaluate(() => changed(kept[0], pixels()));
  found.covered = await page.evaluate(() => changed(kept[0], new Uint8Array(kept[0].length)));
  return found;
}

async function views(page) {
  const found = {};
  for (const [key, name] of [["1", "front"], ["3", "profile"], ["ArrowLeft", "turned"], ["+", "nearer"]]) {
    await page.evaluate(() => (window.before = pixels()));
    await page.keyboard.press(key);
    await arrived(page);
    found[name] = await page.evaluate(() => changed(before, pixels()));
  }
  await page.keyboard.press("p");
  found.orthographic = await page.evaluate(() => viewer.orthographic);
  await page.keyboard.press("p");
  await page.keyboard.press("1");
  await arrived(page);
  const canvas = await page.locator("canvas").first().boundingBox();
  const middle = [canvas.x + canvas.width / 2, canvas.y + canvas.height / 2];
  await page.evaluate(() => (window.before = pixels()));
  await page.mouse.move(...middle);
  await page.mouse.down();
  await page.mouse.move(middle[0] + 120, middle[1], { steps: 3 });
  await page.mouse.up();
  found.dragged = await page.evaluate(() => changed(before, pixels()));
  await page.keyboard.press("1");
  await arrived(page);
  return found;
}

async function slider(page, expecting) {
  await page.evaluate(() => (window.before = pixels()));
  const range = page.locator("#c-noseLength");
  const box = await range.boundingBox();
  const at = (share) => [box.x + box.width * share, box.y + box.height / 2];
  const steps = await page.evaluate(() => studio.timeline.steps.length);
  await page.mouse.move(...at(0.625));
  await page.mouse.down();
  for (const share of [0.7, 0.8, 0.9]) await page.mouse.move(...at(share));
  const held = await page.evaluate(() => studio.timeline.steps.length);
  await page.mouse.up();
  const found = await page.evaluate(() => ({
    weight: studio.doc.weights.noseLength, steps: studio.timeline.steps.length, moved: changed(before, pixels()),
  }));
  await settle(page);
  found.one = found.steps - steps;
  found.held = held - steps;
  await page.keyboard.press("Control+z");
  await settle(page);
  found.undone = await page.evaluate(() => [studio.doc.weights.noseLength ?? 0, changed(before, pixels())]);
  await page.keyboard.press("Control+Shift+z");
  found.redone = await page.evaluate(() => studio.doc.weights.noseLength);
  await settle(page);
  const exactly = page.locator("[data-control=noseLength] input[type=number]");
  await exactly.fill("0.4");
  await exactly.press("Enter");
  found.exact = await page.evaluate(() => studio.doc.weights.noseLength);
  // Without the server's word: base plus displacements alone.
  expecting(true);
  await page.route("**/evaluate", (route) => route.fulfill({ status: 500, json: { error: "not now" } }));
  await page.evaluate(() => {
    studio.preview({ ...studio.doc.weights, identity03: 1.2, jawOpen: 0.5, mouthSmileLeft: 0.7 });
    studio.commit("Several");
  });
  found.linear = await page.evaluate(() => ({ weights: studio.doc.weights, skin: skin() }));
  await page.unroute("**/evaluate");
  await range.dblclick();
  found.reset = await page.evaluate(() => studio.doc.weights.noseLength ?? 0);
  await settle(page);
  expecting(false);
  return found;
}

async function contact(page) {
  await page.evaluate(() => {
    studio.commit("Wide", { jawOpen: 0, mouthSmileLeft: 0, eyeWideLeft: 1, eyeSquintLeft: 0.5 });
    studio.commit("Blink", { eyeBlinkLeft: 1 });
  });
  await settle(page);
  return page.evaluate(() => ({ weights: studio.doc.weights, skin: skin() }));
}

// Lids in company, moved by the page alone, as the webcam and a slider that is held move them.
async function company(page, expecting) {
  await page.waitForFunction(() => document.documentElement.dataset.meetings, null, { polling: 30 });
  expecting(true);
  await page.route("**/evaluate", (route) => route.fulfill({ status: 500, json: { error: "not now" } }));
  const weights = { eyeBlinkLeft: 0.8, eyeSquintLeft: 1, eyeLookDownLeft: 0.7, mouthSmileLeft: 0.6, mouthClose: 0.5, jawOpen: 0.2 };
  const found = await page.evaluate((expression) => {
    const person = Object.entries(studio.doc.weights).filter(([name]) => /^(identity|nose)/.test(name));
    const performed = { ...Object.fromEntries(person), ...expression };
    studio.perform(performed);
    const { head } = studio;
    return { weights: performed, skin: skin(), eye: [...head.morph.positions.subarray(3 * head.morph.start(2), 3 * head.morph.start(3))] };
  }, weights);
  await page.unroute("**/evaluate");
  expecting(false);
  return found;
}

async function controls(page) {
  const found = {};
  await page.getByRole("tab", { name: "Expression" }).click();
  await page.getByRole("button", { name: "Reset expression" }).click();
  found.resetExpression = await page.evaluate(() => ({ ...studio.doc.weights }));
  await page.locator("#preset").selectOption("happy");
  found.preset = await page.evaluate(() => ({ ...studio.doc.weights }));
  await page.locator("#search").fill("blink");
  found.searched = await page.locator(".slider:visible").evaluateAll((all) => all.map((s) => s.dataset.control));
  await page.locator("#c-eyeBlinkLeft").focus();
  await page.keyboard.press("ArrowRight");
  found.symmetric = await page.evaluate(() => [studio.doc.weights.eyeBlinkLeft, studio.doc.weights.eyeBlinkRight]);
  await page.locator("#symmetry").click();
  await page.locator("#c-eyeBlinkLeft").focus();
  await page.keyboard.press("ArrowRight");
  found.oneSided = await page.evaluate(() => [studio.doc.weights.eyeBlinkLeft, studio.doc.weights.eyeBlinkRight]);
  found.bothShown = await page.locator(".slider:visible").count();
  await page.locator("#symmetry").click();
  await page.locator("#search").fill("");
  await page.getByRole("tab", { name: "Shape" }).click();
  await page.getByRole("button", { name: "Random" }).click();
  found.random = await page.evaluate(() => Object.keys(studio.doc.weights).filter((n) => n.startsWith("identity")).length);
  await page.getByRole("button", { name: "Reset shape" }).click();
  found.resetShape = await page.evaluate(() => Object.keys(studio.doc.weights).filter((n) => !/^(eye|mouth|cheek|brow)/.test(n)));
  await page.keyboard.press("l");
  found.theme = await page.evaluate(() => document.documentElement.dataset.theme);
  await page.keyboard.press("l");
  await page.keyboard.press("?");
  found.help = await page.locator("dialog kbd").count();
  await page.keyboard.press("Escape");
  await page.getByRole("tab", { name: "Expression" }).click();
  await page.getByRole("button", { name: "Reset expression" }).click();
  await settle(page);
  return found;
}

// Controls muted, heard alone and locked: what is seen, what is kept.
async function marks(page) {
  const before = await page.evaluate(() => studio.timeline.at);
  await page.getByRole("tab", { name: "Expression" }).click();
  await settle(page);
  const look = (name) => page.evaluate((as) => ((window.looks ??= {})[as] = pixels(), undefined), name);
  const differ = (one, other) => page.evaluate(([a, b]) => changed(looks[a], looks[b]), [one, other]);
  const shown = async (name) => {
    await page.waitForFunction(() => JSON.stringify(studio.head.morph.anchorWeights) === JSON.stringify(studio.seen), null, { polling: 30 });
    await page.waitForTimeout(200);
    await look(name);
  };
  await shown("rest");
  await page.evaluate(() => studio.commit("Smile", { mouthSmileLeft: 0.8, mouthSmileRight: 0.8 }));
  await shown("smile");
  await page.evaluate(() => studio.commit("And a jaw", { jawOpen: 0.6 }));
  await shown("both");
  await page.locator("#search").fill("jaw open");
  const jaw = (mark) => page.locator(`[data-control=jawOpen] [data-mark=${mark}]`);
  await jaw("mute").click();
  await shown("muted");
  const found = { kept: await page.evaluate(() => studio.doc.weights.jawOpen) };
  found.muted = await differ("muted", "smile");
  await jaw("mute").click();
  await jaw("solo").click();
  await shown("solo");
  await page.evaluate(() => studio.marks.clear());
  await page.evaluate(() => studio.commit("No smile", { mouthSmileLeft: 0, mouthSmileRight: 0 }));
  await shown("jaw");
  found.solo = await differ("solo", "jaw");
  found.heard = await differ("jaw", "both");
  await jaw("lock").click();
  found.locked = await page.locator("#c-jawOpen").isDisabled();
  await page.locator("#search").fill("");
  await page.getByRole("button", { name: "Reset expression" }).click();
  found.reset = await page.evaluate(() => studio.doc.weights);
  await page.locator("#unmark").click();
  found.unlocked = await page.locator("#c-jawOpen").isEnabled();
  await page.getByRole("button", { name: "Mute Jaw", exact: true }).click();
  await shown("group");
  found.group = await differ("group", "rest");
  await page.locator("#unmark").click();
  await page.locator("#symmetry").click();
  await page.evaluate(() => studio.commit("Wink", { eyeBlinkLeft: 0.5, eyeBlinkRight: 0 }));
  await page.getByRole("button", { name: "L to R" }).click();
  found.copied = await page.evaluate(() => studio.doc.weights.eyeBlinkRight);
  await page.locator("#symmetry").click();
  await page.evaluate((at) => studio.timeline.go(at), before);
  await settle(page);
  return found;
}

async function motion(page) {
  await page.evaluate(() => (window.before = pixels()));
  await page.getByRole("button", { name: "Motion" }).click();
  await page.waitForFunction(() => motion.clip && motion.time > 0, null, { polling: 20 });
  const found = { name: await page.evaluate(() => motion.clip.name) };
  await page.getByRole("button", { name: "Pause" }).click();
  found.playing = await page.evaluate(() => motion.playing);
  await page.keyboard.press(" ");
  found.again = await page.evaluate(() => [motion.open, motion.playing]);
  await page.keyboard.press(" ");
  found.shut = await page.evaluate(() => {
    motion.seek(0.4);
    return changed(before, pixels());
  });
  found.jaw = await page.evaluate(() => {
    motion.seek(motion.duration);
    return changed(before, pixels());
  });
  await page.locator("#clip").selectOption("talk");
  await page.waitForFunction(() => motion.clip.name === "talk" && motion.time > 0.1, null, { polling: 20 });
  found.turned = await page.evaluate(() => Math.max(...motion.clip.head.flat().map(Math.abs)) > 0.02);
  await page.getByRole("button", { name: "Close motion" }).click();
  await settle(page);
  found.back = await page.evaluate(() => changed(before, pixels()));
  found.weights = await page.evaluate(() => ({ ...studio.doc.weights }));
  return found;
}

async function sculpt(page) {
  const face = await page.evaluate(() => ((window.before = pixels()), studio.doc.face));
  await page.keyboard.press("d");
  const place = { curve: 20, point: 11 };
  const { x, y } = await page.evaluate((each) => handles.screen(each), place);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x, y + 25, { steps: 3 });
  await page.waitForFunction(() => studio.head.morph.positions.length && changed(before, pixels()) > 2000, null, { polling: 30 });
  const found = { live: await page.evaluate(() => skin()) };
  await page.mouse.up();
  await page.waitForFunction((old) => studio.doc.face !== old, face, { polling: 30 });
  await settle(page);
  await page.waitForTimeout(300);
  found.exact = await page.evaluate(() => skin());
  found.label = await page.evaluate(() => studio.timeline.steps.at(-1).label);
  await page.keyboard.press("d");
  found.moved = await page.evaluate(() => changed(before, pixels()));
  await page.keyboard.press("Control+z");
  await page.waitForFunction((old) => studio.doc.face === old && exact(), face, { polling: 30 });
  await page.waitForTimeout(600);
  found.undone = await page.evaluate(() => changed(before, pixels()));
  found.whole = await wholeCurve(page);
  return found;
}

// A curve dragged as a whole: it moves alike everywhere, its neighbours less.
async function wholeCurve(page) {
  await page.keyboard.press("d");
  await page.getByRole("button", { name: "Curve", exact: true }).click();
  const curves = () => page.evaluate(() => {
    const { morph } = studio.head;
    return [...morph.positions.subarray(3 * morph.start(morph.counts.length - 1))];
  });
  const [face, before] = [await page.evaluate(() => studio.doc.face), await curves()];
  const { x, y } = await page.evaluate(() => handles.screen({ curve: 20, point: 11 }));
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x, y + 18, { steps: 3 });
  await page.waitForFunction(() => changed(before, pixels()) > 2000, null, { polling: 30 });
  const live = await skinOf(page);
  await page.mouse.up();
  await page.waitForFunction((old) => studio.doc.face !== old, face, { polling: 30 });
  await settle(page);
  await page.waitForTimeout(300);
  const found = { before, after: await curves(), live, exact: await skinOf(page) };
  await page.getByRole("button", { name: "Point", exact: true }).click();
  await page.keyboard.press("d");
  await page.keyboard.press("Control+z");
  await page.waitForFunction((old) => studio.doc.face === old && exact(), face, { polling: 30 });
  await page.waitForTimeout(300);
  return found;
}

const skinOf = (page) => page.evaluate(() => skin());

async function photo(page) {
  await page.evaluate(() => (window.before = pixels()));
  await page.getByRole("button", { name: "Photo", exact: true }).click();
  const texture = page.locator("#texture");
  const made = (way) => page.waitForFunction((wanted) => {
    const image = document.querySelector("#texture");
    return image?.naturalWidth > 0 && image.dataset.way === wanted;
  }, way, { polling: 30 });
  await made("project");
  const found = { points: await page.locator("circle[data-point]").count(), projected: await colours(page) };
  await page.getByRole("button", { name: "Warped" }).click();
  await made("warp");
  found.warped = await colours(page);
  const mesh = page.locator("#mesh");
  found.mesh = (await mesh.getAttribute("d")).match(/M/g).length;
  const [first, drawn] = [await texture.getAttribute("src"), await mesh.getAttribute("d")];
  await page.getByRole("button", { name: "Projected" }).click();
  await made("project");
  const nose = page.locator("circle[data-point=nose_tip]");
  const at = Number(await nose.getAttribute("cx"));
  await nose.focus();
  await page.keyboard.press("Shift+ArrowRight");
  await page.keyboard.press("ArrowRight");
  found.moved = Number(await nose.getAttribute("cx")) - at;
  // A point that moves is the warp's.
  await made("warp");
  await page.waitForFunction(([old, path]) =>
    document.querySelector("#texture").src !== old && document.querySelector("#mesh").getAttribute("d") !== path,
  [first, drawn], { polling: 30 });
  const box = await nose.boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x - 2, box.y + 6, { steps: 2 });
  found.loupe = await page.locator(".loupe").isVisible();
  await page.mouse.up();
  found.dragged = Number(await nose.getAttribute("cx")) - at;
  await page.getByRole("button", { name: "Use this texture" }).click();
  await page.waitForFunction(() => studio.timeline.steps.at(-1).label === "Texture of the photo" && studio.head.morph.ready, null, { polling: 30 });
  await settle(page);
  await page.waitForTimeout(300);
  found.seen = await page.evaluate(() => changed(before, pixels()));
  return found;
}

// The mean colour of the texture that the dialogue shows.
const colours = (page) => page.evaluate(() => {
  const pen = new OffscreenCanvas(64, 64).getContext("2d");
  pen.drawImage(document.querySelector("#texture"), 0, 0, 64, 64);
  return [...pen.getImageData(0, 0, 64, 64).data];
});

// The photo behind the face: through its camera, fading, and gone without a trace.
async function behind(page) {
  const photo = await page.evaluate(async () => (await api.firstPhotos()).photos[0]);
  await page.evaluate(() => (window.before = pixels()));
  await page.keyboard.press("o");
  await page.waitForFunction(() => overlay.open && document.querySelector(".behind").naturalWidth > 0, null, { polling: 30 });
  const at = () => page.evaluate(() => {
    const { head } = studio;
    const [left, top] = overlay.onStage(0, 0);
    const zoom = overlay.onStage(1, 0)[0] - left;
    const frame = viewer.canvas.getBoundingClientRect();
    const place = head.skin.mesh.position.clone();
    return [300, 574, 900].map((n) => {
      place.fromArray(head.morph.positions, 3 * n).project(viewer.eye);
      const x = ((place.x + 1) / 2) * frame.width, y = ((1 - place.y) / 2) * frame.height;
      return [...head.morph.positions.subarray(3 * n, 3 * n + 3), (x - left) / zoom, (y - top) / zoom];
    });
  });
  const found = { photo, before: await at() };
  await page.mouse.move(420, 300);
  await page.mouse.wheel(0, -300);
  await page.mouse.down();
  await page.mouse.move(450, 330, { steps: 2 });
  await page.mouse.up();
  found.after = await at();
  found.turned = await page.evaluate(() => changed(before, pixels()));
  await page.locator("#opacity").fill("0.25");
  found.opacity = await page.evaluate(() => getComputedStyle(viewer.canvas).opacity);
  await page.evaluate(() => (window.smiling = pixels()));
  await page.getByRole("button", { name: "Its expression" }).click();
  found.calm = await page.evaluate(() => changed(smiling, pixels()));
  await page.keyboard.press("o");
  await settle(page);
  await page.waitForTimeout(300);
  found.back = await page.evaluate(() => changed(before, pixels()));
  found.hidden = await page.locator(".behind").isHidden();
  found.weights = await page.evaluate(() => studio.doc.weights);
  return found;
}

// The webcam sees the portrait, upright and turned by turns: the face smiles, turns and is kept.
async function camera(page, folder) {
  await page.evaluate(() => (window.before = pixels()));
  await page.keyboard.press("w");
  await page.waitForFunction(() => webcam.latest, null, { polling: 50 });
  await page.locator("#smoothing").fill("0");
  await page.locator("#take").click();
  const rolls = () => page.evaluate(() => [webcam.latest.head[2], studio.head.pivot.rotation.z]);
  const seen = [];
  const began = Date.now();
  const apart = () => Math.max(...seen.map(([roll]) => roll)) - Math.min(...seen.map(([roll]) => roll));
  while (Date.now() - began < 30_000 && !(seen.length > 3 && apart() > 0.15)) {
    const frames = await page.evaluate(() => webcam.frames);
    await page.waitForFunction((old) => webcam.frames > old, frames, { polling: 20 });
    seen.push(await rolls());
  }
  const found = { seen, smile: await page.evaluate(() => webcam.latest.weights.mouthSmileLeft) };
  found.moved = await page.evaluate(() => changed(before, pixels()));
  await page.locator("#neutral").click();
  await page.waitForFunction(() => webcam.latest.weights.mouthSmileLeft < 0.1, null, { polling: 50 });
  found.state = await page.locator(".state").textContent();
  await page.locator("#take").click();
  await page.waitForFunction(() => motion.clip?.name === "take 1", null, { polling: 50 });
  found.clip = await page.evaluate(() => motion.clip);
  const [file] = await Promise.all([page.waitForEvent("download"), page.locator("#keep-clip").click()]);
  await file.saveAs(join(folder, "take.json"));
  found.file = file.suggestedFilename();
  await page.getByRole("button", { name: "Close motion" }).click();
  await settle(page);
  await page.waitForTimeout(200);
  found.back = await page.evaluate(() => changed(before, pixels()));
  found.ended = await page.evaluate(() => document.querySelector("video").srcObject === null);
  return found;
}

// A scan is fitted: its distances in colours, itself over the face, and gone again.
async function scanned(page, folder) {
  const before = await page.evaluate(() => studio.timeline.at);
  const bytes = (await readFile(join(folder, "scan.ply"))).toString("base64");
  await page.evaluate(async (text) => {
    window.told = [];
    const watch = new MutationObserver(() => told.push(document.querySelector(".progress").textContent));
    watch.observe(document.querySelector(".progress"), { childList: true });
    const data = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    window.onTheWay = [];
    const look = () => {
      const { fitting } = files;
      if (fitting?.rounds) onTheWay.push([fitting.rounds, studio.head.root.visible, changed(before, pixels())]);
      if (!scan.info) setTimeout(look, 400);
    };
    window.before = pixels();
    await files.take(new File([data], "person.ply"));
    look();
  }, bytes);
  const measured = () => page.waitForFunction(() => exact() && viewer.display.distances?.length === studio.head.skin.count, null, { polling: 50 });
  await page.waitForFunction(() => scan.info, null, { polling: 50, timeout: 240_000 });
  await measured();
  await page.waitForTimeout(500);
  const found = { steps: await page.evaluate(() => told.length), name: await page.evaluate(() => studio.doc.name) };
  found.watched = await page.evaluate(() => onTheWay);
  found.left = await page.evaluate(() => [studio.head.root.visible, viewer.scene.getObjectsByProperty("type", "Group").filter((group) => group.children.some(({ type }) => type === "LineSegments")).length]);
  found.legend = await page.locator(".legend").textContent();
  found.mode = await page.evaluate(() => viewer.display.mode);
  found.away = await page.evaluate(() => [...viewer.display.distances]);
  await page.evaluate(() => (window.before = pixels()));
  await page.locator("#veil").click();
  await page.waitForFunction(() => changed(before, pixels()) > 1000, null, { polling: 50 });
  await page.locator("#veil").click();
  found.unveiled = await page.evaluate(() => changed(before, pixels()));
  await page.evaluate(() => {
    window.old = viewer.display.distances;
    studio.commit("Nose", { noseLength: 1 });
  });
  await page.waitForFunction(() => exact() && viewer.display.distances !== old, null, { polling: 50 });
  found.farther = await page.evaluate(() => [...viewer.display.distances]);
  found.coloured = await page.evaluate(() => changed(before, pixels()));
  await page.getByRole("button", { name: "Without the scan" }).click();
  found.after = await page.evaluate(() => viewer.display.mode);
  found.offered = await page.getByRole("button", { name: "Distance", exact: true }).isVisible();
  await page.evaluate((at) => studio.timeline.go(at), before);
  await settle(page);
  return found;
}

async function files(page, folder, expecting) {
  const found = {};
  const download = async (name, act) => {
    const [coming] = await Promise.all([page.waitForEvent("download"), act()]);
    await coming.saveAs(join(folder, name));
    return coming.suggestedFilename();
  };
  await page.evaluate(() => studio.commit("For the file", { noseWidth: 0.5, jawOpen: 0.25 }));
  found.saved = await download("saved.pdeface", () => page.keyboard.press("Control+s"));
  const exported = async (suffix, name) => {
    await page.getByRole("button", { name: "Export", exact: true }).click();
    await page.locator(`input[value="${suffix}"]`).check({ force: true });
    return download(name, () => page.locator("dialog #export").click());
  };
  found.glb = await exported(".glb", "out.glb");
  found.still = await exported("still", "still.png");
  await page.evaluate(async () => {
    const file = await (await fetch(`/api/faces/${studio.doc.face}/save`, {
      method: "POST", body: JSON.stringify({ name: "Cy", weights: { browInnerUp: 1 } }),
    })).blob();
    await files.take(new File([file], "cy.pdeface"));
  });
  found.opened = await page.evaluate(() => [studio.doc.name, studio.doc.weights]);
  expecting(true);
  await page.evaluate(() => files.take(new File(["<html>"], "face.png")));
  expecting(false);
  found.refused = await page.locator(".toast.bad").last().textContent();
  await page.evaluate(async () => {
    const blob = await api.save(studio.doc.face, "Dee", { noseWidth: 1 });
    await blend.with(new File([blob], "dee.pdeface"));
    await blend.mix(0.25);
  });
  found.blended = await page.evaluate(() => [studio.timeline.steps.at(-1).label, studio.doc.weights]);
  await page.getByRole("button", { name: "Close blend" }).click();
  await page.evaluate(() => files.take(new File(["Timecode,BlendshapeCount,JawOpen\n00:00:01:00.000,61,0\n00:00:01:30.000,61,1\n"], "take.csv")));
  found.recording = await page.evaluate(() => [motion.clip.name, motion.duration]);
  await page.getByRole("button", { name: "Close motion" }).click();
  await settle(page);
  return found;
}

// The server dies: sliders live on, nothing is lost, and a new server is told what it has to know.
async function alone(page, gone) {
  const found = await gone(() => page.evaluate(async () => {
    const before = pixels();
    studio.preview({ noseLength: 1, jawOpen: 0.8 });
    studio.commit("Alone");
    await new Promise((done) => setTimeout(done, 600));
    return { moved: changed(before, pixels()), told: [...document.querySelectorAll(".toast.bad")].at(-1)?.textContent };
  }));
  await page.evaluate(() => studio.commit("Together", { noseLength: 0.5 }));
  await settle(page);
  found.weights = await page.evaluate(() => ({ ...studio.doc.weights }));
  return found;
}

// What a program that looks for barriers finds to be serious, in every screen and both themes.
async function barriers(page) {
  const source = await readFile(join(import.meta.dirname, "../../client/node_modules/axe-core/axe.min.js"), "utf8");
  await page.evaluate(source);
  const found = [];
  const look = async (where) => {
    const { violations, passes } = await page.evaluate(() => axe.run());
    const serious = violations.filter(({ impact }) => ["serious", "critical"].includes(impact));
    for (const { id, nodes } of serious) found.push(`${where}: ${id} ${nodes.map((n) => n.html.slice(0, 90)).slice(0, 3)}`);
    return passes.length;
  };
  const passed = await look("page");
  await page.keyboard.press("l");
  await look("page in the other theme");
  await page.getByRole("button", { name: "Export", exact: true }).click();
  await look("export");
  await page.keyboard.press("Escape");
  await page.keyboard.press("l");
  await page.getByRole("button", { name: "Photo", exact: true }).click();
  await page.locator("circle[data-point=nose_tip]").waitFor();
  await look("photo");
  await page.keyboard.press("Escape");
  return { passed, found };
}

// Before and after, and a clip as a film.
async function shown(page, folder) {
  await page.evaluate(() => studio.commit("Long nose", { noseLength: 1 }));
  await settle(page);
  await page.evaluate(() => (window.before = pixels()));
  await page.keyboard.press("b");
  const found = { compared: await page.evaluate(() => changed(before, pixels())) };
  await page.keyboard.press("b");
  found.back = await page.evaluate(() => changed(before, pixels()));
  await page.getByRole("button", { name: "Motion" }).click();
  await page.locator("#clip").selectOption("blink");
  await page.waitForFunction(() => motion.clip?.name === "blink" && motion.time > 0, null, { polling: 20 });
  const [film] = await Promise.all([page.waitForEvent("download"), page.locator("#film").click()]);
  await film.saveAs(join(folder, "blink.webm"));
  await page.getByRole("button", { name: "Export", exact: true }).click();
  await page.locator('input[value="clip"]').check({ force: true });
  await page.locator("#film-pixels").selectOption("0");
  const [clip] = await Promise.all([page.waitForEvent("download"), page.locator("dialog #export").click()]);
  await clip.saveAs(join(folder, "clip.mp4"));
  found.clip = clip.suggestedFilename();
  const azimuth = await page.evaluate(() => viewer.azimuth);
  await page.getByRole("button", { name: "Export", exact: true }).click();
  await page.locator('input[value="turn"]').check({ force: true });
  await page.locator("#film-pixels").selectOption("0");
  await page.locator("#turn").selectOption("round");
  const [turn] = await Promise.all([page.waitForEvent("download"), page.locator("dialog #export").click()]);
  await turn.saveAs(join(folder, "turn.mp4"));
  found.turn = turn.suggestedFilename();
  found.turnedBack = (await page.evaluate(() => viewer.azimuth)) - azimuth;
  found.size = await page.evaluate(() => [viewer.canvas.width, viewer.canvas.clientWidth]);
  await page.getByRole("button", { name: "Close motion" }).click();
  await page.keyboard.press("Control+z");
  await settle(page);
  return found;
}

// The graphics card gives up: the page says so, and draws again when it is back.
async function lost(page) {
  await page.evaluate(() => (window.before = pixels()));
  await page.evaluate(() => viewer.renderer.forceContextLoss());
  const line = page.locator(".toast.bad", { hasText: "no longer draw" });
  await line.waitFor();
  await page.evaluate(() => viewer.renderer.forceContextRestore());
  await page.waitForFunction(() => !viewer.renderer.getContext().isContextLost(), null, { polling: 50 });
  await page.waitForTimeout(300);
  return { told: true, back: await page.evaluate(() => changed(before, pixels())) };
}

async function recovered(page) {
  await page.waitForTimeout(400);
  const before = await page.evaluate(() => [studio.timeline.steps.length, studio.doc]);
  await page.reload();
  await ready(page);
  const again = await page.locator("dialog.tour").count();
  const after = await page.evaluate(() => [studio.timeline.steps.length, studio.doc]);
  return { before, after, again };
}

// A reload while the server works on a scan: the page waits for it again.
async function waited(page, folder) {
  const bytes = (await readFile(join(folder, "scan.ply"))).toString("base64");
  await page.evaluate(async (text) => {
    const data = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    await files.take(new File([data], "again.ply"));
  }, bytes);
  await page.reload();
  await ready(page);
  await page.waitForFunction(() => scan.info && studio.shown === studio.doc.face, null, { polling: 50, timeout: 240_000 });
  return { name: await page.evaluate(() => studio.doc.name), label: await page.evaluate(() => studio.timeline.steps.at(-1).label) };
}
