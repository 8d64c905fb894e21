import { BufferAttribute, BufferGeometry, Matrix4, Quaternion, Vector3 } from "three";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import { RunMap } from "./protocol";

// Another geometry of these points for a thing that is drawn; the old one is freed.
export function replacePoints(object: { geometry: BufferGeometry }, positions: Float32Array) {
  object.geometry.dispose();
  object.geometry = new BufferGeometry();
  object.geometry.setAttribute("position", new BufferAttribute(positions, 3));
}

// The same for lines of some width, given by both ends of each.
export function replaceWideLines(object: { geometry: LineSegmentsGeometry }, ends: ArrayLike<number>) {
  object.geometry.dispose();
  object.geometry = new LineSegmentsGeometry();
  if (ends.length > 0) object.geometry.setPositions(Float32Array.from(ends));
}

export function hasPoints(object: { geometry: BufferGeometry }): boolean {
  return (object.geometry.getAttribute("position")?.count ?? 0) > 0;
}

// For lines of some width.
export function hasLines(object: { geometry: BufferGeometry }): boolean {
  return (object.geometry.getAttribute("instanceStart")?.count ?? 0) > 0;
}

export function keyframePose(map: RunMap, i: number): Matrix4 {
  const p = map.keyframePoses.subarray(7 * i, 7 * i + 7);
  return new Matrix4().compose(new Vector3(p[0], p[1], p[2]), new Quaternion(p[3], p[4], p[5], p[6]), new Vector3(1, 1, 1));
}

// Positions of keyframes, one after the other.
export function keyframePositions(map: RunMap, keyframes: Uint32Array): Float32Array {
  const positions = new Float32Array(3 * keyframes.length);
  keyframes.forEach((keyframe, i) => positions.set(map.keyframePoses.subarray(7 * keyframe, 7 * keyframe + 3), 3 * i));
  return positions;
}
