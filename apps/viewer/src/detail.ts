import { Mesh } from "./protocol";

// Triangles of a coarser mesh over the same vertices: all vertices of a cell, one of 2^bits along each side of the mesh's
// box, become one of them (Rossignac and Borrel, 'Multi-resolution 3D approximations for rendering complex scenes', 1993).
function clustered(mesh: Mesh, bits: number): Uint32Array {
  const shift = 16 - bits, none = 0xffffffff;
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

// Without the vertices that no triangle uses.
function compacted(mesh: Mesh, triangles: Uint32Array): Mesh {
  const place = new Uint32Array(mesh.positions.length / 3), used: number[] = [];
  for (const vertex of triangles) if (place[vertex] === 0) place[vertex] = used.push(vertex);
  const positions = new Uint16Array(3 * used.length), colours = new Uint8Array(3 * used.length);
  used.forEach((vertex, i) => {
    positions.set(mesh.positions.subarray(3 * vertex, 3 * vertex + 3), 3 * i);
    colours.set(mesh.colours.subarray(3 * vertex, 3 * vertex + 3), 3 * i);
  });
  return { ...mesh, positions, colours, triangles: triangles.map((vertex) => place[vertex]! - 1) };
}

// The finest of such meshes with `max` triangles at most, or nearly so.
export function coarseMesh(mesh: Mesh, max: number): Mesh {
  if (mesh.triangles.length <= 3 * max) return mesh;
  let triangles = mesh.triangles;
  for (let bits = 7; bits >= 4 && triangles.length > 3 * max; --bits) triangles = clustered(mesh, bits);
  return compacted(mesh, triangles);
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

// The pieces of a line, each by its two ends; every `step`-th of them, so that 2 makes dashes.
export function segments(points: Float32Array, step: number): Float32Array {
  const pieces = Math.max(0, Math.ceil((points.length / 3 - 1) / step)), ends = new Float32Array(6 * pieces);
  for (let i = 0; i < pieces; ++i) ends.set(points.subarray(3 * i * step, 3 * i * step + 6), 6 * i);
  return ends;
}
