import { Theme } from "./colours";
import { Model } from "./model";

// The path from above, for browsers without WebGL. World: x to the right, z ahead, as the first camera saw it.
export function drawPlan(canvas: HTMLCanvasElement, model: Model, theme: Theme) {
  const scale = Math.min(2, window.devicePixelRatio || 1);
  const width = Math.round(canvas.clientWidth * scale), height = Math.round(canvas.clientHeight * scale);
  if (width === 0 || height === 0) return;
  Object.assign(canvas, { width, height });
  const pen = canvas.getContext("2d")!, path = model.path(), landmarks = model.map?.landmarks ?? new Float32Array();
  const xs: number[] = [], zs: number[] = [];
  const collect = (points: Float32Array, step: number) => {
    for (let i = 0; i + 2 < points.length; i += 3 * step) {
      xs.push(points[i]!);
      zs.push(points[i + 2]!);
    }
  };
  collect(path, 1);
  collect(landmarks, Math.max(1, Math.floor(landmarks.length / 6000)));
  if (xs.length === 0) return;
  const bound = (values: number[], share: number) => {
    const sorted = [...values].sort((a, b) => a - b);
    return sorted[Math.floor(share * (sorted.length - 1))]!;
  };
  const left = bound(xs, 0.01), right = bound(xs, 0.99), near = bound(zs, 0.01), far = bound(zs, 0.99);
  const zoom = 0.88 * Math.min(width / Math.max(0.5, right - left), height / Math.max(0.5, far - near));
  const u = (x: number) => width / 2 + (x - (left + right) / 2) * zoom;
  const v = (z: number) => height / 2 - (z - (near + far) / 2) * zoom;
  pen.clearRect(0, 0, width, height);
  pen.fillStyle = theme.landmark;
  pen.globalAlpha = 0.8;
  for (let i = 0; i + 2 < landmarks.length; i += 3) pen.fillRect(u(landmarks[i]!), v(landmarks[i + 2]!), 1.7 * scale, 1.7 * scale);
  pen.globalAlpha = 1;
  const line = (points: Float32Array, colour: string, dash: number[]) => {
    pen.strokeStyle = colour;
    pen.lineWidth = 2 * scale;
    pen.setLineDash(dash.map((d) => d * scale));
    pen.beginPath();
    for (let i = 0; i + 2 < points.length; i += 3) pen.lineTo(u(points[i]!), v(points[i + 2]!));
    pen.stroke();
    pen.setLineDash([]);
  };
  if (model.map) line(model.map.truth, theme.truth, [5, 4]);
  line(path, theme.path, []);
  const poses = model.map?.keyframePoses ?? new Float32Array();
  pen.fillStyle = theme.keyframe;
  for (let i = 0; i < poses.length; i += 7) pen.fillRect(u(poses[i]!) - 2 * scale, v(poses[i + 2]!) - 2 * scale, 4 * scale, 4 * scale);
}
