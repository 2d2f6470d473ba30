// Opens files in a browser and prints, as JSON, what three.js makes of them.
//   node check.mjs BROWSER FOLDER: BROWSER is a program, FOLDER holds face.glb, take.glb and
//   before.json, the weights to set before a target is seen
import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { extname, join, normalize } from "node:path";
import { chromium } from "playwright-core";

const [browserPath, folder] = process.argv.slice(2);
const TYPES = { ".html": "text/html", ".mjs": "text/javascript", ".js": "text/javascript" };
const FLAGS = [
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
];

// What the page asks for lies beside this file; the faces lie in FOLDER.
const server = createServer(async (request, response) => {
  const path = normalize(new URL(request.url, "http://localhost").pathname);
  const root = path.endsWith(".glb") ? folder : import.meta.dirname;
  try {
    const body = await readFile(join(root, path));
    response.writeHead(200, { "Content-Type": TYPES[extname(path)] ?? "model/gltf-binary" });
    response.end(body);
  } catch {
    response.writeHead(404).end();
  }
});
await new Promise((ready) => server.listen(0, "127.0.0.1", ready));
const home = `http://127.0.0.1:${server.address().port}`;

// Playwright gives each start an empty folder of its own for the user's data.
const browser = await chromium.launch({ executablePath: browserPath, args: FLAGS });
try {
  const page = await browser.newPage();
  const complaints = [];
  page.on("pageerror", (error) => complaints.push(String(error)));
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) complaints.push(message.text());
  });
  page.on("request", (request) => {
    const url = request.url();
    if (!url.startsWith(home) && !/^(data|blob):/.test(url)) complaints.push(`asked for ${url}`);
  });
  await page.goto(`${home}/page.html`);
  await page.waitForFunction(() => window.take);
  const before = JSON.parse(await readFile(join(folder, "before.json"), "utf8"));
  const targets = await page.evaluate((each) => window.targets("/face.glb", each), before);
  const take = await page.evaluate(() => window.take("/take.glb"));
  console.log(JSON.stringify({ targets, take, complaints }));
} finally {
  await browser.close();
  server.close();
}
