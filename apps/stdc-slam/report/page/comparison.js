// Several runs side by side.

const inMillimetres = (metres) => (isNumber(metres) ? 1e3 * metres : undefined);

/** Rows of the table: name, value of a run, how to print it, which is better. */
const comparedRows = [
  ["frames with a pose", (s) => s.coverage, (v) => percent(v), "high"],
  ["ATE, RMSE, mm", (s) => inMillimetres(at(s, "scores.ate_m.rmse")), number, "low"],
  ["ATE, median, mm", (s) => inMillimetres(at(s, "scores.ate_m.median")), number, "low"],
  ["ATE, largest, mm", (s) => inMillimetres(at(s, "scores.ate_m.max")), number, "low"],
  ["RPE per frame, RMSE, mm", (s) => inMillimetres(at(s, "scores.rpe_frame_translation_m.rmse")), number, "low"],
  ["RPE per frame, RMSE, °", (s) => at(s, "scores.rpe_frame_rotation_deg.rmse"), number, "low"],
  ["RPE per second, RMSE, mm", (s) => inMillimetres(at(s, "scores.rpe_second_translation_m.rmse")), number, "low"],
  ["RPE per second, RMSE, °", (s) => at(s, "scores.rpe_second_rotation_deg.rmse"), number, "low"],
  ["off by more than 5 cm, frames", (s) => at(s, "scores.off_by_5_cm"), number, "low"],
  ["uncertain frames", (s) => at(s, "frames.uncertain"), number, "low"],
  ["lost frames", (s) => at(s, "frames.lost"), number, "low"],
  ["time per frame, median, ms", (s) => at(s, "stage_milliseconds.total.median"), number, "low"],
  ["time per frame, 99 %, ms", (s) => at(s, "stage_milliseconds.total.p99"), number, "low"],
  ["CPU per frame, ms", (s) => (1e3 * s.cpu_seconds) / at(s, "frames.total"), number, "low"],
  ["memory, peak, MB", (s) => s.peak_memory_mb, number, "low"],
  ["masks, IoU", (s) => at(s, "mask_scores.iou"), (v) => percent(v), "high"],
  ["keyframes", (s) => s.keyframes, number],
  ["landmarks", (s) => s.landmarks, number],
  ["loops closed", (s) => s.loops, number],
  ["maps", (s) => s.maps, number],
];

function runName(run, index) {
  const list = runColours(colours());
  return element("span", {}, element("span", { class: "swatch", style: `background:${list[index % list.length]}` }), run.label);
}

function comparedTable(runs) {
  const rows = [];
  for (const [name, value, print, better] of comparedRows) {
    const values = runs.map((run) => value(run.summary || {}));
    const known = values.filter(isNumber);
    if (!known.length) continue;
    const best = better === "high" ? Math.max(...known) : Math.min(...known);
    // Numbers that look the same are as good as each other; where all do, none is best.
    const texts = values.map((one) => (isNumber(one) ? print(one) : "–"));
    const differs = better && new Set(known.map((one) => print(one))).size > 1;
    rows.push([name, ...values.map((one, i) => ({ text: texts[i], best: differs && texts[i] === print(best) }))]);
  }
  return table(["", ...runs.map(runName)], rows);
}

/** The settings in which the runs differ. */
function differingSettings(runs) {
  const with_settings = runs.filter((run) => run.settings);
  if (with_settings.length < 2) return null;
  const values = with_settings.map((run) => new Map(run.settings.map((one) => [one.name, one.value])));
  const names = [...new Set(with_settings.flatMap((run) => run.settings.map((one) => one.name)))];
  const rows = names.filter((name) => new Set(values.map((map) => map.get(name))).size > 1)
    .map((name) => [name, ...values.map((map) => (map.has(name) ? map.get(name) : "–"))]);
  if (!rows.length) return note("The settings of all runs are the same.");
  return table(["setting", ...with_settings.map((run) => run.label)], rows);
}

/** The same frames of each run beside each other. */
function comparedShots(runs) {
  const images = runs.map((run) => new Map((run.images || []).map((image) => [image.frame, image])));
  const numbers = [...new Set(images.flatMap((map) => [...map.keys()]))].sort((a, b) => a - b)
    .filter((frame) => images.filter((map) => map.has(frame)).length > 1 || runs.length === 1);
  if (!numbers.length) return null;
  const cell = (map, frame, run) => (map.has(frame) ? element("img", { src: map.get(frame).uri, alt: `Frame ${frame} of ${run.label}` }) : "–");
  return [element("h3", {}, "Sample frames"),
    table(["frame", ...runs.map((run) => run.label)], numbers.map((frame) => [String(frame), ...images.map((map, i) => cell(map, frame, runs[i]))]), false)];
}

function comparedWarnings(runs) {
  const rows = runs.filter((run) => run.warnings && run.warnings.length)
    .map((run) => element("li", {}, element("strong", {}, run.label + ": "), run.warnings.join("; ")));
  return rows.length ? element("div", { class: "box warn" }, element("ul", {}, rows)) : null;
}

/** A group of runs; `prefix` keeps the ids of several groups apart. */
function comparison(group, prefix) {
  const runs = group.runs, parts = [];
  const some = (test) => runs.some(test);
  if (some((run) => at(run, "frames.error_mm"))) {
    parts.push(figure(prefix + "error", 300, true, "Distance from the ground truth.",
      overlayFigure(runs, "error [mm]", (run) => at(run, "frames.error_mm"), "%{y:.1f} mm")));
  }
  const pair = [];
  if (sharesWorld(runs)) {
    pair.push(figure(prefix + "plan", 400, false, "From above, each aligned to the ground truth.", overlayPlan(runs)));
    pair.push(figure(prefix + "height", 400, false, "Height over time.", overlayHeight(runs)));
  }
  if (some((run) => at(run, "quantiles.error_mm"))) {
    pair.push(figure(prefix + "error-share", 300, false, "Share of the frames with less error: further left is better.", shareFigure(runs, "error_mm", "error [mm]")));
  }
  if (some((run) => at(run, "quantiles.total_ms"))) {
    pair.push(figure(prefix + "time-share", 300, false, "Share of the frames that took less time.", shareFigure(runs, "total_ms", "time per frame [ms]", runs[0].period_ms)));
  }
  parts.push(...pair);
  if (some((run) => at(run, "frames.inliers"))) {
    parts.push(figure(prefix + "inliers", 240, true, "Keypoints that agree with the pose.", overlayFigure(runs, "inliers", (run) => at(run, "frames.inliers"), "%{y}")));
    parts.push(figure(prefix + "times", 240, true, "Time of the tracking thread.", overlayFigure(runs, "time [ms]", (run) => at(run, "frames.total_ms"), "%{y:.1f} ms")));
  }
  return [comparedTable(runs), element("div", { class: "plots" }, parts), comparedShots(runs)];
}
