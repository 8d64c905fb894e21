// measure.mjs PROGRAM SEQUENCE [WIDTH HEIGHT]: how fast the page draws 200,000 landmarks, 1,000 keyframes and a mesh of a
// million triangles in headless Chromium with software rendering: wall time, and CPU time of all of Chromium, which does
// not depend on what else the machine does.
import { readdirSync, readFileSync } from "node:fs";
import playwright from "playwright-core";
import { showBigScene } from "./big_scene.mjs";
import { startRun } from "./program.mjs";

const [program, sequence, width = 1440, height = 860] = process.argv.slice(2);
// CPU milliseconds that a process and its children have used so far.
function cpu(root) {
  const processes = new Map();
  for (const pid of readdirSync("/proc").filter((name) => /^[0-9]+$/.test(name))) {
    try {
      const fields = readFileSync(`/proc/${pid}/stat`, "utf8").replace(/^.*\) /, "").split(" ");
      processes.set(Number(pid), { parent: Number(fields[1]), ms: 10 * (Number(fields[11]) + Number(fields[12])) });
    } catch { /* it has ended */ }
  }
  const isOurs = (pid) => pid === root || (processes.has(pid) && isOurs(processes.get(pid).parent));
  let sum = 0;
  for (const [pid, { ms }] of processes) if (isOurs(pid)) sum += ms;
  return sum;
}

const server = await playwright.chromium.launchServer({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
const browser = await playwright.chromium.connect(server.wsEndpoint());
const run = await startRun(program, sequence);
try {
  const page = await browser.newPage({ viewport: { width: Number(width), height: Number(height) } });
  await page.goto(`${run.link}#paused`);
  while (!await page.evaluate(() => window.stdcViewer.model.frames.length > 0)) await page.waitForTimeout(100);
  await page.waitForTimeout(1500);
  console.log(await page.evaluate(showBigScene));
  const measure = async (name, level) => {
    const count = level > 0 ? 40 : 12;
    await page.evaluate((l) => window.stdcViewer.measure(window.stdcViewer.scene, 2, l), level);
    const before = cpu(server.process().pid);
    const times = await page.evaluate(([n, l]) => window.stdcViewer.measure(window.stdcViewer.scene, n, l), [count, level]);
    times.sort((x, y) => x - y);
    console.log(`${name}: ${times[count >> 1].toFixed(0)} ms, ${((cpu(server.process().pid) - before) / count).toFixed(0)} ms of CPU a picture`);
  };
  // As somebody sees it who turns the view: everything that the browser does for it is in there.
  const turn = async () => {
    await page.evaluate(() => window.stdcViewer.turning(window.stdcViewer.scene, 4000));  // until it knows how much it can draw
    const before = cpu(server.process().pid);
    const times = (await page.evaluate(() => window.stdcViewer.turning(window.stdcViewer.scene, 6000))).slice(1).sort((x, y) => x - y);
    const used = cpu(server.process().pid) - before, sum = times.reduce((a, b) => a + b, 0);
    console.log(`turned, level ${await page.evaluate(() => window.stdcViewer.scene.detail.value)}: ` +
      `${(1000 * times.length / sum).toFixed(1)} pictures a second, ${times[times.length >> 1].toFixed(0)} ms (median), ` +
      `${(used / times.length).toFixed(0)} ms of CPU a picture, ` +
      await page.evaluate(() => `canvas ${window.stdcViewer.scene.canvas.width} x ${window.stdcViewer.scene.canvas.height}`));
  };
  const layers = async (shown) => {
    await page.evaluate((names) => {
      for (const name of ["path", "truth", "keyframes", "covisibility", "landmarks", "mesh"]) {
        window.stdcViewer.scene.setLayer(name, names.includes(name));
      }
    }, shown);
  };
  await measure("all", 0);
  await measure("while it changes: coarse mesh, every tenth landmark", 1);
  await measure("the same with 0.7 of the pixels a side", 2);
  await measure("the same with half", 3);
  await turn();
  for (const one of ["mesh", "landmarks", "path", "keyframes", "covisibility"]) {
    await layers([one]);
    await measure(`${one} alone`, 0);
    await measure(`${one} alone, while it changes`, 3);
  }
  await layers(["path", "truth", "keyframes", "covisibility", "landmarks", "mesh"]);
  await page.waitForTimeout(500);
  await page.screenshot({ path: "/tmp/stdc-view-measure.png" });
} finally {
  await run.stop();
  await browser.close();
  await server.close();
}
