// Puts the page together from the data.

function verdict(run) {
  const s = run.summary, words = [];
  const total = at(s, "frames.total");
  if (isNumber(total)) {
    const all = s.coverage === 1;
    words.push(all ? `All ${total} frames have a pose` : `${percent(s.coverage)} of ${total} frames have a pose`);
  }
  const rmse = at(s, "scores.ate_m.rmse");
  if (isNumber(rmse)) words.push(`${number(1e3 * rmse)} mm from the ground truth (RMSE over ${at(s, "scores.pairs")} poses)`);
  else if (s.not_scored) words.push(`not scored: ${s.not_scored}`);
  else if (isNumber(total)) words.push("there is no ground truth to compare with");
  const median = at(s, "stage_milliseconds.total.median");
  if (isNumber(median)) words.push(`${number(median)} ms a frame`);
  return words.join("; ") + ".";
}

function everyNote(run) {
  return run.every > 1 ? ` Each point stands for ${run.every} frames: their largest error, share and time, their fewest inliers.` : "";
}

function bandsNote(run) {
  return run.bands && run.bands.length ? " Shaded: uncertain (yellow) and lost (red)." : "";
}

function trajectorySection(run) {
  const parts = [];
  if (!run.trajectory && !run.settings) return null;
  if (!run.trajectory || !run.trajectory.time.length) return section("trajectory", "Trajectory", note("No frame has a pose."));
  const world = `Axes: ${run.axes.world}.`;
  parts.push(figure("plan", 460, false, `From above, both axes to the same scale. ${world}`, planFigure(run)));
  parts.push(figure("height", 460, false, "Height over time.", heightFigure(run)));
  return section("trajectory", "Trajectory", element("div", { class: "plots" }, parts));
}

function timeSection(run) {
  if (!run.frames || !run.frames.time.length) return null;
  const f = run.frames;
  const rows = [f.inliers, f.error_mm, f.people_percent || f.moving_percent, f.total_ms].filter(Boolean).length;
  return section("time", "Over time",
    figure("over-time", 110 + 135 * rows, true, "The place in the plan above follows the pointer." + bandsNote(run) + everyNote(run), timeFigure(run)));
}

function distributionSection(run) {
  const parts = [], h = run.histograms || {};
  if (h.error_mm) parts.push(figure("error-histogram", 260, false, "How far from the ground truth.", histogramFigure(h.error_mm, "error [mm]", "estimate")));
  if (h.total_ms) {
    const mark = isNumber(run.period_ms) ? { at: run.period_ms, text: "camera" } : null;
    parts.push(figure("time-histogram", 260, false, "How long a frame took.", histogramFigure(h.total_ms, "time per frame [ms]", "green", mark)));
  }
  return parts.length ? section("distribution", "Distribution", element("div", { class: "plots" }, parts)) : null;
}

function scaleNote(scores) {
  const scale = scores.scale;
  if (!scale) return ""; // a run of an older version
  const off = 100 * (1 / scale.factor - 1);
  return ` The estimate is ${Math.abs(off).toFixed(2)} % too ${off < 0 ? "small" : "large"}; with the best scale the ATE is ${(1e3 * scale.ate_rmse_m).toFixed(1)} mm.`;
}

function onePage(run) {
  const s = run.summary, parts = [element("p", { class: "verdict" }, verdict(run)), tiles(run), warningsBox(run.warnings)];
  parts.push(trajectorySection(run), timeSection(run));
  if (s.scores) parts.push(section("scores", "Scores", scoresTable(s.scores),
    note(`After rigid alignment; pairs and numbers are those of evo and of the TUM tools. ${at(s, "scores.off_by_5_cm")} of ${at(s, "scores.pairs")} poses are off by more than 5 cm.${scaleNote(s.scores)}`)));
  parts.push(distributionSection(run));
  if (s.stage_milliseconds) parts.push(section("stages", "Where the time went", stagesTable(s.stage_milliseconds)));
  if (run.loops) parts.push(section("loops", "Loops", loopsTable(run)));
  parts.push(shots(run));
  if (run.facts) parts.push(section("run", "What ran", whatRan(run)));
  if (run.settings) parts.push(section("settings", "Settings", ...settingsTables(run.settings)));
  return parts;
}

function commandsSection(commands) {
  return commands && commands.length ? section("repeat", "To repeat it", commands.map(command)) : null;
}

function manyPage(document_) {
  const parts = (document_.tables || []).map((one) => section("table-" + one.id, one.title, table(one.head, one.rows), one.note ? note(one.note) : null));
  document_.groups.forEach((group, i) => {
    const id = "group-" + i;
    parts.push(section(id, group.title, comparedWarnings(group.runs), ...comparison(group, id + "-").filter(Boolean).flat()));
  });
  const first = document_.groups[0];
  if (document_.groups.length === 1) {
    const settings = differingSettings(first.runs);
    if (settings) parts.push(section("settings", "Settings that differ", settings));
  }
  return parts;
}

function navigation(main) {
  const links = [...main.querySelectorAll("section")].map((one) =>
    element("a", { href: "#" + one.id }, one.querySelector("h2").textContent.split(". ")[0]));
  return links.length > 2 ? element("nav", { "aria-label": "Sections" }, links) : null;
}

function start() {
  const data = JSON.parse(document.getElementById("report-data").textContent);
  const main = document.getElementById("page");
  const single = data.groups.length === 1 && data.groups[0].runs.length === 1;
  const machine = data.machine ? `, on ${data.machine}` : "";
  const head = element("header", {}, element("h1", {}, data.title), element("div", { class: "soft" }, `${data.subtitle}; stdc-slam ${data.version}${machine}`));
  const parts = single ? onePage(data.groups[0].runs[0]) : manyPage(data);
  const commands = [...(single ? [] : data.groups.flatMap((group) => group.runs.map((run) => run.command))), ...(data.commands || [])].filter(Boolean);
  main.replaceChildren(head, ...[...parts, commandsSection(commands)].filter(Boolean),
    element("footer", {}, "Written by stdc-slam. The page is complete in itself: it loads nothing. Plots by plotly.js (MIT licence)."));
  const links = navigation(main);
  if (links) head.append(links);
  drawFigures();
  const plan = document.getElementById("plan"), time = document.getElementById("over-time");
  if (single && plan && time) linkFigures(data.groups[0].runs[0], time, plan);
}

start();
