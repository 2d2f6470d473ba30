// Runs a notebook in JupyterLab, as a reader would, and prints, as JSON, what came of it.
//   node notebook.mjs BROWSER PYTHON FOLDER: FOLDER holds face.ipynb.
import { spawn } from "node:child_process";
import { createRequire } from "node:module";
import { createServer } from "node:net";
import { join } from "node:path";

const require = createRequire(join(import.meta.dirname, "..", "browser", "package.json"));
const { chromium } = require("playwright-core");
const [browserPath, python, folder] = process.argv.slice(2);

const free = () => new Promise((resolve) => {
  const probe = createServer().listen(0, "127.0.0.1", () => {
    const { port } = probe.address();
    probe.close(() => resolve(port));
  });
});

const port = await free();
const words = [
  "-m", "jupyterlab", "--no-browser", "--allow-root", "--ip=127.0.0.1", `--port=${port}`,
  `--ServerApp.root_dir=${folder}`, "--IdentityProvider.token=", "--ServerApp.password=",
  "--LabApp.news_url=None", "--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate",
];
const server = spawn(python, words, { stdio: ["ignore", "ignore", "pipe"] });
let said = "";
server.stderr.on("data", (data) => (said += data));
const up = async () => {
  for (let n = 0; n < 300; n++) {
    if (await fetch(`http://127.0.0.1:${port}/api`).then(({ ok }) => ok, () => false)) return;
    await new Promise((resolve) => setTimeout(resolve, 200));
  }
  throw new Error(`JupyterLab did not begin: ${said}`);
};
await up();
const browser = await chromium.launch({
  executablePath: browserPath, args: ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
try {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  page.setDefaultTimeout(90_000);
  await page.goto(`http://127.0.0.1:${port}/lab/tree/face.ipynb?reset`);
  const cells = page.locator(".jp-Notebook .jp-CodeCell");
  // A key that is pressed while the notebook is still being put together is lost: a cell that was
  // told to run has a star until its answer, then a number.
  const run = async (n) => {
    const prompt = cells.nth(n).locator(".jp-InputArea-prompt");
    for (let tries = 0; tries < 20; tries++) {
      await cells.nth(n).locator(".cm-content").click();
      await page.keyboard.press("Shift+Enter");
      const heard = prompt.filter({ hasText: /\[(\*|\d+)\]/ }).waitFor({ timeout: 5_000 });
      if (await heard.then(() => true, () => false)) break;
    }
    await prompt.filter({ hasText: /\[\d+\]/ }).waitFor();
  };
  await page.locator(".jp-Notebook-ExecutionIndicator[data-status=idle]").waitFor();
  await run(0);
  const view = page.locator(".pdeface-widget");
  await view.locator("canvas").waitFor();
  const shot = () => view.locator("canvas").screenshot();
  const settled = async () => {
    let before = await shot();
    for (let n = 0; n < 60; n++) {
      await page.waitForTimeout(300);
      const now = await shot();
      if (before.equals(now)) return now;
      before = now;
    }
    throw new Error("the face does not come to rest");
  };
  const report = { sliders: await view.locator("input[type=range]").count() };
  const slider = view.locator("[data-control=noseLength]");
  await page.waitForFunction(() => document.querySelector("[data-control=noseLength]").value === "0.25");
  const rest = await settled();
  await slider.fill("1");
  report.seen = !rest.equals(await settled());
  await run(1);
  report.told = await cells.nth(1).locator(".jp-OutputArea-output").textContent();
  await run(2);
  await page.waitForFunction(() => document.querySelector("[data-control=jawOpen]").value === "0.5");
  report.nose = await slider.inputValue();
  const moved = await settled();
  await view.screenshot({ path: join(folder, "notebook.png") });
  report.moved = !rest.equals(moved);
  console.log(JSON.stringify(report));
} catch (error) {
  error.message += `\nJupyterLab said:\n${said.slice(-3000)}`;
  throw error;
} finally {
  await browser.close();
  server.kill();
}
