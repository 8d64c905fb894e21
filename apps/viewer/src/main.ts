import { currentTheme } from "./colours";
import { Connection } from "./connection";
import { Curves } from "./curves";
import { measure, turning } from "./measuring";
import { Model } from "./model";
import { Picture } from "./picture";
import { drawPlan } from "./plan";
import * as protocol from "./protocol";
import { Topic, Want } from "./protocol";
import { Layer, Scene3D } from "./scene";
import { ViewMode } from "./viewpoint";
import { counted, wordsFor } from "./words";

const element = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;
const model = new Model();
let connected = false, ended = false, stranger = "";
let scene: Scene3D | null = null;

const picture = new Picture(element<HTMLCanvasElement>("picture"), { depth: false, points: true, masks: true },
  (image) => scene?.setImage(image));
const curves = new Curves(model, () => { dirty.curves = true; });

// ---- three dimensions, or a plan where there is no WebGL

function startScene() {
  try {
    scene = new Scene3D(element<HTMLCanvasElement>("scene"), pickKeyframe);
  } catch {
    element("no-webgl").hidden = false;
    element("scene").hidden = true;
    element("plan").hidden = false;
    for (const id of ["modes", "fit", "layers", "scale"]) element(id).hidden = true;
  }
  scene?.setTheme(currentTheme());
}

function pickKeyframe(frame: number | null) {
  element("keyframe").hidden = frame === null;
  if (frame === null) return;
  element("keyframe-title").textContent = `Keyframe at frame ${frame}`;
  element("keyframe-note").textContent = "…";
  element<HTMLImageElement>("keyframe-image").removeAttribute("src");
  connection.send(`keyframe ${frame}`);
}

let keyframeUrl = "";
function showKeyframe(bytes: Uint8Array) {
  const { frame, image } = protocol.decodeKeyframe(bytes);
  if (element("keyframe").hidden) return;
  const at = model.map ? model.map.keyframeFrames.indexOf(frame) : -1;
  let shared = 0;
  model.map?.covisible.forEach((keyframe) => { if (keyframe === at) ++shared; });
  URL.revokeObjectURL(keyframeUrl);
  const picture = element<HTMLImageElement>("keyframe-image");
  picture.hidden = image === null;
  if (image) picture.src = keyframeUrl = URL.createObjectURL(image);
  element("keyframe-note").textContent =
    `${shared} edges to others${image ? "" : ". Its image is no longer kept"}`;
}

// ---- words

function drawWords() {
  const words = wordsFor(model, connected, ended), state = model.state;
  const chip = element("status");
  chip.dataset.mood = stranger ? "bad" : words.mood;
  element("sign").textContent = stranger ? "✕" : words.sign;
  element("status-text").textContent = stranger || words.text;
  element("notes").textContent = words.notes.join(" · ");
  element("notes").hidden = words.notes.length === 0;
  if (!state) return;
  document.title = `${state.name} · STDC-SLAM`;
  element("name").textContent = state.name;
  const count = model.total, all = state.expected_frames;
  element("progress-text").textContent = all ? `${count} of ${all} frames` : `${count} frames`;
  element<HTMLProgressElement>("progress").hidden = !all;
  if (all) Object.assign(element<HTMLProgressElement>("progress"), { max: all, value: Math.min(count, all) });
  const facts = [counted(state.keyframes, "keyframe"), counted(state.landmarks, "landmark")];
  if (state.loops > 0) facts.push(counted(state.loops, "loop"));
  if (state.mesh_triangles > 0) {
    facts.push(`${Math.round(state.mesh_triangles / 1000).toLocaleString("en")}k triangles at ${(100 * state.mesh_voxel).toFixed(0)} cm`);
  }
  if (state.ate !== null) facts.push(`error ${(100 * state.ate).toFixed(1)} cm (RMSE)`);
  element("facts").textContent = facts.join(" · ");
  const over = ended || state.finished;
  element("controls").hidden = !state.can_pause || over;
  element("pause").textContent = state.paused ? "▶ Go on" : "‖ Pause";
  element("pause").setAttribute("aria-pressed", String(state.paused));
  element("layer-truth").hidden = !state.truth;
  element("layer-mesh").hidden = !state.dense;
  element("mesh-hint").hidden = state.dense;
  element("mask-network").hidden = !state.network;
  element("mask-motion").hidden = !state.motion;
  drawEvents(state.events);
}

let drawnEvents = "";
function drawEvents(events: { frame: number; text: string }[]) {
  const key = JSON.stringify(events);
  if (key === drawnEvents) return;
  drawnEvents = key;
  const list = element("events");
  list.replaceChildren(...[...events].reverse().map(({ frame, text }) => {
    const row = document.createElement("li"), when = document.createElement("span");
    when.textContent = `${frame}`;
    row.append(when, text);
    return row;
  }));
  element("no-events").hidden = events.length > 0;
}

// ---- what is drawn anew at the next picture

let drawnScale = "";
function drawScale(bar: { metres: number; pixels: number }) {
  const width = `${bar.pixels.toFixed(0)}px`;
  const text = bar.metres >= 1 ? `${bar.metres} m` : `${(100 * bar.metres).toFixed(0)} cm`;
  if (width + text === drawnScale) return;  // setting it again would have it painted again
  drawnScale = width + text;
  element("scale").style.width = width;
  element("scale").textContent = text;
}

const dirty = { words: true, curves: true, path: true };

function draw() {
  requestAnimationFrame(draw);
  if (dirty.words) drawWords();
  if (dirty.curves) curves.draw();
  if (dirty.path) {
    const posed = model.lastPosed;
    scene?.setPath(model.path());
    scene?.setPose(posed && (!model.map || posed.map === model.map.map) ? posed.pose : null);
    if (!scene) drawPlan(element<HTMLCanvasElement>("plan"), model, currentTheme());
  }
  if (scene) drawScale(scene.scaleBar());
  Object.assign(dirty, { words: false, curves: false, path: false });
}

