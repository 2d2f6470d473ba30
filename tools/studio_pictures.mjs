// Takes a picture of every screen, dialogue and state of the studio, to be looked at.
//   node studio_pictures.mjs JOB: JOB is a JSON file that studio_pictures.py has written.
import { spawn } from "node:child_process";
import { mkdir, readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { join } from "node:path";
import { SCENES } from "./studio_scenes.mjs";

const root = join(import.meta.dirname, "..");
const require = createRequire(join(root, "tests/browser/package.json"));
const { chromium } = require("playwright-core");
const job = JSON.parse(await readFile(process.argv[2], "utf8"));
const FLAGS = [
  "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-background-networking",
  "--use-fake-device-for-media-stream", "--use-fake-ui-for-media-stream",
  `--use-file-for-fake-video-capture=${job.camera}`,
];

let server = null;

function serve(port = 0) {
  const words = ["-m", "pdeface", "studio", "--no-browser", "--port", String(port)];
  server = spawn(job.python, words, { stdio: ["ignore", "pipe", "inherit"] });
  return new Promise((resolve, reject) => {
    server.stdout.on("data", (data) => {
      const found = /http:\S+/.exec(String(data));
      if (found) resolve(found[0]);
    });
    server.on("exit", (code) => code && reject(new Error(`the studio ended with ${code}`)));
  });
}

function stop() {
  const ended = new Promise((resolve) => server.once("exit", resolve));
  server.kill();
  return ended;
}

// What is seen with a graphics card: the processor draws here, but says that it is one.
function cardlike() {
  const original = WebGL2RenderingContext.prototype.getParameter;
  WebGL2RenderingContext.prototype.getParameter = function (name) {
    const value = original.call(this, name);
    return typeof value === "string" ? value.replace(/swiftshader|llvmpipe|software/gi, "card") : value;
  };
}

async function shoot(page, name) {
  for (const theme of job.themes) {
    await page.evaluate((wanted) => {
      if (document.documentElement.dataset.theme === wanted) return;
      document.body.dispatchEvent(new KeyboardEvent("keydown", { key: "l", bubbles: true }));
    }, theme);
    for (const size of job.sizes) {
      const [width, height] = size.split("x").map(Number);
      await page.setViewportSize({ width, height });
      await page.waitForTimeout(job.wait);
      const path = join(job.out, `${name}-${size}-${theme}.${job.jpeg ? "jpg" : "png"}`);
      await page.screenshot({ path, ...(job.jpeg ? { type: "jpeg", quality: job.jpeg } : {}) });
    }
  }
  await page.setViewportSize({ width: 1440, height: 900 });
}

await mkdir(job.out, { recursive: true });
const home = await serve();
const browser = await chromium.launch({ executablePath: job.browser, args: FLAGS });
try {
  const context = await browser.newContext({ viewport: { width: 1440, height: 900 }, hasTouch: job.touch });
  if (job.card) await context.addInitScript(cardlike);
  const page = await context.newPage();
  page.setDefaultTimeout(120_000);
  page.on("pageerror", (error) => console.error("page:", String(error)));
  await page.goto(home);
  await page.waitForFunction(() => document.documentElement.dataset.ready, null, { polling: 100 });
  const tools = {
    page, job, context, home, stop, start: () => serve(new URL(home).port),
    idle: () => page.waitForTimeout(job.wait),
  };
  for (const { name, enter, leave, always } of SCENES) {
    const wanted = !job.only.length || job.only.some((part) => name.startsWith(part));
    if (!wanted && !always) continue;
    try {
      await enter?.(tools);
      if (wanted) await shoot(page, name);
      await leave?.(tools);
      console.error(name);
    } catch (error) {
      console.error(name, "failed:", String(error).split("\n")[0]);
      await page.screenshot({ path: join(job.out, `${name}-failed.png`) });
    }
  }
} finally {
  await browser.close();
  server.kill();
}
