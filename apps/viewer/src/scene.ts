import {
  BufferAttribute, BufferGeometry, CanvasTexture, Color, DoubleSide, LineBasicMaterial, LineSegments, Matrix4, Mesh as ThreeMesh,
  MeshBasicMaterial, Object3D, OrthographicCamera, PerspectiveCamera, Points, PointsMaterial, Quaternion, Scene,
  SRGBColorSpace, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { LineGeometry } from "three/examples/jsm/lines/LineGeometry.js";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import { Line2 } from "three/examples/jsm/lines/Line2.js";
import { okabe, Theme } from "./colours";
import { coarseMesh, drawsInSoftware, sparse, thinned } from "./detail";
import { Mesh, Pose, RunMap, RunState } from "./protocol";

export type Layer = "path" | "truth" | "keyframes" | "covisibility" | "loops" | "landmarks" | "mesh";
export type ViewMode = "orbit" | "follow" | "top";

const UP = new Vector3(0, -1, 0);  // of the first camera, whose y points down

// Corners and edges of a camera: the tip, then its image's corners from the top left, clockwise.
function frustum(state: RunState | null, depth: number): { corners: Vector3[]; edges: number[] } {
  const c = state?.camera ?? { width: 640, height: 480, fx: 525, fy: 525, cx: 320, cy: 240, fps: 30 };
  const left = (-c.cx / c.fx) * depth, right = ((c.width - c.cx) / c.fx) * depth;
  const top = (-c.cy / c.fy) * depth, bottom = ((c.height - c.cy) / c.fy) * depth;
  const corners = [
    new Vector3(), new Vector3(left, top, depth), new Vector3(right, top, depth),
    new Vector3(right, bottom, depth), new Vector3(left, bottom, depth),
  ];
  return { corners, edges: [0, 1, 0, 2, 0, 3, 0, 4, 1, 2, 2, 3, 3, 4, 4, 1] };
}

// The map and the camera in three dimensions. Draws only when something has changed.
export class Scene3D {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly perspective = new PerspectiveCamera(50, 1, 0.02, 500);
  private readonly orthographic = new OrthographicCamera(-1, 1, 1, -1, -500, 500);
  private readonly orbit: OrbitControls;
  private readonly plan: OrbitControls;
  private mode: ViewMode = "orbit";
  private touched = false;   // by the user: then the view is left where it is
  private dirty = true;
  private fitted = 0;
  private map: RunMap | null = null;
  private state: RunState | null = null;
  private pose: Pose | null = null;
  private followed: Vector3 | null = null;
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
    this.perspective.up.copy(UP);
    this.perspective.position.set(0.6, -1.6, -3);
    this.orthographic.up.set(0, 0, 1);
    this.orthographic.position.set(0, -50, 0);
    this.orbit = new OrbitControls(this.perspective, canvas);
    this.plan = new OrbitControls(this.orthographic, canvas);
    this.plan.enableRotate = false;
    this.plan.screenSpacePanning = true;
    this.plan.mouseButtons.LEFT = 2;   // drag moves the plan
    this.plan.touches.ONE = 1;
    for (const controls of [this.orbit, this.plan]) {
      controls.enableDamping = false;
      controls.addEventListener("change", () => { this.dirty = true; });
      controls.addEventListener("start", () => { this.touched = true; });
    }
    this.orbit.target.set(0, 0, 1.5);
    for (const object of [this.mesh, this.landmarks, this.covisibility, this.keyframes, this.loops, this.truth,
      this.path, this.camera, this.picked]) {
      object.frustumCulled = false;
      object.visible = false;
      this.scene.add(object);
    }
    this.setMode("orbit");
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
  }

  private updateVisible() {
    const has = (object: { geometry: BufferGeometry }, name = "position") =>
      (object.geometry.getAttribute(name)?.count ?? 0) > 0;
    this.path.visible = this.shown.path && has(this.path, "instanceStart");
    this.truth.visible = this.shown.truth && has(this.truth, "instanceStart");
    this.loops.visible = this.shown.loops && has(this.loops, "instanceStart");
    this.keyframes.visible = this.shown.keyframes && has(this.keyframes);
    this.covisibility.visible = this.shown.covisibility && has(this.covisibility);
    this.landmarks.visible = this.shown.landmarks && has(this.landmarks);
    this.mesh.visible = this.shown.mesh && has(this.mesh);
    this.camera.visible = this.pose !== null;
    this.dirty = true;
  }

  setTheme(theme: Theme) {
    this.scene.background = new Color(theme.background);
    this.pathMaterial.color.set(theme.path);
    this.truthMaterial.color.set(theme.truth);
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
      if (this.mode === "follow") this.follow();
    }
    this.updateVisible();
  }

  setPath(points: Float32Array) {
    this.setLine(this.path, points);
    if (!this.touched && points.length >= 6) this.fitIfGrown(points);
    this.updateVisible();
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
    if (this.pickedFrame !== null) this.markPicked(this.pickedFrame);
    this.updateVisible();
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
    const full = geometry(mesh), medium = geometry(coarseMesh(mesh, 60000)), coarse = geometry(coarseMesh(mesh, 15000));
    this.meshLevels = [full, medium, medium, coarse];
    this.mesh.geometry = full;
    this.mesh.position.fromArray(mesh.corner);
    this.mesh.scale.fromArray(mesh.size);
    this.updateVisible();
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
    const map = this.map, camera = this.activeCamera;
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
    const point = new Vector3().fromArray(this.map.keyframePoses, 7 * i).project(this.activeCamera);
    return { x: (0.5 + 0.5 * point.x) * this.canvas.clientWidth, y: (0.5 - 0.5 * point.y) * this.canvas.clientHeight };
  }

  private get activeCamera() { return this.mode === "top" ? this.orthographic : this.perspective; }

  setMode(mode: ViewMode) {
    this.mode = mode;
    this.orbit.enabled = mode !== "top";
    this.plan.enabled = mode === "top";
    this.followed = null;
    if (mode === "top") this.fit();
    if (mode === "follow") this.startFollowing();
    this.dirty = true;
  }

  // Behind the camera and above it; from there on the view moves along, and can be turned.
  private startFollowing() {
    if (!this.pose) return;
    const centre = new Vector3().fromArray(this.pose.position);
    const ahead = new Vector3(0, 0, 1).applyQuaternion(new Quaternion().fromArray(this.pose.quaternion));
    ahead.addScaledVector(UP, -ahead.dot(UP));
    if (ahead.lengthSq() < 1e-6) ahead.set(0, 0, 1);
    ahead.normalize();
    this.orbit.target.copy(centre).addScaledVector(ahead, 0.8);
    this.perspective.position.copy(centre).addScaledVector(ahead, -1.7).addScaledVector(UP, 0.9);
    this.followed = centre;
    this.orbit.update();
  }

  private follow() {
    if (!this.followed) return this.startFollowing();
    const centre = new Vector3().fromArray(this.pose!.position);
    const step = centre.clone().sub(this.followed);
    this.perspective.position.add(step);
    this.orbit.target.add(step);
    this.followed = centre;
    this.orbit.update();
  }

  private fitIfGrown(path: Float32Array) {
    if (this.mode === "follow") return;
    const count = path.length / 3 + (this.map?.landmarks.length ?? 0) / 30;
    if (count < 1.3 * this.fitted) return;
    this.fitted = count;
    this.fit();
  }

  // Shows all of the path and nearly all landmarks.
  fit() {
    const bounds = [0, 1, 2].map((axis) => {
      const values: number[] = [];
      const collect = (points: ArrayLike<number>, step: number) => {
        for (let i = axis; i < points.length; i += 3 * step) values.push(points[i]!);
      };
      const landmarks = this.map?.landmarks ?? [];
      collect(landmarks, Math.max(1, Math.floor(landmarks.length / 9000)));
      const path = this.map?.path ?? [];
      const inner = [...values].sort((a, b) => a - b);
      const low = inner[Math.floor(0.04 * inner.length)] ?? -0.5, high = inner[Math.floor(0.96 * inner.length)] ?? 0.5;
      values.length = 0;
      collect(path, 1);
      return values.reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)] as [number, number], [low, high] as [number, number]);
    });
    const centre = new Vector3(...bounds.map(([a, b]) => (a + b) / 2) as [number, number, number]);
    const radius = Math.max(0.6, 0.5 * Math.hypot(...bounds.map(([a, b]) => b - a)));
    const aspect = this.canvas.clientWidth / Math.max(1, this.canvas.clientHeight);
    if (this.mode === "top") {
      const half = 1.1 * Math.max((bounds[2]![1] - bounds[2]![0]) / 2, (bounds[0]![1] - bounds[0]![0]) / 2 / aspect, 0.4);
      this.orthographic.zoom = 1;
      this.orthographic.userData.half = half;
      this.plan.target.copy(centre);
      this.orthographic.position.copy(centre).addScaledVector(UP, 50);
      this.resize();
      this.plan.update();
    } else {
      const direction = this.perspective.position.clone().sub(this.orbit.target).normalize();
      if (this.fitted <= 0 || !Number.isFinite(direction.x)) direction.set(0.35, -0.55, -0.75).normalize();
      const narrow = Math.min(1, aspect);
      const distance = (0.92 * radius) / Math.sin((this.perspective.fov * Math.PI) / 360) / narrow;
      this.orbit.target.copy(centre);
      this.perspective.position.copy(centre).addScaledVector(direction, distance);
      this.orbit.update();
    }
    this.dirty = true;
  }

  private resize() {
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(this.pixelRatio());
    this.renderer.setSize(width, height, false);
    this.perspective.aspect = width / height;
    this.perspective.updateProjectionMatrix();
    const half: number = this.orthographic.userData.half ?? 2;
    Object.assign(this.orthographic, { left: (-half * width) / height, right: (half * width) / height, top: half, bottom: -half });
    this.orthographic.updateProjectionMatrix();
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
    this.covisibility.visible = level < 3 && this.shown.covisibility && this.covisibility.geometry.attributes.position !== undefined;
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
    this.renderer.render(this.scene, this.activeCamera);
  }

  // Draws some pictures as fast as it goes while the view turns, at a level of detail: milliseconds of each.
  measure(count: number, level: number): number[] {
    const times: number[] = [], gl = this.renderer.getContext(), pixel = new Uint8Array(4);
    this.setLevel(level);
    for (let i = 0; i < count; ++i) {
      const begin = performance.now();
      this.perspective.position.sub(this.orbit.target).applyAxisAngle(UP, 0.02).add(this.orbit.target);
      this.perspective.lookAt(this.orbit.target);
      this.renderer.render(this.scene, this.activeCamera);
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);  // waits until it is drawn
      times.push(performance.now() - begin);
    }
    return times;
  }

  // Length of a bar of the picture [m] at the distance that is looked at, and its pixels.
  scaleBar(): { metres: number; pixels: number } {
    const height = Math.max(1, this.canvas.clientHeight);
    const metresPerPixel = this.mode === "top"
      ? (this.orthographic.top - this.orthographic.bottom) / this.orthographic.zoom / height
      : (2 * this.perspective.position.distanceTo(this.orbit.target) * Math.tan((this.perspective.fov * Math.PI) / 360)) / height;
    const wanted = 90 * metresPerPixel, power = 10 ** Math.floor(Math.log10(wanted));
    const metres = [5, 2, 1].map((m) => m * power).find((m) => m <= wanted) ?? power;
    return { metres, pixels: metres / metresPerPixel };
  }
}
