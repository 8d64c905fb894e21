import { OrthographicCamera, PerspectiveCamera, Quaternion, Vector3 } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { Pose, RunMap } from "./protocol";

export type ViewMode = "orbit" | "follow" | "top";

const UP = new Vector3(0, -1, 0);  // of the first camera, whose y points down

// Per axis, of all of the path and nearly all landmarks.
function boundsOf(map: RunMap | null): [number, number][] {
  return [0, 1, 2].map((axis) => {
    const values: number[] = [];
    const collect = (points: ArrayLike<number>, step: number) => {
      for (let i = axis; i < points.length; i += 3 * step) values.push(points[i]!);
    };
    const landmarks = map?.landmarks ?? [];
    collect(landmarks, Math.max(1, Math.floor(landmarks.length / 9000)));
    const path = map?.path ?? [];
    const inner = [...values].sort((a, b) => a - b);
    const low = inner[Math.floor(0.04 * inner.length)] ?? -0.5, high = inner[Math.floor(0.96 * inner.length)] ?? 0.5;
    values.length = 0;
    collect(path, 1);
    return values.reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)] as [number, number], [low, high] as [number, number]);
  });
}

// From where the scene is seen: around it, behind the camera of the run, or as a plan from above.
export class Viewpoint {
  private readonly perspective = new PerspectiveCamera(50, 1, 0.02, 500);
  private readonly orthographic = new OrthographicCamera(-1, 1, 1, -1, -500, 500);
  private readonly orbit: OrbitControls;
  private readonly plan: OrbitControls;
  private mode: ViewMode = "orbit";
  private touched = false;   // by the user: then the view is left where it is
  private fitted = 0;
  private followed: Vector3 | null = null;

  constructor(private readonly canvas: HTMLCanvasElement, private readonly onChange: () => void) {
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
      controls.addEventListener("change", () => { this.onChange(); });
      controls.addEventListener("start", () => { this.touched = true; });
    }
    this.orbit.target.set(0, 0, 1.5);
    this.plan.enabled = false;
  }

  get camera(): PerspectiveCamera | OrthographicCamera { return this.mode === "top" ? this.orthographic : this.perspective; }

  setMode(mode: ViewMode, pose: Pose | null, map: RunMap | null) {
    this.mode = mode;
    this.orbit.enabled = mode !== "top";
    this.plan.enabled = mode === "top";
    this.followed = null;
    if (mode === "top") this.fit(map);
    if (mode === "follow" && pose) this.startFollowing(pose);
    this.onChange();
  }

  // The camera of the run has moved.
  move(pose: Pose) {
    if (this.mode === "follow") this.follow(pose);
  }

  // Behind the camera and above it; from there on the view moves along, and can be turned.
  private startFollowing(pose: Pose) {
    const centre = new Vector3().fromArray(pose.position);
    const ahead = new Vector3(0, 0, 1).applyQuaternion(new Quaternion().fromArray(pose.quaternion));
    ahead.addScaledVector(UP, -ahead.dot(UP));
    if (ahead.lengthSq() < 1e-6) ahead.set(0, 0, 1);
    ahead.normalize();
    this.orbit.target.copy(centre).addScaledVector(ahead, 0.8);
    this.perspective.position.copy(centre).addScaledVector(ahead, -1.7).addScaledVector(UP, 0.9);
    this.followed = centre;
    this.orbit.update();
  }

  private follow(pose: Pose) {
    if (!this.followed) return this.startFollowing(pose);
    const centre = new Vector3().fromArray(pose.position);
    const step = centre.clone().sub(this.followed);
    this.perspective.position.add(step);
    this.orbit.target.add(step);
    this.followed = centre;
    this.orbit.update();
  }

  // Shows all again if there is much more of it, unless the user has chosen the view.
  fitIfGrown(pathPoints: number, map: RunMap | null) {
    if (this.mode === "follow" || this.touched) return;
    const count = pathPoints + (map?.landmarks.length ?? 0) / 30;
    if (count < 1.3 * this.fitted) return;
    this.fitted = count;
    this.fit(map);
  }

  // Shows all of the path and nearly all landmarks.
  fit(map: RunMap | null) {
    const bounds = boundsOf(map);
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
    this.onChange();
  }

  // The canvas has another size.
  resize() {
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    if (width === 0 || height === 0) return;
    this.perspective.aspect = width / height;
    this.perspective.updateProjectionMatrix();
    const half: number = this.orthographic.userData.half ?? 2;
    Object.assign(this.orthographic, { left: (-half * width) / height, right: (half * width) / height, top: half, bottom: -half });
    this.orthographic.updateProjectionMatrix();
  }

  // Turns the view around what is looked at [rad].
  turn(angle: number) {
    this.perspective.position.sub(this.orbit.target).applyAxisAngle(UP, angle).add(this.orbit.target);
    this.perspective.lookAt(this.orbit.target);
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
