import { Frame, RunMap, RunState, Status } from "./protocol";

// What is known of the run.
export class Model {
  state: RunState | null = null;
  frames: Frame[] = [];
  coverage: number[] = [];  // share of the frames up to each that has a pose
  map: RunMap | null = null;
  private posed = 0;

  reset() {
    this.frames = [];
    this.coverage = [];
    this.map = null;
    this.posed = 0;
  }

  // Frames from the `first` on; those that are known already are passed over.
  add(first: number, frames: Frame[]) {
    if (first === 0 && this.frames.length > 0) this.reset();
    for (const frame of frames.slice(Math.max(0, this.frames.length - first))) {
      this.frames.push(frame);
      this.posed += frame.status === Status.ok ? 1 : 0;
      this.coverage.push(this.posed / this.frames.length);
    }
  }

  get last(): Frame | null { return this.frames.at(-1) ?? null; }
  get lastPosed(): Frame | null {
    for (let i = this.frames.length - 1; i >= 0; --i) if (this.frames[i]!.pose) return this.frames[i]!;
    return null;
  }
  // The camera's period [ms].
  get period(): number { return 1000 / (this.state?.camera.fps ?? 30); }

  // Median time of the last frames [ms].
  recentTime(count = 60): number {
    const times = this.frames.slice(-count).filter((f) => f.status !== Status.skipped).map((f) => f.ms);
    times.sort((a, b) => a - b);
    return times[Math.floor(times.length / 2)] ?? 0;
  }

  // Positions of the camera in the map that is shown: as it is known now where the map says so, and as it was
  // tracked from there on.
  path(): Float32Array {
    const known = this.map?.path ?? new Float32Array();
    const map = this.map?.map ?? this.lastPosed?.map ?? 0;
    const frames = this.map?.pathFrames;
    const newest = frames && frames.length > 0 ? frames[frames.length - 1]! : -1;
    const tail: number[] = [];
    for (let i = this.frames.length - 1; i >= 0 && this.frames[i]!.frame > newest; --i) {
      const frame = this.frames[i]!, next = this.frames[i + 1];
      if (next && next.frame <= frame.frame) break;  // the run began anew there
      if (frame.pose && frame.status === Status.ok && frame.map === map) tail.push(...frame.pose.position.slice().reverse());
    }
    const path = new Float32Array(known.length + tail.length);
    path.set(known);
    path.set(tail.reverse(), known.length);
    return path;
  }
}