// ---- what the program sends

const connection = new Connection({
  onOpen() {
    connected = true;
    ended = false;
    dirty.words = true;
  },
  onClose() {
    connected = false;
    if (model.state?.finished) {
      ended = true;
      connection.end();
    }
    dirty.words = true;
  },
  onStranger(version) {
    stranger = `This page is of another version than the program (${version}): load it again`;
    dirty.words = true;
  },
  onMessage(topic, bytes) {
    switch (topic) {
      case Topic.state:
        model.state = protocol.decodeState(bytes);
        scene?.setState(model.state);
        break;
      case Topic.frames: {
        const { first, frames } = protocol.decodeFrames(bytes);
        model.add(first, frames);
        Object.assign(dirty, { curves: true, path: true });
        break;
      }
      case Topic.image: {
        const image = protocol.decodeImage(bytes);
        void picture.show(image).then(() => {  // a later one may have been ready before it
          element("picture-frame").textContent = `frame ${picture.frame ?? image.frame}`;
          element("far").textContent = `${picture.far.toFixed(0)} m`;
        });
        element("no-picture").hidden = true;
        break;
      }
      case Topic.map:
        model.map = protocol.decodeMap(bytes);
        scene?.setMap(model.map);
        dirty.path = true;
        break;
      case Topic.mesh:
        scene?.setMesh(protocol.decodeMesh(bytes));
        break;
      case Topic.keyframe:
        showKeyframe(bytes);
        break;
    }
    dirty.words = true;
  },
});

// What is not to be seen is not asked for.
function updateWanted() {
  if (document.hidden) return connection.want(0);
  let wanted = Want.map;
  if (element("picture").offsetParent !== null) {
    wanted |= Want.image;
    if (picture.options.depth) wanted |= Want.depth;
    if (picture.options.masks) wanted |= Want.masks;
  }
  if (scene && element<HTMLInputElement>("show-mesh").checked) wanted |= Want.mesh;
  connection.want(wanted);
}

// ---- what the user does

function listen() {
  for (const box of document.querySelectorAll<HTMLInputElement>("[data-layer]")) {
    box.addEventListener("change", () => {
      scene?.setLayer(box.dataset.layer as Layer, box.checked);
      updateWanted();
    });
  }
  for (const button of document.querySelectorAll<HTMLButtonElement>("[data-mode]")) {
    button.addEventListener("click", () => {
      for (const other of document.querySelectorAll("[data-mode]")) other.setAttribute("aria-pressed", String(other === button));
      scene?.setMode(button.dataset.mode as ViewMode);
    });
  }
  element("fit").addEventListener("click", () => scene?.fit());
  for (const button of document.querySelectorAll<HTMLButtonElement>("[data-tab]")) {
    button.addEventListener("click", () => {
      document.body.dataset.tab = button.dataset.tab;
      for (const other of document.querySelectorAll("[data-tab]")) other.setAttribute("aria-pressed", String(other === button));
      dirty.curves = true;
      updateWanted();
      requestAnimationFrame(() => picture.draw());
    });
  }
  const option = (id: string, name: "points" | "masks") => {
    element<HTMLInputElement>(id).addEventListener("change", (event) => {
      picture.options[name] = (event.target as HTMLInputElement).checked;
      updateWanted();
      picture.draw();
    });
  };
  option("show-points", "points");
  option("show-masks", "masks");
  for (const button of document.querySelectorAll<HTMLButtonElement>("[data-image]")) {
    button.addEventListener("click", () => {
      for (const other of document.querySelectorAll("[data-image]")) other.setAttribute("aria-pressed", String(other === button));
      picture.options.depth = button.dataset.image === "depth";
      element("depth-key").hidden = !picture.options.depth;
      updateWanted();
      picture.draw();
    });
  }
  element("pause").addEventListener("click", () => connection.send(model.state?.paused ? "resume" : "pause"));
  element("step").addEventListener("click", () => connection.send("step"));
  element("keyframe-close").addEventListener("click", () => {
    element("keyframe").hidden = true;
    scene?.markPicked(null);
  });
  element("range").addEventListener("click", () => {
    element("range").textContent = curves.toggleRange() ? "Last 600 frames" : "Whole run";
  });
  document.addEventListener("keydown", (event) => {
    if (event.target instanceof HTMLInputElement || event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === "p") element("pause").click();
    if (event.key === "s") element("step").click();
  });
  document.addEventListener("visibilitychange", updateWanted);
  window.addEventListener("resize", () => {
    Object.assign(dirty, { curves: true, path: true });
    picture.draw();
    updateWanted();
  });
}

function startTheme() {
  const system = window.matchMedia("(prefers-color-scheme: dark)");
  const apply = (dark: boolean) => {
    document.documentElement.dataset.theme = dark ? "dark" : "light";
    scene?.setTheme(currentTheme());
    Object.assign(dirty, { curves: true, path: true });
  };
  apply(system.matches);
  system.addEventListener("change", (event) => apply(event.matches));
  element("theme").addEventListener("click", () => apply(document.documentElement.dataset.theme !== "dark"));
}

// On a phone the list of layers would cover the map.
if (window.innerWidth <= 820) element("layers").removeAttribute("open");
startTheme();
startScene();
listen();
updateWanted();
draw();
// For the browser test and for measuring.
Object.assign(window, {
  stdcViewer: { model, picture, get scene() { return scene; }, decodeMesh: protocol.decodeMesh, measure, turning },
});
