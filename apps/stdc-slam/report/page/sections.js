// The parts of the page that are words, tables and pictures.

function tile(name, value, more) {
  return element("div", { class: "tile" }, element("div", { class: "name" }, name), element("div", { class: "value" }, value),
    more ? element("div", { class: "more" }, more) : null);
}

function withUnit(value, unit) {
  return [number(value), element("small", {}, " " + unit)];
}

/** The figures that people look for first. */
function tiles(run) {
  const s = run.summary, made = [];
  const ate = at(s, "scores.ate_m");
  if (ate) made.push(tile("error (ATE, RMSE)", withUnit(1e3 * ate.rmse, "mm"), `median ${number(1e3 * ate.median)}, largest ${number(1e3 * ate.max)} mm`));
  if (isNumber(s.coverage)) made.push(tile("frames with a pose", percent(s.coverage), framesText(s)));
  const total = at(s, "stage_milliseconds.total");
  if (total) {
    made.push(tile("time per frame, median", withUnit(total.median, "ms"),
      `99 %: ${number(total.p99)} ms` + (isNumber(run.period_ms) ? `; a frame comes every ${number(run.period_ms)} ms` : "")));
  }
  if (isNumber(run.duration_s)) {
    made.push(tile("length of the trajectory", withUnit(run.length_m, "m"), `in ${number(run.duration_s)} s`));
  }
  if (isNumber(s.keyframes)) made.push(tile("map", [number(s.keyframes), element("small", {}, " keyframes")], `${s.landmarks} landmarks${s.maps > 1 ? `, ${s.maps} maps` : ""}`));
  if (isNumber(s.loops)) made.push(tile("loops closed", number(s.loops), s.merges ? `${s.merges} maps joined` : null));
  const people = at(s, "segmentation.dynamic_share.median"), moving = at(s, "motion.moving_share.mean");
  if (isNumber(people) || isNumber(moving)) {
    made.push(tile("dynamic part of the view", percent(isNumber(moving) ? moving : people, 0),
      isNumber(moving) ? "mean, by geometry" : "median, by the network"));
  }
  if (isNumber(s.peak_memory_mb)) made.push(tile("memory, peak", withUnit(s.peak_memory_mb, "MB"), `CPU ${number(s.cpu_seconds)} s in all`));
  const masks = s.mask_scores;
  if (masks) made.push(tile("masks: IoU", percent(masks.iou), `precision ${percent(masks.precision)}, recall ${percent(masks.recall)}`));
  if (s.dense) made.push(tile("dense map", [number(s.dense.triangles), element("small", {}, " triangles")], `of ${s.dense.views} views at ${number(100 * s.dense.voxel_m)} cm; CPU ${number(s.dense.cpu_ms_per_frame)} ms a frame, then ${number(s.dense.cpu_seconds)} s`));
  return element("div", { class: "tiles" }, made);
}

function framesText(s) {
  const names = ["uncertain", "lost", "initialising", "skipped"];
  const others = names.filter((name) => at(s, "frames." + name) > 0).map((name) => `${s.frames[name]} ${name}`);
  return `of ${at(s, "frames.total")}${others.length ? ": " + others.join(", ") : ""}`;
}

function warningsBox(warnings) {
  if (!warnings) return null;
  if (!warnings.length) return element("div", { class: "box" }, "Nothing looks wrong.");
  return element("div", { class: "box warn" },
    element("strong", {}, warnings.length === 1 ? "Worth a look" : `${warnings.length} things worth a look`),
    element("ul", {}, warnings.map((text) => element("li", {}, text))));
}

const scoreRows = [
  ["ATE", "ate_m", 1e3, "mm"],
  ["RPE per frame, translation", "rpe_frame_translation_m", 1e3, "mm"],
  ["RPE per frame, rotation", "rpe_frame_rotation_deg", 1, "°"],
  ["RPE per second, translation", "rpe_second_translation_m", 1e3, "mm"],
  ["RPE per second, rotation", "rpe_second_rotation_deg", 1, "°"],
];

