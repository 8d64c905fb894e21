import { Mesh } from "./protocol";

// Whether WebGL is done by the CPU: then there is less of everything while the picture moves.
export function drawsInSoftware(): boolean {
  const gl = document.createElement("canvas").getContext("webgl");
  const info = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = info ? String(gl!.getParameter(info.UNMASKED_RENDERER_WEBGL)) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

// Triangles of a coarser mesh over the same vertices: all vertices of a cell become one of them (Rossignac and Borrel,
// 'Multi-resolution 3D approximations for rendering complex scenes', 1993), and triangles within a cell go.
export function coarseTriangles(mesh: Mesh): Uint32Array {
  const bits = 7, shift = 16 - bits, none = 0xffffffff;
  const first = new Uint32Array(1 << (3 * bits)).fill(none);
  const vertices = mesh.positions.length / 3, stands = new Uint32Array(vertices);
  for (let v = 0; v < vertices; ++v) {
    const p = mesh.positions, at = 3 * v;
    const cell = ((p[at]! >> shift) << (2 * bits)) | ((p[at + 1]! >> shift) << bits) | (p[at + 2]! >> shift);
    if (first[cell] === none) first[cell] = v;
    stands[v] = first[cell]!;
  }
  const coarse = new Uint32Array(mesh.triangles.length);
  let count = 0;
  for (let t = 0; t < mesh.triangles.length; t += 3) {
    const a = stands[mesh.triangles[t]!]!, b = stands[mesh.triangles[t + 1]!]!, c = stands[mesh.triangles[t + 2]!]!;
    if (a === b || b === c || c === a) continue;
    coarse[count++] = a;
    coarse[count++] = b;
    coarse[count++] = c;
  }
  return coarse.slice(0, count);
}

// Every so many-th point, at most `max` of them.
export function sparse(count: number, max: number): Uint32Array {
  const step = Math.max(1, Math.ceil(count / max));
  return Uint32Array.from({ length: Math.ceil(count / step) }, (_, i) => i * step);
}

// A line through at most `max` of its points, the last one included.
export function thinned(points: Float32Array, max: number): Float32Array {
  const count = points.length / 3;
  if (count <= max) return points;
  const kept = sparse(count, max - 1), line = new Float32Array(3 * (kept.length + 1));
  kept.forEach((from, i) => line.set(points.subarray(3 * from, 3 * from + 3), 3 * i));
  line.set(points.subarray(points.length - 3), 3 * kept.length);
  return line;
}
