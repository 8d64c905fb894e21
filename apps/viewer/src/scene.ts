import {
  BufferAttribute, BufferGeometry, CanvasTexture, Color, DoubleSide, LineBasicMaterial, LineSegments, Matrix4,
  Mesh as ThreeMesh, MeshBasicMaterial, Object3D, Points, PointsMaterial, Quaternion, Scene,
  SRGBColorSpace, Vector3, WebGLRenderer,
} from "three";
import { LineGeometry } from "three/examples/jsm/lines/LineGeometry.js";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import { Line2 } from "three/examples/jsm/lines/Line2.js";
import { okabe, Theme } from "./colours";
import { coarseMesh, drawsInSoftware, segments, sparse, thinned } from "./detail";
import { frustum } from "./frustum";
import { Mesh, Pose, RunMap, RunState } from "./protocol";
import { ViewMode, Viewpoint } from "./viewpoint";

const thinLevel = 2;  // of detail, from which on lines are thin
const maxThinPoints = 1000;

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
  private level = this.software ? 2 : 0;  // of detail while the picture changes: 0 is all of it
  private drawn = 0;         // level of what is seen now
  private drawnAt = 0;       // [ms]
  private intervals: number[] = [];
  // Mesh and landmarks to draw at each level; null: all of them.
  private meshLevels: BufferGeometry[] = [];
  private fewKeyframes: BufferAttribute | null = null;
  private pointLevels: (BufferAttribute | null)[] = [null, null, null, null];

  private readonly pathMaterial = new LineMaterial({ linewidth: 3 });
  private readonly truthMaterial = new LineMaterial({ linewidth: 2, dashed: true, dashSize: 0.06, gapSize: 0.05 });
  private readonly loopMaterial = new LineMaterial({ linewidth: 3.5, color: okabe.purple });
  private readonly cameraMaterial = new LineMaterial({ linewidth: 2.5, color: okabe.orange });
  private readonly path = new Line2(new LineGeometry(), this.pathMaterial);
  private readonly truth = new Line2(new LineGeometry(), this.truthMaterial);
  // Both as lines of one pixel, which cost a software renderer a tenth of those of some width.
  private readonly thinPath = new LineSegments(new BufferGeometry(), new LineBasicMaterial());
  private readonly thinTruth = new LineSegments(new BufferGeometry(), new LineBasicMaterial());
  private readonly loops = new LineSegments2(new LineSegmentsGeometry(), this.loopMaterial);
  private readonly camera = new Object3D();
  private readonly pane = document.createElement("canvas");
  private readonly paneMaterial = new MeshBasicMaterial(
    { color: okabe.orange, transparent: true, opacity: 0.25, side: DoubleSide, depthWrite: false });
  private readonly keyframes = new LineSegments(new BufferGeometry(), new LineBasicMaterial());
  private readonly picked = new LineSegments2(new LineSegmentsGeometry(), new LineMaterial({ linewidth: 3.5, color: okabe.vermillion }));
  private readonly covisibility = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ transparent: true, opacity: 0.28 }));
  private readonly landmarks = new Points(new BufferGeometry(), new PointsMaterial({ size: 2, sizeAttenuation: false }));
  private readonly mesh = new ThreeMesh(new BufferGeometry(), new MeshBasicMaterial({ vertexColors: true }));
  private pickedFrame: number | null = null;

  // Throws if the browser has no WebGL.
  constructor(private readonly canvas: HTMLCanvasElement, private readonly onPick: (frame: number | null) => void) {
    this.renderer = new WebGLRenderer({ canvas, antialias: !this.software, powerPreference: "high-performance" });
    this.viewpoint = new Viewpoint(canvas, () => { this.dirty = true; });
    for (const object of [this.mesh, this.landmarks, this.covisibility, this.keyframes, this.loops, this.truth,
      this.path, this.thinTruth, this.thinPath, this.camera, this.picked]) {
      object.frustumCulled = false;
      object.visible = false;
      this.scene.add(object);
    }
    this.listenForPicks();
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
    this.updateVisible();
    this.dirty = true;
  }

  private updateVisible() {
    const has = (object: { geometry: BufferGeometry }, name = "position") =>
      (object.geometry.getAttribute(name)?.count ?? 0) > 0;
    const thin = this.drawn >= thinLevel;
    const path = this.shown.path && has(this.path, "instanceStart");
    const truth = this.shown.truth && has(this.truth, "instanceStart");
    [this.path.visible, this.thinPath.visible] = [path && !thin, path && thin];
    [this.truth.visible, this.thinTruth.visible] = [truth && !thin, truth && thin];
    this.loops.visible = this.shown.loops && has(this.loops, "instanceStart");
    this.keyframes.visible = this.shown.keyframes && has(this.keyframes);
    this.covisibility.visible = this.drawn < 3 && this.shown.covisibility && has(this.covisibility);
    this.landmarks.visible = this.shown.landmarks && has(this.landmarks);
    this.mesh.visible = this.shown.mesh && has(this.mesh);
    this.camera.visible = this.pose !== null;
  }

  setTheme(theme: Theme) {
    this.scene.background = new Color(theme.background);
    this.pathMaterial.color.set(theme.path);
    this.truthMaterial.color.set(theme.truth);
    this.thinPath.material.color.set(theme.path);
    this.thinTruth.material.color.set(theme.truth);
    (this.keyframes.material as LineBasicMaterial).color.set(theme.keyframe);
    (this.covisibility.material as LineBasicMaterial).color.set(theme.keyframe);
    (this.landmarks.material as PointsMaterial).color.set(theme.landmark);
    this.dirty = true;
  }

  setState(state: RunState) {
    const first = this.state === null;
    this.state = state;
    if (first) this.buildCamera();
  }

  private buildCamera() {
    const { corners, edges } = frustum(this.state, 0.28);
    const geometry = new LineSegmentsGeometry();
    geometry.setPositions(edges.flatMap((i) => corners[i]!.toArray()));
    const pane = new BufferGeometry().setFromPoints([1, 2, 3, 1, 3, 4].map((i) => corners[i]!));
    pane.setAttribute("uv", new BufferAttribute(new Float32Array([0, 1, 1, 1, 1, 0, 0, 1, 1, 0, 0, 0]), 2));
    this.camera.clear();
    this.camera.add(new LineSegments2(geometry, this.cameraMaterial), new ThreeMesh(pane, this.paneMaterial));
    this.camera.traverse((object) => { object.frustumCulled = false; });
  }

  // Shows what the camera sees on its frustum.
  setImage(image: ImageBitmap) {
    const first = this.paneMaterial.map === null;
    this.pane.width = 160;
    this.pane.height = Math.round((160 * image.height) / image.width);
    this.pane.getContext("2d")!.drawImage(image, 0, 0, this.pane.width, this.pane.height);
    if (first) {
      const texture = new CanvasTexture(this.pane);
      texture.colorSpace = SRGBColorSpace;
      Object.assign(this.paneMaterial, { map: texture, opacity: 0.9, needsUpdate: true });
      this.paneMaterial.color.set("#ffffff");
    }
    this.paneMaterial.map!.needsUpdate = true;
    this.dirty = true;
  }

  setPose(pose: Pose | null) {
    this.pose = pose;
    if (pose) {
      this.camera.position.fromArray(pose.position);
      this.camera.quaternion.fromArray(pose.quaternion);
      this.viewpoint.move(pose);
    }
    this.updateVisible();
    this.dirty = true;
  }

  setPath(points: Float32Array) {
    this.setLine(this.path, points);
    this.replace(this.thinPath, segments(thinned(points, maxThinPoints), 1));
    if (points.length >= 6) this.viewpoint.fitIfGrown(points.length / 3, this.map);
    this.updateVisible();
    this.dirty = true;
  }

  private setLine(line: Line2, points: Float32Array) {
    line.geometry.dispose();
    line.geometry = new LineGeometry();
    if (points.length < 6) return;
    const maxPoints = this.software ? 500 : 6000;  // a line of some width is made of triangles
    line.geometry.setPositions(thinned(points, maxPoints));
    line.computeLineDistances();
  }

  setMap(map: RunMap) {
    this.map = map;
    const positions = (i: number) => map.keyframePoses.subarray(7 * i, 7 * i + 3);
    this.replace(this.landmarks, map.landmarks);
    const few = (max: number) => new BufferAttribute(sparse(map.landmarks.length / 3, max), 1);
    const many = few(20000);
    this.pointLevels = [null, many, many, few(4000)];
    this.replace(this.keyframes, this.frusta(map));
    const corners = 16, some = sparse(map.keyframeIds.length, 200);  // ends of lines of a keyframe
    this.fewKeyframes = new BufferAttribute(Uint32Array.from({ length: corners * some.length },
      (_, i) => corners * some[Math.floor(i / corners)]! + (i % corners)), 1);
    const edges = new Float32Array(3 * map.covisible.length);
    map.covisible.forEach((keyframe, i) => edges.set(positions(keyframe), 3 * i));
    this.replace(this.covisibility, edges);
    const loops = new Float32Array(3 * map.loops.length);
    map.loops.forEach((keyframe, i) => loops.set(positions(keyframe), 3 * i));
    this.loops.geometry.dispose();
    this.loops.geometry = new LineSegmentsGeometry();
    if (loops.length > 0) this.loops.geometry.setPositions(loops);
    this.setLine(this.truth, map.truth);
    this.replace(this.thinTruth, segments(thinned(map.truth, maxThinPoints), 2));
    if (this.pickedFrame !== null) this.markPicked(this.pickedFrame);
    this.updateVisible();
    this.dirty = true;
  }

  private replace(object: { geometry: BufferGeometry }, positions: Float32Array) {
    object.geometry.dispose();
    object.geometry = new BufferGeometry();
    object.geometry.setAttribute("position", new BufferAttribute(positions, 3));
  }

  private keyframePose(map: RunMap, i: number): Matrix4 {
    const p = map.keyframePoses.subarray(7 * i, 7 * i + 7);
    return new Matrix4().compose(new Vector3(p[0], p[1], p[2]), new Quaternion(p[3], p[4], p[5], p[6]), new Vector3(1, 1, 1));
  }

  private frusta(map: RunMap): Float32Array {
    const { corners, edges } = frustum(this.state, 0.11), count = map.keyframeIds.length;
    const positions = new Float32Array(3 * edges.length * count), corner = new Vector3();
    for (let i = 0; i < count; ++i) {
      const pose = this.keyframePose(map, i);
      const placed = corners.map((c) => corner.copy(c).applyMatrix4(pose).toArray());
      edges.forEach((e, k) => positions.set(placed[e]!, 3 * (edges.length * i + k)));
    }
    return positions;
  }

  setMesh(mesh: Mesh) {
    const geometry = (of: Mesh) => {
      const made = new BufferGeometry();
      made.setAttribute("position", new BufferAttribute(of.positions, 3, true));
      made.setAttribute("color", new BufferAttribute(of.colours, 3, true));
      made.setIndex(new BufferAttribute(of.triangles, 1));
      return made;
    };
    for (const old of new Set(this.meshLevels)) old.dispose();
    const full = geometry(mesh), medium = geometry(coarseMesh(mesh, 60000)), coarse = geometry(coarseMesh(mesh, 10000));
    this.meshLevels = [full, medium, medium, coarse];
    this.mesh.geometry = full;
    this.mesh.position.fromArray(mesh.corner);
    this.mesh.scale.fromArray(mesh.size);
    this.updateVisible();
    this.dirty = true;
  }

  private listenForPicks() {
    let down: { x: number; y: number } | null = null;
    this.canvas.addEventListener("pointerdown", (event) => { down = { x: event.offsetX, y: event.offsetY }; });
    this.canvas.addEventListener("pointerup", (event) => {
      const still = down && Math.hypot(event.offsetX - down.x, event.offsetY - down.y) < 6;
      if (still) this.pick(event.offsetX, event.offsetY, event.pointerType === "touch" ? 28 : 14);
    });
  }

  // The keyframe whose camera is drawn next to a pixel; no farther than `reach`.
  private pick(x: number, y: number, reach: number) {
    const map = this.map, camera = this.viewpoint.camera;
    if (!map || !this.shown.keyframes) return;
    let best: number | null = null, nearest = reach;
    const point = new Vector3();
    for (let i = 0; i < map.keyframeIds.length; ++i) {
      point.fromArray(map.keyframePoses, 7 * i).project(camera);
      if (Math.abs(point.z) > 1) continue;
      const u = (0.5 + 0.5 * point.x) * this.canvas.clientWidth, v = (0.5 - 0.5 * point.y) * this.canvas.clientHeight;
      const distance = Math.hypot(u - x, v - y);
      if (distance < nearest) [nearest, best] = [distance, i];
    }
    const frame = best === null ? null : map.keyframeFrames[best]!;
    this.markPicked(frame);
    this.onPick(frame);
  }

  markPicked(frame: number | null) {
    this.pickedFrame = frame;
    const at = frame === null || !this.map ? -1 : this.map.keyframeFrames.indexOf(frame);
    this.picked.visible = at >= 0;
    if (at >= 0 && this.map) {
      const { corners, edges } = frustum(this.state, 0.16), pose = this.keyframePose(this.map, at);
      this.picked.geometry.dispose();
      this.picked.geometry = new LineSegmentsGeometry();
      this.picked.geometry.setPositions(edges.flatMap((e) => corners[e]!.clone().applyMatrix4(pose).toArray()));
    }
    this.dirty = true;
  }

  // Where on the canvas a keyframe is drawn, for tests.
  placeOfKeyframe(i: number): { x: number; y: number } | null {
    if (!this.map || i >= this.map.keyframeIds.length) return null;
    const point = new Vector3().fromArray(this.map.keyframePoses, 7 * i).project(this.viewpoint.camera);
    return { x: (0.5 + 0.5 * point.x) * this.canvas.clientWidth, y: (0.5 - 0.5 * point.y) * this.canvas.clientHeight };
  }

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
    for (const material of [this.pathMaterial, this.truthMaterial, this.loopMaterial, this.cameraMaterial,
      this.picked.material as LineMaterial]) material.resolution.set(width, height);
    this.dirty = true;
  }

  // Fewer pixels at higher levels.
  private pixelRatio(): number {
    const full = Math.min(2, window.devicePixelRatio || 1);
    return full * ([1, 1, 0.7, 0.5][this.drawn] ?? 0.5);
  }

  private setLevel(level: number) {
    this.drawn = level;
    this.mesh.geometry = this.meshLevels[level] ?? this.mesh.geometry;
    this.landmarks.geometry.setIndex(this.pointLevels[level] ?? null);
    this.keyframes.geometry.setIndex(level < 3 ? null : this.fewKeyframes);
    this.updateVisible();
    if (this.pixelRatio() !== this.renderer.getPixelRatio()) {
      this.renderer.setPixelRatio(this.pixelRatio());
      this.renderer.setSize(this.canvas.clientWidth, this.canvas.clientHeight, false);
    }
  }

  // Where pictures come too slowly there is less in them while they change, down to the coarsest level.
  private adapt(interval: number) {
    this.intervals.push(interval);
    if (this.intervals.length < 6) return;
    const mean = this.intervals.reduce((a, b) => a + b, 0) / this.intervals.length;
    this.intervals = [];
    if (mean > 36) this.level = Math.min(3, this.level + 1);
    if (mean < 20 && !this.software) this.level = Math.max(0, this.level - 1);
  }

  private render() {
    const now = performance.now(), settled = now - this.drawnAt > 350;
    if (!this.dirty && !(settled && this.drawn > 0)) return;
    if (this.dirty && !settled) this.adapt(now - this.drawnAt);
    this.setLevel(this.dirty ? this.level : 0);
    this.dirty = false;
    this.drawnAt = now;
    this.renderer.render(this.scene, this.viewpoint.camera);
  }

  // Draws some pictures as fast as it goes while the view turns, at a level of detail: milliseconds of each.
  measure(count: number, level: number): number[] {
    const times: number[] = [], gl = this.renderer.getContext(), pixel = new Uint8Array(4);
    this.setLevel(level);
    for (let i = 0; i < count; ++i) {
      const begin = performance.now();
      this.viewpoint.turn(0.02);
      this.renderer.render(this.scene, this.viewpoint.camera);
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);  // waits until it is drawn
      times.push(performance.now() - begin);
    }
    this.drawnAt = performance.now();  // it does not come to rest at once
    return times;
  }

  // Turns the view for some time as a hand does: milliseconds between the pictures that were drawn.
  turning(milliseconds: number): Promise<number[]> {
    const times: number[] = [], end = performance.now() + milliseconds;
    let last = performance.now();
    return new Promise((resolve) => {
      const step = () => {
        const now = performance.now();
        times.push(now - last);
        last = now;
        if (now > end) return resolve(times);
        this.viewpoint.turn(0.01);
        this.dirty = true;
        requestAnimationFrame(step);
      };
      requestAnimationFrame(step);
    });
  }
}
