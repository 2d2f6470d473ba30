// The studio on a tablet: the stage, the handles and the photo by fingers alone.

const TALL = { width: 820, height: 1180 };
const WIDE = { width: 1180, height: 820 };

// Fingers as a touch screen reports them: from some places to others, in steps.
function hand(session) {
  const send = (type, spots) => session.send("Input.dispatchTouchEvent", {
    type, touchPoints: spots.map(([x, y], id) => ({ x, y, id })),
  });
  return {
    // Left on the screen if `held`, as a finger that has not decided yet.
    async move(from, to, held = false) {
      await send("touchStart", from);
      for (let n = 1; n <= 6; n++) {
        await send("touchMove", from.map(([x, y], i) => [x + ((to[i][0] - x) * n) / 6, y + ((to[i][1] - y) * n) / 6]));
      }
      // A move is told of with the next picture.
      await new Promise((next) => setTimeout(next, 120));
      if (!held) await this.lift();
    },
    lift: () => send("touchEnd", []),
  };
}

export async function touched(browser, home, help, visible) {
  const context = await browser.newContext({ viewport: TALL, hasTouch: true, isMobile: false });
  const page = await context.newPage();
  page.setDefaultTimeout(90_000);
  await page.addInitScript(() => localStorage.setItem("pdeface.studio.1.seen", "yes"));
  await page.goto(home);
  await page.waitForFunction(() => document.documentElement.dataset.ready, null, { polling: 100 });
  await page.evaluate(help, visible);
  await page.locator("#density").selectOption("0");
  await page.waitForFunction(() => studio.head.size.rows === 28 && studio.head.morph.ready, null, { polling: 50 });
  const fingers = hand(await context.newCDPSession(page));
  const report = { layout: [await layout(page)] };
  report.stage = await stage(page, fingers);
  report.sculpt = await sculpt(page, fingers);
  report.photo = await photo(page, fingers);
  report.behind = await behind(page, fingers);
  await page.setViewportSize(WIDE);
  report.layout.push(await layout(page));
  await context.close();
  return report;
}

// What sticks out of the page, and what is too small for a finger or hidden under something else.
const layout = (page) => page.evaluate(() => {
  const found = [];
  for (const button of document.querySelectorAll("#bar button, #stage .views button, #stage .modes button, .foot button")) {
    const { left, top, right, bottom, width, height } = button.getBoundingClientRect();
    if (!width) continue;
    const name = button.getAttribute("aria-label") ?? button.textContent;
    if (left < 0 || top < 0 || right > innerWidth || bottom > innerHeight) found.push(`${name} sticks out`);
    if (width < 24 || height < 24) found.push(`${name} is ${width} x ${height}`);
    const top_ = document.elementFromPoint((left + right) / 2, (top + bottom) / 2);
    if (!button.contains(top_)) found.push(`${name} is covered`);
  }
  return found;
});

async function middleOf(page, selector) {
  const box = await page.locator(selector).first().boundingBox();
  return [box.x + box.width / 2, box.y + box.height / 2];
}

const camera = (page) => page.evaluate(() => ({
  azimuth: viewer.azimuth,
  distance: viewer.camera.position.distanceTo(viewer.controls.target),
  target: viewer.controls.target.toArray(),
  height: viewer.canvas.clientHeight,
}));

async function stage(page, fingers) {
  const [x, y] = await middleOf(page, "#stage canvas");
  const found = { before: await camera(page) };
  const then = async (name, from, to) => {
    await page.evaluate(() => (window.before = pixels()));
    await fingers.move(from, to);
    await page.waitForTimeout(100);
    found[name] = { ...(await camera(page)), changed: await page.evaluate(() => changed(before, pixels())) };
  };
  await then("turned", [[x - 60, y]], [[x + 60, y]]);
  await then("pinched", [[x - 40, y], [x + 40, y]], [[x - 80, y], [x + 80, y]]);
  await then("moved", [[x - 40, y], [x + 40, y]], [[x - 40, y + 70], [x + 40, y + 70]]);
  await page.evaluate(() => viewer.look("front", false));
  return found;
}

