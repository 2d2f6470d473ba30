// The screens of the studio: how one comes to each, and how one leaves it.

const button = (name) => ({ page }) => page.getByRole("button", { name, exact: true }).first().click();
const key = (name) => async ({ page, idle }) => {
  await page.locator("#stage canvas").first().focus();
  await page.keyboard.press(name);
  await idle();
};
const both = (...acts) => async (tools) => {
  for (const act of acts) await act(tools);
};
const set = (label, weights) => ({ page }) =>
  page.evaluate(([text, values]) => studio.commit(text, values), [label, weights]);
const tab = (name) => ({ page }) => page.getByRole("tab", { name }).click();

// As a person opens a file: by the bar's button.
const open = (...files) => async ({ page, job }) => {
  const [chooser] = await Promise.all([
    page.waitForEvent("filechooser"), page.getByRole("button", { name: "Open", exact: true }).click(),
  ]);
  await chooser.setFiles(files.map((name) => job.files[name]));
};
const label = (text) => ({ page }) =>
  page.waitForFunction((wanted) => studio.timeline.steps.at(-1).label.startsWith(wanted)
    && studio.shown === studio.doc.face && studio.head.morph.ready, text, { polling: 100 });
const escape = async ({ page }) => {
  await page.keyboard.press("Escape");
  await page.locator("dialog").waitFor({ state: "detached" });
};
const closeMotion = ({ page }) => page.evaluate(() => motion.close());
const texture = (way) => ({ page }) => page.waitForFunction((wanted) => {
  const image = document.querySelector("#texture");
  return image?.naturalWidth > 0 && image.dataset.way === wanted;
}, way, { polling: 50 });

