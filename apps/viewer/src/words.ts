import { Model } from "./model";
import { Status } from "./protocol";

export type Mood = "good" | "doubtful" | "bad" | "quiet";
export interface Words { mood: Mood; sign: string; text: string; notes: string[] }

const percent = (share: number) => `${(100 * share).toFixed(1)} %`;

export const counted = (count: number, what: string) => `${count.toLocaleString("en")} ${what}${count === 1 ? "" : "s"}`;

function ofFrame(model: Model): [Mood, string, string] {
  const frame = model.last;
  if (!frame) return ["quiet", "○", "Waiting for the first frame"];
  switch (frame.status) {
    case Status.ok: return ["good", "✓", `Tracking: ${frame.inliers} points agree`];
    case Status.uncertain: return ["doubtful", "?", "Uncertain: too little of the room agrees with the pose"];
    case Status.lost: return ["bad", "✕", "Lost: looking for a place that it knows"];
    case Status.skipped: return ["doubtful", "–", "Frame skipped: it could not be used"];
    default: return ["quiet", "○", "Looking for a start: too few points with depth"];
  }
}

// The state of the run in a sentence, and what one ought to know besides.
export function wordsFor(model: Model, connected: boolean, ended: boolean): Words {
  const frames = model.total, coverage = model.coverage.at(-1) ?? 0;
  const notes: string[] = [];
  if (frames > 60 && coverage < 0.99) notes.push(`${percent(coverage)} of the frames have a pose`);
  const time = model.recentTime();
  if (frames > 60 && time > model.period) {
    notes.push(`slower than the camera: ${time.toFixed(0)} ms a frame, ${model.period.toFixed(0)} ms between frames`);
  }
  if (model.state && model.state.maps > 1) notes.push(`${model.state.maps} maps that are not joined yet; the present one is shown`);
  const say = (mood: Mood, sign: string, text: string): Words => ({ mood, sign, text, notes });
  if (ended || model.state?.finished) {
    return say(frames > 0 && coverage < 0.5 ? "doubtful" : "quiet", "■",
      `Finished: ${frames} frames, ${percent(coverage)} with a pose. This page keeps what it has`);
  }
  if (!connected) {
    return say("bad", "…", frames === 0 ? "Waiting for stdc-slam" : "stdc-slam does not answer: it has ended, or the line is down");
  }
  if (model.state?.paused) return say("quiet", "‖", `Paused at frame ${model.last?.frame ?? 0}`);
  return say(...ofFrame(model));
}