function scoresTable(scores) {
  const cells = (row) => ["rmse", "mean", "median", "max"].map((name) => {
    const value = at(scores, row[1] + "." + name);
    return isNumber(value) ? number(row[2] * value) : "–";
  });
  return table(["", "RMSE", "mean", "median", "max", "unit"], scoreRows.map((row) => [row[0], ...cells(row), row[3]]));
}

/** Bars: the median, and paler up to 99 %. */
function stagesTable(stages) {
  const names = { extraction: "keypoints", mask_wait: "waiting for the mask", rejection: "rejecting dynamic keypoints", prediction: "matching to the last frame",
    local_map: "matching to the map", relocalisation: "relocalisation", keyframe: "keyframe", wait: "waiting for the map", total: "in all", total_cpu: "in all, CPU" };
  const shown = Object.entries(stages).filter(([, q]) => q && isNumber(q.p99) && q.p99 > 0);
  const largest = Math.max(...shown.map(([, q]) => q.p99), 1e-3);
  const bar = (q) => element("div", { class: "bar", role: "presentation" },
    element("b", { style: `width:${(100 * q.p99 / largest).toFixed(1)}%` }), element("i", { style: `width:${(100 * q.median / largest).toFixed(1)}%` }));
  return table(["of a frame's time, ms", "median", "95 %", "99 %", ""],
    shown.map(([name, q]) => [names[name] || name, number(q.median), number(q.p95), number(q.p99), bar(q)]));
}

function loopsTable(run) {
  if (!run.loops || !run.loops.length) return note("No loop was closed.");
  return table(["time", "what", "frame", "place of frame", "drift", "keyframes corrected", "landmarks fused", "to find", "to correct"],
    run.loops.map((loop) => [isNumber(loop.time) ? number(loop.time, "s") : "at the end", loop.merged ? "maps joined" : "loop",
      loop.frame, loop.matched_frame, loop.merged ? "–" : number(1e3 * loop.drift_m, "mm"), loop.keyframes, loop.fused,
      number(loop.detection_ms, "ms"), number(loop.correction_ms, "ms")]));
}

function shot(image) {
  const text = `frame ${image.frame}, ${image.time.toFixed(2)} s: ${image.text}`;
  return element("figure", {}, element("img", { src: image.uri, alt: "Image of " + text }), element("figcaption", {}, text));
}

function shots(run) {
  if (!run.images || !run.images.length) return null;
  return section("frames", "Sample frames",
    note("What moves, or may, is tinted: keypoints there are not used. Blue dots agree with the pose, orange ones do not."), element("div", { class: "shots" }, run.images.map((image) => shot(image))));
}

function command(text) {
  const button = element("button", { type: "button" }, "Copy");
  button.addEventListener("click", async () => {
    try {
      await navigator.clipboard.writeText(text);
      button.textContent = "Copied";
    } catch {
      getSelection().selectAllChildren(button.previousSibling);
      button.textContent = "Selected";
    }
  });
  return element("div", { class: "command" }, element("pre", {}, text), button);
}

function settingsTables(settings) {
  const row = (one) => [one.name, one.value, one.unit, one.usual === undefined ? "" : one.usual, one.description];
  const changed = settings.filter((one) => one.usual !== undefined);
  const head = ["setting", "value", "unit", "default", "meaning"];
  return [
    changed.length ? table(head, changed.map(row), false) : note("All settings have their defaults."),
    element("details", {}, element("summary", {}, `All ${settings.length} settings`), table(head, settings.map(row), false)),
  ];
}

function whatRan(run) {
  const s = run.summary, rows = (run.facts || []).map(([name, value]) => [name, value]);
  if (s.dense) rows.push(["dense map", `${s.dense.files}: ${s.dense.vertices} vertices, ${s.dense.triangles} triangles`]);
  const camera = s.camera;
  if (camera) {
    rows.push(["camera", `${camera.width} × ${camera.height}, fx ${number(camera.fx)}, fy ${number(camera.fy)}, ${camera.lens || "pinhole"}; ` +
      `${camera.depth_units_per_metre} depth units per metre`]);
  }
  return table(null, rows, false);
}
