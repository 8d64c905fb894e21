// What the program sends: see src/viewer/*_message.hpp, which says the same from the other side.

export const PROTOCOL = 2;
export const PIECE_HEADER = 16;

export enum Topic { state = 1, frames = 2, image = 3, map = 4, mesh = 5, keyframe = 6 }
export enum Want { image = 1, depth = 2, masks = 4, map = 8, mesh = 16 }
export enum Status { initialising = 0, ok = 1, uncertain = 2, lost = 3, skipped = 4 }
export enum Point { unmatched = 0, inlier = 1, outlier = 2 }

export interface RunState {
  name: string;
  version: string;
  camera: { width: number; height: number; fx: number; fy: number; cx: number; cy: number; fps: number };
  can_pause: boolean;
  network: boolean;
  motion: boolean;
  dense: boolean;
  truth: boolean;
  paused: boolean;
  finished: boolean;
  maps: number;
  keyframes: number;
  landmarks: number;
  loops: number;
  mesh_triangles: number;
  mesh_voxel: number;
  expected_frames: number | null;
  ate: number | null;
  events: { frame: number; text: string }[];
}

export interface Pose { position: [number, number, number]; quaternion: [number, number, number, number] }

export interface Frame {
  frame: number;
  time: number;
  ms: number;
  network: number;
  motion: number;
  inliers: number;
  matches: number;
  high: number;
  low: number;
  status: Status;
  keyframe: boolean;
  loop: boolean;
  map: number;
  pose: Pose | null;
  frames: number;   // that it stands for: of long runs, old ones are merged
  tracked: number;  // of them
}

export interface CameraImage {
  frame: number;
  width: number;
  height: number;
  near: number;
  far: number;
  colour: Blob;
  depth: Blob | null;
  masks: Blob | null;
  points: { x: Float32Array; y: Float32Array; state: Uint8Array; high: Uint8Array };
}

export interface RunMap {
  map: number;
  path: Float32Array;        // x y z of each pose
  pathFrames: Uint32Array;
  keyframeIds: Uint32Array;
  keyframeFrames: Uint32Array;
  keyframePoses: Float32Array;  // seven of each: x y z, qx qy qz qw
  covisible: Uint32Array;       // pairs of places in the list of keyframes
  shared: Uint32Array;
  loops: Uint32Array;           // pairs
  landmarks: Float32Array;
  truth: Float32Array;
}

export interface Mesh {
  corner: [number, number, number];
  size: [number, number, number];
  positions: Uint16Array;
  colours: Uint8Array;
  triangles: Uint32Array;
}

export const decodeState = (bytes: Uint8Array): RunState => JSON.parse(new TextDecoder().decode(bytes));

const viewOf = (bytes: Uint8Array) => new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);

export function decodeFrames(bytes: Uint8Array): { first: number; frames: Frame[] } {
  const view = viewOf(bytes);
  const first = view.getUint32(0, true), count = view.getUint32(4, true);
  const frames: Frame[] = [];
  for (let i = 0; i < count; ++i) {
    const at = 8 + 72 * i;
    const number = (offset: number) => view.getFloat32(at + offset, true);
    const flags = view.getUint8(at + 33);
    frames.push({
      time: view.getFloat64(at, true),
      frame: view.getUint32(at + 8, true),
      ms: number(12),
      network: number(16),
      motion: number(20),
      inliers: view.getUint16(at + 24, true),
      matches: view.getUint16(at + 26, true),
      high: view.getUint16(at + 28, true),
      low: view.getUint16(at + 30, true),
      status: view.getUint8(at + 32),
      keyframe: (flags & 2) !== 0,
      loop: (flags & 4) !== 0,
      map: view.getUint16(at + 34, true),
      pose: (flags & 1) === 0 ? null : {
        position: [number(36), number(40), number(44)],
        quaternion: [number(48), number(52), number(56), number(60)],
      },
      frames: view.getUint32(at + 64, true),
      tracked: view.getUint32(at + 68, true),
    });
  }
  return { first, frames };
}

