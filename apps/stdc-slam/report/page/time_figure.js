// What happened when: rows above each other over the same time.

/** The rows of a run: those for which it has data. */
function timeRows(run, c) {
  const frames = run.frames;
  const time = frames.time;
  const line = (name, y, colour, template, more) => ({
    x: time, y, name, mode: "lines", line: { color: colour, width: 1.4 }, hovertemplate: template, ...more });
  const rows = [];
  if (frames.error_mm) {
    rows.push({ title: "error [mm]", weight: 1.1, traces: [line("error of position", frames.error_mm, c.estimate, "%{y:.1f} mm")] });
  }
  if (frames.inliers) rows.push({ title: "inliers", weight: 1, traces: [line("inliers", frames.inliers, c.green, "%{y}"), ...keyframeTraces(run, c)] });
  const shares = [];
  if (frames.people_percent) shares.push(line("people, by the network", frames.people_percent, c.violet, "%{y:.1f} %"));
  if (frames.moving_percent) shares.push(line("moving, by geometry", frames.moving_percent, c.yellow, "%{y:.1f} %"));
  if (shares.length) rows.push({ title: "dynamic [%]", weight: 0.8, traces: shares });
  if (!frames.total_ms) return rows;
  const times = [line("time per frame", frames.total_ms, c.estimate, "%{y:.1f} ms")];
  if (frames.mask_wait_ms) {
    times.push(line("of it waiting for the mask", frames.mask_wait_ms, c.orange, "%{y:.1f} ms", { line: { color: c.orange, width: 1, dash: "dot" } }));
  }
  if (frames.lag_ms) times.push(line("from image to pose", frames.lag_ms, c.violet, "%{y:.1f} ms"));
  rows.push({ title: "time [ms]", weight: 1, traces: times, limit: run.period_ms });
  return rows;
}

/** Ticks at the foot of the row. */
function keyframeTraces(run, c) {
  if (!run.keyframes || !run.keyframes.time.length) return [];
  const time = run.keyframes.time;
  return [{ x: time, y: time.map(() => 0), name: "keyframes", label: c.ink, mode: "markers", hovertemplate: "keyframe<extra></extra>",
    marker: { symbol: "line-ns", size: 9, line: { color: c.ink, width: 1.2 } } }];
}

function bandShapes(run, c) {
  return (run.bands || []).map((band) => ({
    type: "rect", layer: "below", x0: band.from, x1: band.to, yref: "paper", y0: 0, y1: 1,
    fillcolor: band.status === "uncertain" ? c.uncertain : c.lost, line: { width: 0 } }));
}

function loopShapes(run, c) {
  return (run.loops || []).filter((loop) => isNumber(loop.time)).map((loop) => ({
    type: "line", x0: loop.time, x1: loop.time, yref: "paper", y0: 0, y1: 1,
    line: { color: c.orange, width: 1.4, dash: "dot" } }));
}

function timeFigure(run) {
  return (c) => {
    const rows = timeRows(run, c);
    const gap = 0.035, weights = rows.reduce((sum, row) => sum + row.weight, 0);
    const unit = (1 - gap * (rows.length - 1)) / weights;
    const data = [], axes = {}, shapes = [...bandShapes(run, c), ...loopShapes(run, c)], annotations = [];
    let top = 1;
    rows.forEach((row, i) => {
      const name = i === 0 ? "" : String(i + 1);
      axes["yaxis" + name] = axis(c, row.title, { domain: [Math.max(0, top - unit * row.weight), top], rangemode: "tozero" });
      annotations.push({ xref: "paper", x: 0, xanchor: "left", xshift: 4, yref: "paper", y: top, yanchor: "top", showarrow: false,
        text: row.traces.map((trace) => `<span style="color:${trace.label || trace.line.color}">${trace.name}</span>`).join("   "),
        font: { size: 11 }, bgcolor: c.paper, opacity: 0.85, borderpad: 1 });
      top -= unit * row.weight + gap;
      for (const trace of row.traces) data.push({ ...trace, yaxis: "y" + name });
      if (isNumber(row.limit)) {
        shapes.push({ type: "line", xref: "paper", x0: 0, x1: 1, yref: "y" + name, y0: row.limit, y1: row.limit,
          line: { color: c.soft, width: 1, dash: "dash" } });
        annotations.push({ xref: "paper", x: 1, xanchor: "right", bgcolor: c.paper, opacity: 0.85, borderpad: 1, yref: "y" + name, y: row.limit, yanchor: "bottom", showarrow: false,
          text: `a frame comes every ${number(row.limit)} ms`, font: { size: 10.5, color: c.soft } });
      }
    });
    for (const loop of run.loops || []) {
      if (!isNumber(loop.time)) continue;
      annotations.push({ x: loop.time, yref: "paper", y: 1, yanchor: "bottom", showarrow: false,
        text: loop.merged ? "maps joined" : "loop", font: { size: 10.5, color: c.orange } });
    }
    axes.xaxis = axis(c, "time [s]", { anchor: rows.length > 1 ? "y" + rows.length : "y", hoverformat: ".2f", zeroline: false });
    return { data, layout: layout(c, { ...axes, shapes, annotations, hovermode: "x unified", hoversubplots: "axis", showlegend: false, margin: { l: 54, r: 14, t: 22, b: 44 } }) };
  };
}

/** The place in the plan follows the pointer over time. */
function linkFigures(run, timePlace, planPlace) {
  const known = run.trajectory.time.map((time, i) => [time, i]).filter(([time]) => isNumber(time));
  const here = planPlace.data.length - 1;
  const show = (x, y) => Plotly.restyle(planPlace, { x: [[x]], y: [[y]] }, [here]);
  timePlace.on("plotly_hover", (event) => {
    const goal = event.points[0].x;
    const nearest = known.reduce((best, one) => (Math.abs(one[0] - goal) < Math.abs(best[0] - goal) ? one : best), known[0]);
    if (nearest) show(run.trajectory.x[nearest[1]], run.trajectory.y[nearest[1]]);
  });
  timePlace.on("plotly_unhover", () => show(null, null));
}
