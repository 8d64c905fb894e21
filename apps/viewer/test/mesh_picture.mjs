// mesh_picture.mjs FRAME.png MESH.glb PICTURE [BACK UP ASIDE]: a frame of a run beside its dense mesh, seen from about where
// the run began (so far behind, above and to the left of it [m]), drawn in headless Chromium with software rendering.
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import playwright from "playwright-core";

const [frame, mesh, picture, back = 0.2, up = 0.25, aside = 0.25] = process.argv.slice(2);

// The file is turned upright: y is up, x is where the first camera looks, which stands at the origin.
const program = `
  import * as three from "three";
  import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
  const bytesOf = (data) => Uint8Array.from(atob(data), (c) => c.charCodeAt(0));
  window.draw = async (frame, mesh, back, up, aside, kind) => {
    const width = 640, height = 480;
    const { scene: model } = await new GLTFLoader().parseAsync(bytesOf(mesh).buffer, "");
    const scene = new three.Scene();
    scene.background = new three.Color(0x20242c);
    model.traverse((object) => {
      if (object.isMesh) object.material = new three.MeshBasicMaterial({ vertexColors: true });
    });
    scene.add(model);
    const camera = new three.PerspectiveCamera(49, width / height, 0.05, 100);
    camera.position.set(-back, up, -aside);
    camera.lookAt(2, -0.55, 0);
    const renderer = new three.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    renderer.setPixelRatio(1);
    renderer.setSize(width, height);
    renderer.render(scene, camera);
    const canvas = new OffscreenCanvas(2 * width + 8, height), pen = canvas.getContext("2d");
    pen.fillStyle = "white";
    pen.fillRect(0, 0, canvas.width, height);
    pen.drawImage(await createImageBitmap(new Blob([bytesOf(frame)])), 0, 0, width, height);
    pen.drawImage(renderer.domElement, width + 8, 0);
    const blob = await canvas.convertToBlob({ type: kind, quality: 0.8 });
    let text = "";
    for (const byte of new Uint8Array(await blob.arrayBuffer())) text += String.fromCharCode(byte);
    return btoa(text);
  };`;
const bundle = execFileSync("esbuild", ["--bundle", "--format=iife", "--log-level=warning"], { input: program, maxBuffer: 1 << 26 });
const packed = (path) => readFileSync(path).toString("base64");

const browser = await playwright.chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
try {
  const page = await browser.newPage();
  await page.addScriptTag({ content: bundle.toString() });
  const drawn = await page.evaluate((what) => window.draw(...what), [packed(frame), packed(mesh), Number(back), Number(up),
    Number(aside), picture.endsWith(".png") ? "image/png" : "image/webp"]);
  writeFileSync(picture, Buffer.from(drawn, "base64"));
} finally {
  await browser.close();
}
