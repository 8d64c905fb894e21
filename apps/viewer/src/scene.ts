import { BufferGeometry, Color, LineBasicMaterial, LineSegments, Scene, WebGLRenderer } from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import { onClick } from "./click";
import { okabe, Theme } from "./colours";
import { DetailLevel, shareOfPixels } from "./detail_level";
import { DrawnCamera } from "./drawn_camera";
import { DrawnKeyframes } from "./drawn_keyframes";
import { DrawnLandmarks } from "./drawn_landmarks";
import { DrawnLine } from "./drawn_line";
import { DrawnMesh } from "./drawn_mesh";
import { hasLines, hasPoints, keyframePositions, replacePoints, replaceWideLines } from "./geometry";
import { Mesh, Pose, RunMap, RunState } from "./protocol";
import { drawsInSoftware, opaqueRenderer } from "./renderer";
import { ViewMode, Viewpoint } from "./viewpoint";

export type Layer = "path" | "truth" | "keyframes" | "covisibility" | "loops" | "landmarks" | "mesh";

// The map and the camera in three dimensions. Draws only when something has changed.
export class Scene3D {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly viewpoint: Viewpoint;
  private dirty = true;
  private map: RunMap | null = null;
  private state: RunState | null = null;
  private pose: Pose | null = null;
  private readonly software = drawsInSoftware();
  private readonly detail = new DetailLevel(this.software);
  private drawn = 0;    // level of what is seen now
  private drawnAt = 0;  // [ms]