export function decodeImage(bytes: Uint8Array): CameraImage {
  const view = viewOf(bytes);
  const sizes = [16, 20, 24].map((at) => view.getUint32(at, true));
  const count = view.getUint32(28, true);
  const points = {
    x: new Float32Array(count), y: new Float32Array(count), state: new Uint8Array(count), high: new Uint8Array(count),
  };
  let at = 32;
  for (let i = 0; i < count; ++i, at += 6) {
    points.x[i] = view.getUint16(at, true) / 8;
    points.y[i] = view.getUint16(at + 2, true) / 8;
    points.state[i] = view.getUint8(at + 4);
    points.high[i] = view.getUint8(at + 5);
  }
  const blobs = sizes.map((size, i) => {
    const part = bytes.slice(at, at + size);
    at += size;
    return size === 0 ? null : new Blob([part], { type: i === 0 ? "image/jpeg" : "image/png" });
  });
  return {
    frame: view.getUint32(0, true),
    width: view.getUint16(4, true),
    height: view.getUint16(6, true),
    near: view.getFloat32(8, true),
    far: view.getFloat32(12, true),
    colour: blobs[0] ?? new Blob(),
    depth: blobs[1] ?? null,
    masks: blobs[2] ?? null,
    points,
  };
}

// `bytes` is a whole message in a buffer of its own: its numbers lie at multiples of four.
export function decodeMap(bytes: Uint8Array): RunMap {
  const words = new Uint32Array(bytes.buffer, 0, bytes.byteLength / 4);
  const numbers = new Float32Array(bytes.buffer, 0, bytes.byteLength / 4);
  const [map = 0, poses = 0, keyframes = 0, edges = 0, loops = 0, landmarks = 0, truth = 0] = words.subarray(0, 7);
  let at = 7;
  const path = new Float32Array(3 * poses), pathFrames = new Uint32Array(poses);
  for (let i = 0; i < poses; ++i, at += 4) {
    path.set(numbers.subarray(at, at + 3), 3 * i);
    pathFrames[i] = words[at + 3]!;
  }
  const keyframeIds = new Uint32Array(keyframes), keyframeFrames = new Uint32Array(keyframes);
  const keyframePoses = new Float32Array(7 * keyframes);
  for (let i = 0; i < keyframes; ++i, at += 9) {
    keyframeIds[i] = words[at]!;
    keyframeFrames[i] = words[at + 1]!;
    keyframePoses.set(numbers.subarray(at + 2, at + 9), 7 * i);
  }
  const covisible = new Uint32Array(2 * edges), shared = new Uint32Array(edges);
  for (let i = 0; i < edges; ++i, at += 3) {
    covisible.set(words.subarray(at, at + 2), 2 * i);
    shared[i] = words[at + 2]!;
  }
  const take = (count: number) => (at += count, [at - count, at] as const);
  return {
    map, path, pathFrames, keyframeIds, keyframeFrames, keyframePoses, covisible, shared,
    loops: words.slice(...take(2 * loops)),
    landmarks: numbers.subarray(...take(3 * landmarks)),
    truth: numbers.subarray(...take(3 * truth)),
  };
}

export function decodeMesh(bytes: Uint8Array): Mesh {
  const head = new Float32Array(bytes.buffer, 0, 6);
  const [vertices = 0, triangles = 0] = new Uint32Array(bytes.buffer, 24, 2);
  const colours = 32 + 6 * vertices, indices = Math.ceil((colours + 3 * vertices) / 4) * 4;
  return {
    corner: [head[0]!, head[1]!, head[2]!],
    size: [head[3]!, head[4]!, head[5]!],
    positions: new Uint16Array(bytes.buffer, 32, 3 * vertices),
    colours: new Uint8Array(bytes.buffer, colours, 3 * vertices),
    triangles: new Uint32Array(bytes.buffer, indices, 3 * triangles),
  };
}

export function decodeKeyframe(bytes: Uint8Array): { frame: number; image: Blob | null } {
  const frame = viewOf(bytes).getUint32(0, true);
  return { frame, image: bytes.length > 4 ? new Blob([bytes.slice(4)], { type: "image/jpeg" }) : null };
}