export const SCENES = [
  { name: "tour", always: true, leave: escape },
  { name: "first" },
  { name: "front", enter: key("1"), leave: key("2") },
  { name: "profile", enter: key("3"), leave: key("2") },
  { name: "help", enter: key("?"), leave: escape },
  { name: "modes-shaded", enter: button("Shaded") },
  { name: "modes-curvature", enter: button("Curvature") },
  { name: "modes-wireframe", enter: button("Wireframe") },
  { name: "modes-uvmesh", enter: button("UV mesh") },
  { name: "modes-curves", enter: button("Curves"), leave: button("Textured") },
  { name: "modes-overlay", enter: key("c"), leave: key("c") },
  { name: "orthographic", enter: key("p"), leave: key("p") },
  {
    name: "shape", enter: both(set("Wide nose", { noseWidth: 1 }), set("Strong jaw", { jawWidth: 1, chinHeight: 0.6 })),
    leave: ({ page }) => page.evaluate(() => studio.timeline.go(0)),
  },
  { name: "identity", enter: both(tab("Identity"), button("Random")), leave: ({ page }) => page.evaluate(() => studio.timeline.go(0)) },
  {
    name: "expression", enter: both(tab("Expression"), async ({ page, idle }) => {
      await page.locator("#preset").selectOption("happy");
      await idle();
    }),
  },
  {
    name: "marks", enter: async ({ page, idle }) => {
      await page.locator("#search").fill("jaw");
      await page.locator("[data-control=jawOpen] [data-mark=mute]").click();
      await page.locator("[data-control=jawForward] [data-mark=lock]").click();
      await idle();
    },
    leave: ({ page }) => page.evaluate(() => {
      studio.marks.clear();
      document.querySelector("#search").value = "";
      document.querySelector("#search").dispatchEvent(new Event("input"));
    }),
  },
  {
    name: "search-empty", enter: ({ page }) => page.locator("#search").fill("elbow"),
    leave: ({ page }) => page.locator("#search").fill(""),
  },
  { name: "history", enter: button("History"), leave: ({ page }) => page.locator("#stage canvas").first().click({ position: { x: 20, y: 20 } }) },
  { name: "compare", enter: key("b"), leave: key("b") },
  {
    name: "sculpt", enter: both(key("d"), async ({ page }) => {
      const { x, y } = await page.evaluate(() => handles.screen({ curve: 20, point: 11 }));
      await page.mouse.move(x, y);
      await page.mouse.down();
      await page.mouse.move(x + 10, y + 30, { steps: 4 });
      await page.waitForTimeout(1500);
    }),
    leave: async ({ page }) => {
      await page.mouse.up();
      await page.waitForTimeout(1500);
      await page.evaluate(() => (handles.toggle(), studio.timeline.undo()));
      await page.waitForTimeout(800);
    },
  },
  { name: "sculpt-curve", enter: both(key("d"), button("Curve")), leave: both(button("Point"), key("d")) },
  { name: "motion", enter: both(button("Motion"), async ({ page }) => {
    await page.locator("#clip").selectOption("talk");
    await page.waitForFunction(() => motion.clip?.name === "talk" && motion.time > 0.3, null, { polling: 30 });
    await page.evaluate(() => (motion.pause(), motion.seek(0.9)));
  }) },
  { name: "export", enter: button("Export") },
  { name: "export-glb-light", enter: ({ page }) => page.locator('input[value="turn"]').check({ force: true }) },
  { name: "export-still", enter: ({ page }) => page.locator('input[value="still"]').check({ force: true }), leave: both(escape, closeMotion) },
  {
    name: "recording", enter: both(open("recording"), ({ page }) => page.waitForFunction(() => motion.clip?.times.length > 2, null, { polling: 50 }), ({ page }) => page.evaluate(() => motion.pause())),
    leave: closeMotion,
  },
  {
    name: "error", enter: open("wrong"),
    leave: ({ page }) => page.evaluate(() => document.querySelector("#toasts").replaceChildren()),
  },
  { name: "photo-project", enter: both(button("Photo"), texture("project")) },
  { name: "photo-warp", enter: both(button("Warped"), texture("warp")) },
  {
    name: "photo-loupe", enter: async ({ page, idle }) => {
      const box = await page.locator("circle[data-point=nose_tip]").boundingBox();
      await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
      await page.mouse.down();
      await page.mouse.move(box.x + 14, box.y + 10, { steps: 3 });
      await idle();
    },
    leave: both(({ page }) => page.mouse.up(), escape),
  },
  {
    name: "overlay", enter: both(key("o"), ({ page }) => page.waitForFunction(() => document.querySelector(".behind").naturalWidth > 0, null, { polling: 50 })),
  },
  {
    name: "overlay-sculpt", enter: key("d"),
    leave: both(key("d"), key("o")),
  },
  {
    name: "blend", enter: both(tab("Shape"), async ({ page, job, idle }) => {
      const [chooser] = await Promise.all([page.waitForEvent("filechooser"), page.getByRole("button", { name: "Blend", exact: true }).click()]);
      await chooser.setFiles(job.files.face);
      await page.locator("#share").fill("0.5");
      await page.locator("#share").dispatchEvent("change");
      await idle();
    }),
    leave: both(button("Close blend"), ({ page }) => page.evaluate(() => studio.timeline.go(0))),
  },
  {
    name: "webcam", enter: both(button("Webcam"), ({ page }) => page.waitForFunction(() => webcam.latest && webcam.frames > 4, null, { polling: 100 })),
    leave: ({ page }) => page.evaluate(() => webcam.close()),
  },
  {
    name: "photo-fitting", enter: both(open("photo"), ({ page }) => page.waitForFunction(() => !document.querySelector(".progress").hidden && document.querySelector("progress").value > 0.2, null, { polling: 50 })),
    leave: label("Open"),
  },
  { name: "photo-fitted", leave: ({ page }) => page.evaluate(() => document.querySelector("#toasts").replaceChildren()) },
  {
    name: "scan-fitting", enter: both(open("scan"), ({ page }) => page.waitForFunction(() => files.fitting?.rounds > 0, null, { polling: 20 })),
  },
  { name: "scan-fitting-later", enter: ({ page }) => page.waitForFunction(() => files.fitting.rounds > 11, null, { polling: 20 }),
    leave: both(({ page }) => page.waitForFunction(() => scan.info, null, { polling: 100 }), label("Open")),
  },
  { name: "scan", enter: ({ page }) => page.waitForTimeout(2500) },
  { name: "scan-veil", enter: both(button("Show scan"), ({ page }) => page.waitForTimeout(1200)), leave: both(button("Show scan"), button("Without the scan")) },
  {
    name: "server-gone", enter: async ({ page, stop }) => {
      await stop();
      await page.evaluate(() => studio.commit("Alone", { noseLength: 1 }));
      await page.waitForTimeout(800);
    },
    leave: async ({ page, start }) => {
      await start();
      await page.waitForTimeout(2500);
    },
  },
  {
    name: "recovered", enter: async ({ page }) => {
      await page.reload();
      await page.waitForFunction(() => document.documentElement.dataset.ready, null, { polling: 100 });
    },
  },
];
