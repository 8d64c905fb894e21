import { Scene3D } from "./scene";

// Draws some pictures as fast as it goes while the view turns, at a level of detail: milliseconds of each.
export function measure(scene: Scene3D, count: number, level: number): number[] {
  const times: number[] = [];
  for (let i = 0; i < count; ++i) {
    const begin = performance.now();
    scene.turn(0.02);
    scene.drawAt(level);
    times.push(performance.now() - begin);
  }
  return times;
}

// Turns the view for some time as a hand does: milliseconds between the pictures that were drawn.
export function turning(scene: Scene3D, milliseconds: number): Promise<number[]> {
  const times: number[] = [], end = performance.now() + milliseconds;
  let last = performance.now();
  return new Promise((resolve) => {
    const step = () => {
      const now = performance.now();
      times.push(now - last);
      last = now;
      if (now > end) return resolve(times);
      scene.turn(0.01);
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  });
}
