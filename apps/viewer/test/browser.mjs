// browser.mjs PROGRAM SEQUENCE [PICTURES]: opens the page of a run in headless Chromium and uses it. With PICTURES it
// leaves screenshots in that folder. Ends with 1 and says what is wrong, or with 3 if there is no Chromium.
import { existsSync, mkdirSync } from "node:fs";
import { join } from "node:path";
import { startRun } from "./program.mjs";

const [program, sequence, pictures] = process.argv.slice(2);
const chromium = process.env.CHROMIUM ?? "/usr/bin/chromium";
if (!existsSync(chromium)) {
  console.error("browser.mjs: chromium is not installed: apt-get install chromium");
  process.exit(3);
}
let playwright;
try {
  playwright = await import("playwright-core");
} catch {
  console.error("browser.mjs: playwright-core is not installed: npm ci in apps/viewer");
  process.exit(3);
}

const failures = [];
function check(condition, what) {
  if (!condition) failures.push(what);
  console.log(`${condition ? "ok  " : "FAIL"} ${what}`);
}

const software = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
const launch = (flags) => playwright.chromium.launch({ executablePath: chromium, args: ["--no-sandbox", "--no-first-run", ...flags] });

// A page whose complaints and requests are noted.
async function open(browser, link, options) {
  const context = await browser.newContext(options);
  const page = await context.newPage();
  const complaints = [], strangers = [];
  page.on("console", (message) => { if (message.type() === "error") complaints.push(message.text()); });
  page.on("pageerror", (error) => complaints.push(String(error)));
  page.on("request", (request) => {
    const url = new URL(request.url());
    if (url.protocol.startsWith("http") && url.host !== new URL(link).host) strangers.push(request.url());
  });
  await page.goto(link);
  return { page, complaints, strangers, close: () => context.close() };
}

const frames = (page) => page.evaluate(() => window.stdcViewer.model.frames.length);
const pathPoints = (page) => page.evaluate(() => window.stdcViewer.model.path().length / 3);
// Playwright's own waitForFunction evaluates text, which the page's policy forbids.
async function until(page, condition, argument) {
  for (const end = Date.now() + 60000; Date.now() < end; await page.waitForTimeout(40)) {
    if (await page.evaluate(condition, argument)) return;
  }
  throw new Error(`never came true: ${condition}`);
}
const picture = async (page, name) => {
  if (!pictures) return;
  mkdirSync(pictures, { recursive: true });
  await page.screenshot({ path: join(pictures, `${name}.png`) });
};

