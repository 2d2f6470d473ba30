// Times the studio's page and prints what it found as JSON: node reach.mjs BROWSER PYTHON
import { spawn } from "node:child_process";
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { join } from "node:path";

const require = createRequire(join(import.meta.dirname, "../../tests/browser/package.json"));
const { chromium } = require("playwright-core");
const [browserPath, python] = process.argv.slice(2);

const server = spawn(python, ["-m", "pdeface", "studio", "--no-browser", "--port", "0"]);
const home = await new Promise((resolve) =>
  server.stdout.on("data", (data) => resolve(/http:\S+/.exec(String(data))[0])));
const args = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-background-networking"];
const browser = await chromium.launch({ executablePath: browserPath, args });
try {
  const page = await browser.newPage({ viewport: { width: 640, height: 400 } });
  const ready = () => page.waitForFunction(() => document.documentElement.dataset.ready, null, { polling: 10 });
  await page.goto(home);
  await ready();
  await page.waitForTimeout(1000);
  await page.reload();
  await ready();
  const found = await page.evaluate(async () => {
    const gl = viewer.renderer.getContext();
    const named = gl.getExtension("WEBGL_debug_renderer_info");
    const pixel = new Uint8Array(4);
    // Until the last pixel is drawn, whoever draws it.
    const seen = () => (viewer.drawNow(), gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel));
    const median = (values) => values.sort((a, b) => a - b)[values.length >> 1];
    const times = (count, work) => median(Array.from({ length: count }, (_, i) => {
      const start = performance.now();
      work(i);
      seen();
      return performance.now() - start;
    }));
    const next = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
    times(5, () => {});
    const frame = times(20, () => {});
    const slider = times(40, (i) => studio.preview({ noseLength: i / 40 }));
    studio.commit("Moves");
    const before = viewer.frames;
    for (let i = 0; i < 40; i++) {
      studio.preview({ noseLength: i / 40 });
      await next();
    }
    const drawn = viewer.frames - before;
    studio.commit("Moves");
    const start = performance.now();
    const { arrays } = await api.response(studio.doc.face, studio.size, [[20, 11, 1]], true);
    const response = performance.now() - start;
    const columns = arrays.get("skin");
    const extra = new Float32Array(studio.head.morph.positions.length);
    const curve = times(40, (i) => {
      for (let n = 0; n < columns.length; n++) extra[n] = (i / 4e4) * columns[n];
      studio.head.morph.setExtra(extra);
      studio.redraw();
    });
    const [shown, moves] = ["shown", "ready"].map((name) => performance.getEntriesByName(name)[0].startTime);
    const renderer = gl.getParameter(named?.UNMASKED_RENDERER_WEBGL ?? gl.RENDERER);
    return { ready: shown, moves, frame, slider, drawn, response, curve, renderer };
  });
  const status = await readFile(`/proc/${server.pid}/status`, "utf8").catch(() => "");
  const memory = Number(/VmHWM:\s+(\d+)/.exec(status)?.[1] ?? NaN) / 1024;
  console.log(JSON.stringify({ ...found, memory }));
} finally {
  await browser.close();
  server.kill();
}