  private readonly loopMaterial = new LineMaterial({ linewidth: 3.5, color: okabe.purple });
  private readonly path: DrawnLine;
  private readonly truth: DrawnLine;
  private readonly loops = new LineSegments2(new LineSegmentsGeometry(), this.loopMaterial);
  private readonly camera = new DrawnCamera();
  private readonly keyframes: DrawnKeyframes;
  private readonly covisibility = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ transparent: true, opacity: 0.28 }));
  private readonly landmarks = new DrawnLandmarks();
  private readonly mesh = new DrawnMesh();

  // Throws if the browser has no WebGL.
  constructor(private readonly canvas: HTMLCanvasElement, private readonly onPick: (frame: number | null) => void) {
    this.renderer = opaqueRenderer(canvas, !this.software);
    this.viewpoint = new Viewpoint(canvas, () => { this.dirty = true; });
    const maxPoints = this.software ? 500 : 6000;  // a line of some width is made of triangles
    this.path = new DrawnLine({ linewidth: 3 }, maxPoints);
    this.truth = new DrawnLine({ linewidth: 2, dashed: true, dashSize: 0.06, gapSize: 0.05 }, maxPoints);
    this.keyframes = new DrawnKeyframes(canvas);
    for (const object of [this.mesh.object, this.landmarks.object, this.covisibility, this.loops, ...this.truth.objects,
      ...this.path.objects, this.camera.object, ...this.keyframes.objects]) {
      object.frustumCulled = false;
      object.visible = false;
      this.scene.add(object);
    }
    onClick(canvas, (x, y, reach) => this.pick(x, y, reach));
    new ResizeObserver(() => this.resize()).observe(canvas);
    const loop = () => {
      requestAnimationFrame(loop);
      this.render();
    };
    loop();
  }

  private readonly shown: Record<Layer, boolean> =
    { path: true, truth: true, keyframes: true, covisibility: true, loops: true, landmarks: true, mesh: true };

  setLayer(layer: Layer, shown: boolean) {
    this.shown[layer] = shown;
    this.changed();
  }

  private changed() {
    this.updateVisible();
    this.dirty = true;
  }

  private updateVisible() {
    this.path.show(this.shown.path, this.drawn);
    this.truth.show(this.shown.truth, this.drawn);
    this.loops.visible = this.shown.loops && hasLines(this.loops);
    this.keyframes.show(this.shown.keyframes);
    this.covisibility.visible = this.drawn < 3 && this.shown.covisibility && hasPoints(this.covisibility);
    this.landmarks.show(this.shown.landmarks);
    this.mesh.show(this.shown.mesh);
  }

  setTheme(theme: Theme) {
    this.scene.background = new Color(theme.background);
    this.path.setColour(theme.path);
    this.truth.setColour(theme.truth);
    this.keyframes.setColour(theme.keyframe);
    this.covisibility.material.color.set(theme.keyframe);
    this.landmarks.setColour(theme.landmark);
    this.dirty = true;
  }

  setState(state: RunState) {
    if (this.state === null) this.camera.build(state);
    this.state = state;
    this.keyframes.setState(state);
  }

  // Shows what the camera sees on its frustum.
  setImage(image: ImageBitmap) {
    this.camera.setImage(image);
    this.dirty = true;
  }

  setPose(pose: Pose | null) {
    this.pose = pose;
    this.camera.setPose(pose);
    if (pose) this.viewpoint.move(pose);
    this.dirty = true;
  }

  setPath(points: Float32Array) {
    this.path.set(points);
    if (points.length >= 6) this.viewpoint.fitIfGrown(points.length / 3, this.map);
    this.changed();
  }

  setMap(map: RunMap) {
    this.map = map;
    this.landmarks.set(map.landmarks);
    this.keyframes.set(map);
    replacePoints(this.covisibility, keyframePositions(map, map.covisible));
    replaceWideLines(this.loops, keyframePositions(map, map.loops));
    this.truth.set(map.truth);
    this.changed();
  }

  setMesh(mesh: Mesh) {
    this.mesh.set(mesh);
    this.changed();
  }

  private pick(x: number, y: number, reach: number) {
    if (!this.map || !this.shown.keyframes) return;
    const frame = this.keyframes.nearest(this.viewpoint.camera, x, y, reach);
    this.markPicked(frame);
    this.onPick(frame);
  }

  markPicked(frame: number | null) {
    this.keyframes.mark(frame);
    this.dirty = true;
  }

  // Where on the canvas a keyframe is drawn, for tests.
  placeOfKeyframe(i: number): { x: number; y: number } | null { return this.keyframes.placeOf(i, this.viewpoint.camera); }

  setMode(mode: ViewMode) { this.viewpoint.setMode(mode, this.pose, this.map); }

  // Shows all of the path and nearly all landmarks.
  fit() { this.viewpoint.fit(this.map); }

  // Length of a bar of the picture [m] at the distance that is looked at, and its pixels.
  scaleBar(): { metres: number; pixels: number } { return this.viewpoint.scaleBar(); }

  private resize() {
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(this.pixelRatio());
    this.renderer.setSize(width, height, false);
    this.viewpoint.resize();
    for (const material of [this.path.material, this.truth.material, this.loopMaterial, this.camera.material,
      this.keyframes.pickedMaterial]) material.resolution.set(width, height);
    this.draw(this.detail.value);  // at once: it is black until then
    this.dirty = true;
  }

  // Fewer pixels at higher levels.
  private pixelRatio(): number { return Math.min(2, window.devicePixelRatio || 1) * shareOfPixels(this.drawn); }

  private setLevel(level: number) {
    this.drawn = level;
    this.canvas.style.imageRendering = level < 3 ? "" : "pixelated";  // of half the size: cheaper than interpolation
    for (const part of [this.mesh, this.landmarks, this.keyframes]) part.setLevel(level);
    this.updateVisible();
    if (this.pixelRatio() !== this.renderer.getPixelRatio()) {
      this.renderer.setPixelRatio(this.pixelRatio());
      this.renderer.setSize(this.canvas.clientWidth, this.canvas.clientHeight, false);
    }
  }

  private render() {
    const now = performance.now(), settled = now - this.drawnAt > 350;
    if (!this.dirty && !(settled && this.drawn > 0)) return;
    if (this.dirty && !settled) this.detail.adapt(now - this.drawnAt);
    this.draw(this.dirty ? this.detail.value : 0);
  }

  private draw(level: number) {
    this.setLevel(level);
    this.dirty = false;
    this.drawnAt = performance.now();
    this.renderer.render(this.scene, this.viewpoint.camera);
  }

  // The rest is for measuring.

  turn(angle: number) {
    this.viewpoint.turn(angle);
    this.dirty = true;
  }

  // Returns when it is drawn.
  drawAt(level: number) {
    const gl = this.renderer.getContext();
    this.draw(level);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    this.drawnAt = performance.now();  // it does not come to rest at once
  }
}