async function useDesktop(browser) {
  const run = await startRun(program, sequence, ["--quiet", "--view-address", "127.0.0.1", "--dense", "/tmp/stdc-view-mesh.ply"]);
  try {
    const { page, complaints, strangers } = await open(browser, `${run.link}#paused`, { viewport: { width: 1440, height: 860 }, colorScheme: "light" });
    await until(page, () => window.stdcViewer.model.state?.paused && window.stdcViewer.model.frames.length > 0);
    await until(page, () => window.stdcViewer.picture.frame !== null);
    check(true, "the image is shown");
    const paused = await frames(page);
    await page.waitForTimeout(400);
    check(await frames(page) === paused, "the run is paused");
    await page.click("#step");
    await until(page, (count) => window.stdcViewer.model.frames.length === count + 1, paused);
    await page.waitForTimeout(300);
    check(await frames(page) === paused + 1, "one frame by a step");
    check((await page.textContent("#status-text")).includes("Paused"), "the page says that it is paused");
    await page.click('[data-image="depth"]');
    await until(page, () => document.querySelector("#far").textContent.endsWith("m"));
    await page.waitForTimeout(300);
    await picture(page, "depth");
    await page.click('[data-image="colour"]');
    const before = await pathPoints(page);
    for (let i = 1; i <= 15; ++i) {
      await page.click("#step");
      await until(page, (count) => window.stdcViewer.model.frames.length > count, paused + i);
    }
    check(await pathPoints(page) >= before + 10, "the trajectory grows");
    await until(page, () => window.stdcViewer.model.map?.keyframeIds.length > 0);
    const place = await page.evaluate(() => window.stdcViewer.scene.placeOfKeyframe(0));
    const box = await page.locator("#scene").boundingBox();
    await page.mouse.click(box.x + place.x, box.y + place.y);
    await until(page, () => document.querySelector("#keyframe-image").naturalWidth > 0);
    check(true, "a keyframe that is picked shows its image");
    await picture(page, "picked");
    await page.click("#keyframe-close");
    await page.click('[data-mode="top"]');
    await page.waitForTimeout(300);
    await picture(page, "top");
    await page.click('[data-mode="follow"]');
    await page.waitForTimeout(300);
    await picture(page, "follow");
    await page.click('[data-mode="orbit"]');
    await page.click("#fit");
    await page.click("#pause");
    await until(page, () => window.stdcViewer.model.state.finished);
    await page.waitForTimeout(2500);
    check((await page.textContent("#status-text")).startsWith("Finished"), "the page says that the run is finished");
    const shown = await page.evaluate(() => window.stdcViewer.model.state.mesh_triangles);
    check(shown > 1000, `the mesh is shown (${shown} triangles)`);
    await page.click("#fit");
    await page.waitForTimeout(300);
    await picture(page, "desktop");
    await page.click("#theme");
    await page.waitForTimeout(400);
    await picture(page, "dark");
    check((await run.ended).code === 0, "the run ends by itself");
    await page.waitForTimeout(1800);
    check((await page.textContent("#status-text")).startsWith("Finished"), "the page keeps what it has");
    const [frame, last] = await page.evaluate(() => [window.stdcViewer.picture.frame, window.stdcViewer.model.frames.at(-1).frame]);
    // Where nothing else runs it is the last one, as the test of the server demands; a starved browser may miss some.
    check(last - frame <= 4, `the image is that of the last frame (${frame} of ${last})`);
    check(complaints.length === 0, `no complaint in the console: ${complaints.join("; ")}`);
    check(strangers.length === 0, `no request to anybody else: ${strangers.join("; ")}`);
  } finally {
    await run.stop();
  }
}

async function usePhone(browser) {
  const run = await startRun(program, sequence, ["--realtime"]);
  try {
    const { page, complaints } = await open(browser, run.link,
      { viewport: { width: 390, height: 844 }, deviceScaleFactor: 2, isMobile: true, hasTouch: true, colorScheme: "dark" });
    await until(page, () => window.stdcViewer.model.frames.length > 30);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    check(wide <= 390, `nothing is wider than a phone (${wide} px)`);
    await page.waitForTimeout(300);
    await picture(page, "phone-image");
    await page.tap('[data-tab="curves"]');
    await page.waitForTimeout(400);
    await picture(page, "phone-curves");
    check(await page.locator("#chart-time").isVisible(), "the curves are shown on a phone");
    check(complaints.length === 0, `no complaint in the console of a phone: ${complaints.join("; ")}`);
  } finally {
    await run.stop();
  }
}

async function useWithoutWebGL() {
  const browser = await launch(["--disable-gpu", "--disable-3d-apis", "--disable-software-rasterizer"]);
  const run = await startRun(program, sequence);
  try {
    const { page } = await open(browser, run.link, { viewport: { width: 1280, height: 760 }, colorScheme: "light" });
    await until(page, () => window.stdcViewer.model.frames.length > 30 && window.stdcViewer.picture.frame !== null);
    check(await page.locator("#no-webgl").isVisible(), "without WebGL the page says so");
    check(await page.locator("#plan").isVisible(), "without WebGL there is a plan");
    await page.waitForTimeout(600);
    await picture(page, "no-webgl");
  } finally {
    await run.stop();
    await browser.close();
  }
}

const browser = await launch(software);
try {
  await useDesktop(browser);
  await usePhone(browser);
} finally {
  await browser.close();
}
await useWithoutWebGL();
if (failures.length > 0) {
  console.error(`browser.mjs: ${failures.length} failures: ${failures.join("; ")}`);
  process.exit(1);
}
