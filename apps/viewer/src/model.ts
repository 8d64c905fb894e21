import { Frame, RunMap, RunState, Status } from "./protocol";

const maxRecords = 40000;

const trouble = [Status.ok, Status.skipped, Status.initialising, Status.uncertain, Status.lost];

// Of two that follow each other the worst, and the pose of the later.
function merged(first: Frame, second: Frame): Frame {
  const pose = second.pose ? second : first;
  return {
    ...second,
    pose: pose.pose, map: pose.map,
    ms: Math.max(first.ms, second.ms),
    network: Math.max(first.network, second.network),
    motion: Math.max(first.motion, second.motion),
    inliers: Math.min(first.inliers, second.inliers),
    matches: Math.min(first.matches, second.matches),
    status: trouble[Math.max(trouble.indexOf(first.status), trouble.indexOf(second.status))]!,
    keyframe: first.keyframe || second.keyframe,
    loop: first.loop || second.loop,
    frames: first.frames + second.frames,
    tracked: first.tracked + second.tracked,
  };
}

// What is known of the run.
export class Model {
  state: RunState | null = null;
  frames: Frame[] = [];     // of a long run, an old one stands for several
  starts: number[] = [];    // the number of the first frame that each stands for
  coverage: number[] = [];  // share of the frames up to each that has a pose
  total = 0;                // frames, all in all
  map: RunMap | null = null;
  private tracked = 0;
  private perRecord = 1;

  reset() {
    this.frames = [];
    this.starts = [];
    this.coverage = [];
    this.map = null;
    this.total = this.tracked = 0;
    this.perRecord = 1;
  }

  // Frames from the `first` on; those that are known already are passed over.
  add(first: number, frames: Frame[]) {
    if (first === 0 && this.frames.length > 0) this.reset();
    let start = first;
    for (const frame of frames) {
      if (start >= this.total) {
        this.starts.push(start);
        this.frames.push(frame);
        this.total = start + frame.frames;
        this.tracked += frame.tracked;
        this.coverage.push(this.tracked / this.total);
      }
      start += frame.frames;
    }
    if (this.frames.length > maxRecords) this.thinOut();
  }

  // The program does the same (src/viewer/frame_history.hpp): memory is bounded, however long the run.
  private thinOut() {
    const old = this.frames.length >> 1;
    let kept = old;
    while (true) {
      let last = 0;
      for (let i = 1; i < kept; ++i) {
        const before = this.frames[last]!, frame = this.frames[i]!;
        if (before.frames + frame.frames <= this.perRecord) {
          this.frames[last] = merged(before, frame);
        } else {
          this.frames[++last] = frame;
          this.starts[last] = this.starts[i]!;
        }
        this.coverage[last] = this.coverage[i]!;
      }
      kept = last + 1;
      if (kept === 1 || kept <= maxRecords / 4) break;
      this.perRecord *= 2;
    }
    for (const list of [this.frames, this.starts, this.coverage]) list.splice(kept, old - kept);
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