// A finger beside a point of a curve takes it, and does not turn the face; nor does a second one.
async function sculpt(page, fingers) {
  await page.getByRole("button", { name: "Sculpt", exact: true }).tap();
  const place = { curve: 20, point: 11 };
  const at = () => page.evaluate((each) => handles.screen(each), place);
  const [before, face] = [await at(), await page.evaluate(() => studio.doc.face)];
  const azimuth = (await camera(page)).azimuth;
  await page.evaluate(() => (window.before = pixels()));
  const spot = [before.x + 4, before.y + 5];
  await fingers.move([spot], [[spot[0], spot[1] + 30]], true);
  await page.waitForFunction(() => changed(before, pixels()) > 1000, null, { polling: 30 });
  const live = await at();
  await fingers.lift();
  await page.waitForFunction((old) => studio.doc.face !== old && exact(), face, { polling: 30 });
  await page.waitForTimeout(300);
  const found = { before, live, after: await at(), label: await page.evaluate(() => studio.timeline.steps.at(-1).label) };
  found.turned = (await camera(page)).azimuth - azimuth;
  await page.getByRole("button", { name: "Sculpt", exact: true }).tap();
  await page.evaluate(() => studio.timeline.undo());
  await page.waitForFunction(() => exact(), null, { polling: 30 });
  return found;
}

async function photo(page, fingers) {
  await page.getByRole("button", { name: "Photo", exact: true }).tap();
  await page.locator("circle[data-point=nose_tip]").waitFor();
  await page.locator("#frame").tap();
  const view = () => page.locator(".photo svg").getAttribute("viewBox").then((text) => text.split(" ").map(Number));
  const middle = await middleOf(page, ".photo");
  const [x, y] = [middle[0] + 140, middle[1] + 170];
  const found = { whole: await view() };
  await fingers.move([[x - 30, y], [x + 30, y]], [[x - 75, y], [x + 75, y]]);
  found.pinched = await view();
  await fingers.move([[x - 30, y], [x + 30, y]], [[x, y + 40], [x + 60, y + 40]]);
  found.moved = await view();
  await page.locator("#frame").tap();
  await page.locator("#frame").tap();
  found.face = await view();
  // Fingers that come down on points and part mean the photo.
  const on = await page.locator("circle[data-point=nose_tip]").boundingBox();
  await fingers.move([[on.x, on.y], [on.x + 60, on.y]], [[on.x - 30, on.y], [on.x + 90, on.y]]);
  found.over = await view();
  await page.locator("#frame").tap();
  await page.locator("#frame").tap();
  const nose = page.locator("circle[data-point=nose_tip]");
  const where = async () => [Number(await nose.getAttribute("cx")), Number(await nose.getAttribute("cy"))];
  const box = await nose.boundingBox();
  const spot = [box.x + box.width / 2 + 12, box.y + box.height / 2 + 9];
  found.point = await where();
  await fingers.move([spot], [[spot[0] + 20, spot[1] + 10]], true);
  found.loupe = await page.locator(".loupe").isVisible();
  found.dragged = await where();
  found.still = await view();
  await fingers.lift();
  found.gone = await page.locator(".loupe").isHidden();
  found.wide = (await page.locator(".photo").boundingBox()).width;
  await page.keyboard.press("Escape");
  await page.locator("dialog").waitFor({ state: "detached" });
  return found;
}

// The photo behind the face, and the face with it.
async function behind(page, fingers) {
  await page.evaluate(() => document.activeElement?.blur());
  await page.keyboard.press("o");
  await page.waitForFunction(() => overlay.open && document.querySelector(".behind").naturalWidth > 0, null, { polling: 30 });
  const seen = () => page.evaluate(() => [overlay.onStage(0, 0), overlay.onStage(1, 0)]);
  const zoom = ([corner, next]) => next[0] - corner[0];
  const [x, y] = await middleOf(page, "#stage canvas");
  const before = await seen();
  await fingers.move([[x - 50, y], [x + 50, y]], [[x - 100, y], [x + 100, y]]);
  const pinched = await seen();
  await fingers.move([[x, y]], [[x + 30, y + 20]]);
  const moved = await seen();
  await page.keyboard.press("o");
  return { magnified: zoom(pinched) / zoom(before), moved: [0, 1].map((k) => moved[0][k] - pinched[0][k]) };
}
