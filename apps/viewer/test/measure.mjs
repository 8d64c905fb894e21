// measure.mjs PROGRAM SEQUENCE [WIDTH HEIGHT]: how fast the page draws 200,000 landmarks, 1,000 keyframes and a mesh of a
// million triangles in headless Chromium with software rendering: wall time, and CPU time of all of Chromium, which does
// not depend on what else the machine does.
import { readdirSync, readFileSync } from "node:fs";
import playwright from "playwright-core";
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
  const result = await page.evaluate(async () => {
    const scene = window.stdcViewer.scene, model = window.stdcViewer.model;
    // A room of 8 x 3 x 8 m whose walls have bumps.
    const landmarks = new Float32Array(3 * 200000);
    for (let i = 0; i < landmarks.length; ++i) landmarks[i] = (Math.random() - 0.5) * (i % 3 === 1 ? 3 : 8);
    const keyframes = 1000, poses = new Float32Array(7 * keyframes), path = new Float32Array(3 * 10 * keyframes);
    for (let i = 0; i < keyframes; ++i) {
      poses.set([2 * Math.cos(i / 50), 0.2 * Math.sin(i / 9), 2 * Math.sin(i / 50), 0, 0, 0, 1], 7 * i);
    }
    for (let i = 0; i < 10 * keyframes; ++i) path.set([2 * Math.cos(i / 500), 0.2 * Math.sin(i / 90), 2 * Math.sin(i / 500)], 3 * i);
    const covisible = new Uint32Array(2 * 8 * keyframes);
    for (let i = 0; i < 8 * keyframes; ++i) covisible.set([i >> 3, Math.max(0, (i >> 3) - 1 - (i & 7))], 2 * i);
    const map = { map: 0, path, pathFrames: new Uint32Array(10 * keyframes), keyframeIds: new Uint32Array(keyframes),
      keyframeFrames: new Uint32Array(keyframes), keyframePoses: poses, covisible, shared: new Uint32Array(8 * keyframes),
      loops: new Uint32Array(), landmarks, truth: path };
    model.map = map;
    const side = 290, sheets = 6, vertices = side * side * sheets;
    const positions = new Uint16Array(3 * vertices), colours = new Uint8Array(3 * vertices);
    const triangles = new Uint32Array(3 * 2 * (side - 1) * (side - 1) * sheets);
    let v = 0, t = 0;
    for (let s = 0; s < sheets; ++s) {
      const first = v;
      for (let i = 0; i < side * side; ++i, ++v) {
        const a = (i % side) / (side - 1), b = Math.floor(i / side) / (side - 1), bump = 0.02 * Math.sin(40 * a) * Math.sin(40 * b);
        const wall = s & 1 ? 1 - bump : bump, point = [a, b];
        point.splice(s >> 1, 0, wall);
        positions.set(point.map((x) => 65535 * Math.min(1, Math.max(0, x))), 3 * v);
        colours.set([100 + 100 * a, 90 + 30 * s, 100 + 100 * b], 3 * v);
      }
      for (let i = 0; i < side * (side - 1); ++i) {
        if (i % side === side - 1) continue;
        const a = first + i, flip = (s & 1) === (s >> 1 === 1 ? 1 : 0);
        triangles.set(flip ? [a, a + 1, a + side, a + 1, a + side + 1, a + side] : [a, a + side, a + 1, a + 1, a + side, a + side + 1], t);
        t += 6;
      }
    }
    const begin = performance.now();
    scene.setMap(map);
    scene.setMesh({ corner: [-4, -1.5, -4], size: [8, 3, 8], positions, colours, triangles });
    const taken = performance.now() - begin;
    scene.setPath(path);
    scene.fit();
    return [`taking it: ${taken.toFixed(0)} ms; ${triangles.length / 3} triangles, canvas ${scene.canvas.width} x ${scene.canvas.height}`];
  });
  console.log(result.join("\n"));
  const measure = async (name, level) => {
    const count = level > 0 ? 40 : 12;
    await page.evaluate((l) => window.stdcViewer.scene.measure(2, l), level);
    const before = cpu(server.process().pid);
    const times = await page.evaluate(([n, l]) => window.stdcViewer.scene.measure(n, l), [count, level]);
    times.sort((x, y) => x - y);
    console.log(`${name}: ${times[count >> 1].toFixed(0)} ms, ${((cpu(server.process().pid) - before) / count).toFixed(0)} ms of CPU a picture`);
  };
  // As somebody sees it who turns the view: everything that the browser does for it is in there.
  const turn = async () => {
    await page.evaluate(() => window.stdcViewer.scene.turning(4000));  // until it knows how much it can draw
    const before = cpu(server.process().pid);
    const times = (await page.evaluate(() => window.stdcViewer.scene.turning(6000))).slice(1).sort((x, y) => x - y);
    const used = cpu(server.process().pid) - before, sum = times.reduce((a, b) => a + b, 0);
    console.log(`turned, level ${await page.evaluate(() => window.stdcViewer.scene.level)}: ` +
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
