import { BufferAttribute, BufferGeometry, Camera, ColorRepresentation, LineBasicMaterial, LineSegments, Object3D, Vector3 } from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import { okabe } from "./colours";
import { sparse } from "./detail";
import { frustum } from "./frustum";
import { hasPoints, keyframePose, replacePoints, replaceWideLines } from "./geometry";
import { RunMap, RunState } from "./protocol";

// Keyframes as small frusta, one of which can be picked.
export class DrawnKeyframes {
  readonly pickedMaterial = new LineMaterial({ linewidth: 3.5, color: okabe.vermillion });
  private readonly frusta = new LineSegments(new BufferGeometry(), new LineBasicMaterial());
  private readonly picked = new LineSegments2(new LineSegmentsGeometry(), this.pickedMaterial);
  private few: BufferAttribute | null = null;  // to draw at the coarsest level
  private map: RunMap | null = null;
  private state: RunState | null = null;
  private pickedFrame: number | null = null;

  constructor(private readonly canvas: HTMLCanvasElement) {}

  get objects(): Object3D[] { return [this.frusta, this.picked]; }

  setColour(colour: ColorRepresentation) { this.frusta.material.color.set(colour); }

  setState(state: RunState) { this.state = state; }

  set(map: RunMap) {
    this.map = map;
    replacePoints(this.frusta, this.edges(map));
    const ends = 16, some = sparse(map.keyframeIds.length, 200);  // ends of lines of a keyframe
    this.few = new BufferAttribute(Uint32Array.from({ length: ends * some.length },
      (_, i) => ends * some[Math.floor(i / ends)]! + (i % ends)), 1);
    if (this.pickedFrame !== null) this.mark(this.pickedFrame);
  }

  private edges(map: RunMap): Float32Array {
    const { corners, edges } = frustum(this.state, 0.11), count = map.keyframeIds.length;
    const positions = new Float32Array(3 * edges.length * count), corner = new Vector3();
    for (let i = 0; i < count; ++i) {
      const pose = keyframePose(map, i);
      const placed = corners.map((c) => corner.copy(c).applyMatrix4(pose).toArray());
      edges.forEach((e, k) => positions.set(placed[e]!, 3 * (edges.length * i + k)));
    }
    return positions;
  }

  show(shown: boolean) { this.frusta.visible = shown && hasPoints(this.frusta); }

  setLevel(level: number) { this.frusta.geometry.setIndex(level < 3 ? null : this.few); }

  // Frame of the keyframe whose camera is drawn next to a pixel; no farther than `reach`.
  nearest(camera: Camera, x: number, y: number, reach: number): number | null {
    let best: number | null = null, nearest = reach;
    for (let i = 0; i < (this.map?.keyframeIds.length ?? 0); ++i) {
      const place = this.placeOf(i, camera);
      if (!place || Math.abs(place.depth) > 1) continue;
      const distance = Math.hypot(place.x - x, place.y - y);
      if (distance < nearest) [nearest, best] = [distance, i];
    }
    return best === null ? null : this.map!.keyframeFrames[best]!;
  }

  // Where on the canvas a keyframe is drawn; its depth is between -1 and 1 if it is in front of the view.
  placeOf(i: number, camera: Camera): { x: number; y: number; depth: number } | null {
    if (!this.map || i >= this.map.keyframeIds.length) return null;
    const point = new Vector3().fromArray(this.map.keyframePoses, 7 * i).project(camera);
    return { x: (0.5 + 0.5 * point.x) * this.canvas.clientWidth, y: (0.5 - 0.5 * point.y) * this.canvas.clientHeight, depth: point.z };
  }

  // As the one that is picked; null: none.
  mark(frame: number | null) {
    this.pickedFrame = frame;
    const at = frame === null || !this.map ? -1 : this.map.keyframeFrames.indexOf(frame);
    this.picked.visible = at >= 0;
    if (at < 0 || !this.map) return;
    const { corners, edges } = frustum(this.state, 0.16), pose = keyframePose(this.map, at);
    replaceWideLines(this.picked, edges.flatMap((e) => corners[e]!.clone().applyMatrix4(pose).toArray()));
  }
}
