import { Vector3 } from "three";
import { RunState } from "./protocol";

// Corners and edges of a camera: the tip, then its image's corners from the top left, clockwise.
export function frustum(state: RunState | null, depth: number): { corners: Vector3[]; edges: number[] } {
  const c = state?.camera ?? { width: 640, height: 480, fx: 525, fy: 525, cx: 320, cy: 240, fps: 30 };
  const left = (-c.cx / c.fx) * depth, right = ((c.width - c.cx) / c.fx) * depth;
  const top = (-c.cy / c.fy) * depth, bottom = ((c.height - c.cy) / c.fy) * depth;
  const corners = [
    new Vector3(), new Vector3(left, top, depth), new Vector3(right, top, depth),
    new Vector3(right, bottom, depth), new Vector3(left, bottom, depth),
  ];
  return { corners, edges: [0, 1, 0, 2, 0, 3, 0, 4, 1, 2, 2, 3, 3, 4, 4, 1] };
}
