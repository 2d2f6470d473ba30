// Uses the studio in a real browser and prints, as JSON, what came of it.
//   node browser.mjs BROWSER PYTHON FACE FOLDER: FACE is the .pdeface file to begin with, FOLDER is
//   where downloads go and camera.y4m is what the camera sees. playwright-core is taken from
//   tests/browser.
import { spawn } from "node:child_process";
import { createRequire } from "node:module";
import { join } from "node:path";
import { flows, help, VISIBLE } from "./flows.mjs";
import { touched } from "./touch.mjs";

const require = createRequire(join(import.meta.dirname, "..", "browser", "package.json"));
const { chromium } = require("playwright-core");
const [browserPath, python, face, folder] = process.argv.slice(2);
const FLAGS = [
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
  "--use-fake-device-for-media-stream",
  "--use-fake-ui-for-media-stream",
  `--use-file-for-fake-video-capture=${join(folder, "camera.y4m")}`,
];

let server = null;

// Starts the studio and resolves to its address; the same port again for the same page.
function serve(port = 0) {
  const words = ["-m", "pdeface", "studio", face, "--no-browser", "--port", String(port)];
  server = spawn(python, words, { stdio: ["ignore", "pipe", "inherit"] });
  return new Promise((resolve, reject) => {
    server.stdout.on("data", (data) => {
      const found = /http:\S+/.exec(String(data));
      if (found) resolve(found[0]);
    });
    server.on("exit", (code) => reject(new Error(`the studio ended with ${code}`)));
  });
}

function stop() {
  const ended = new Promise((resolve) => server.once("exit", resolve));
  server.kill();
  return ended;
}

const home = await serve();
const port = new URL(home).port;
const browser = await chromium.launch({ executablePath: browserPath, args: FLAGS });
try {
  const page = await browser.newPage({ viewport: { width: 1000, height: 640 } });
  page.setDefaultTimeout(90_000);
  const complaints = [];
  let expected = false;
  page.on("pageerror", (error) => complaints.push(String(error.stack ?? error)));
  page.on("console", (message) => {
    // Chromium itself complains of refusals and of a server that is gone, which some flows want.
    if (["error", "warning"].includes(message.type()) && !expected) complaints.push(message.text());
  });
  page.on("request", (request) => {
    const url = request.url();
    if (!url.startsWith(home) && !/^(data|blob):/.test(url)) complaints.push(`asked for ${url}`);
  });
  const gone = async (work) => {
    expected = true;
    await stop();
    const result = await work();
    await serve(port);
    return result;
  };
  await page.goto(home);
  const report = await flows(page, { folder, gone, expecting: (value) => (expected = value) });
  report.touch = await touched(browser, home, help, VISIBLE);
  console.log(JSON.stringify({ ...report, complaints }));
} finally {
  await browser.close();
  server.kill();
}
