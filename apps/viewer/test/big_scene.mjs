// A map and a mesh of the size that the page has to bear: 200,000 landmarks, 1,000 keyframes, a path of 10,000 poses and a
// mesh of a million triangles. To be called in the page, which shows it then; gives words about it.
export function showBigScene() {
  const scene = window.stdcViewer.scene, model = window.stdcViewer.model;
  // A room of 8 x 3 x 8 m whose walls have bumps.
  const landmarks = new Float32Array(3 * 200000);
  for (let i = 0; i < landmarks.length; ++i) landmarks[i] = (Math.random() - 0.5) * (i % 3 === 1 ? 3 : 8);
  const keyframes = 1000, poses = new Float32Array(7 * keyframes), path = new Float32Array(3 * 10 * keyframes);
  for (let i = 0; i < keyframes; ++i) {
    poses.set([2 * Math.cos(i / 50), 0.2 * Math.sin(i / 9), 2 * Math.sin(i / 50), 0, 0, 0, 1], 7 * i);
  }
  for (let i = 0; i < 10 * keyframes; ++i) path.set([2 * Math.cos(i / 500), 0.2 * Math.sin(i / 90), 2 * Math.sin(i / 500)], 3 * i);
  const covisible = new Uint32Array(2 * 8 * keyframes);
  for (let i = 0; i < 8 * keyframes; ++i) covisible.set([i >> 3, Math.max(0, (i >> 3) - 1 - (i & 7))], 2 * i);
  const map = { map: 0, path, pathFrames: new Uint32Array(10 * keyframes), keyframeIds: new Uint32Array(keyframes),
    keyframeFrames: new Uint32Array(keyframes), keyframePoses: poses, covisible, shared: new Uint32Array(8 * keyframes),
    loops: new Uint32Array(), landmarks, truth: path };
  model.map = map;
  const side = 290, sheets = 6, vertices = side * side * sheets;
  const positions = new Uint16Array(3 * vertices), colours = new Uint8Array(3 * vertices);
  const triangles = new Uint32Array(3 * 2 * (side - 1) * (side - 1) * sheets);
  let v = 0, t = 0;
  for (let s = 0; s < sheets; ++s) {
    const first = v;
    for (let i = 0; i < side * side; ++i, ++v) {
      const a = (i % side) / (side - 1), b = Math.floor(i / side) / (side - 1), bump = 0.02 * Math.sin(40 * a) * Math.sin(40 * b);
      const wall = s & 1 ? 1 - bump : bump, point = [a, b];
      point.splice(s >> 1, 0, wall);
      positions.set(point.map((x) => 65535 * Math.min(1, Math.max(0, x))), 3 * v);
      colours.set([100 + 100 * a, 90 + 30 * s, 100 + 100 * b], 3 * v);
    }
    for (let i = 0; i < side * (side - 1); ++i) {
      if (i % side === side - 1) continue;
      const a = first + i, flip = (s & 1) === (s >> 1 === 1 ? 1 : 0);
      triangles.set(flip ? [a, a + 1, a + side, a + 1, a + side + 1, a + side] : [a, a + side, a + 1, a + 1, a + side, a + side + 1], t);
      t += 6;
    }
  }
  const begin = performance.now();
  scene.setMap(map);
  scene.setMesh({ corner: [-4, -1.5, -4], size: [8, 3, 8], positions, colours, triangles });
  const taken = performance.now() - begin;
  scene.setPath(path);
  scene.fit();
  return `taking it: ${taken.toFixed(0)} ms; ${triangles.length / 3} triangles, canvas ${scene.canvas.width} x ${scene.canvas.height}`;
}
