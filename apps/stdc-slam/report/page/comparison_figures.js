// The figures of several runs over each other.

/** What is to be added to the times of a run: runs on the same recording share its clock, others each start at 0. */
function timeShift(runs) {
  const spans = runs.filter((run) => isNumber(run.first_time)).map((run) => [run.first_time, run.first_time + (run.duration_s || 0)]);
  const overlap = spans.every((a) => spans.every((b) => a[0] <= b[1] && b[0] <= a[1]));
  const first = Math.min(...spans.map((span) => span[0]));
  return (run) => (overlap ? run.first_time - first : 0);
}

/** Whether positions can be drawn over each other: they are in the frame of the same ground truth. */
function sharesWorld(runs) {
  return runs.every((run) => run.trajectory && run.truth && run.axes.x === runs[0].axes.x && run.axes.y === runs[0].axes.y &&
    run.axes.z === runs[0].axes.z && run.name === runs[0].name);
}

function overlayFigure(runs, title, values, template, more) {
  return (c) => {
    const shift = timeShift(runs);
    const data = runs.map((run, i) => ({ run, y: values(run), line: runLine(c, i) })).filter((one) => one.y)
      .map(({ run, y, line }) => ({ x: run.frames.time.map((time) => time + shift(run)), y, name: plotText(run.label), mode: "lines", line,
        hovertemplate: template }));
    return { data, layout: layout(c, { hovermode: "x unified", xaxis: axis(c, "time [s]", { hoverformat: ".2f", zeroline: false }),
      yaxis: axis(c, title, { rangemode: "tozero", ...more }) }) };
  };
}

function overlayPlan(runs) {
  return (c) => {
    const data = [{ x: runs[0].truth.x, y: runs[0].truth.y, name: "ground truth", mode: "lines", hoverinfo: "skip", line: { color: c.truth, width: 5 }, opacity: 0.6 }];
    runs.forEach((run, i) => data.push({ x: run.trajectory.x, y: run.trajectory.y, name: plotText(run.label), mode: "lines", line: runLine(c, i),
      hovertemplate: "%{x:.3f}, %{y:.3f} m" }));
    return { data, layout: layout(c, {
      xaxis: axis(c, runs[0].axes.x + " [m]", {}),
      yaxis: axis(c, runs[0].axes.y + " [m]", { scaleanchor: "x", scaleratio: 1 }) }) };
  };
}

function overlayHeight(runs) {
  return (c) => {
    const shift = timeShift(runs);
    const data = [{ x: runs[0].truth.time.map((time) => (time === null ? null : time + shift(runs[0]))), y: runs[0].truth.z, name: "ground truth", mode: "lines",
      hoverinfo: "skip", line: { color: c.truth, width: 4 }, opacity: 0.6 }];
    runs.forEach((run, i) => data.push({ x: run.trajectory.time.map((time) => (time === null ? null : time + shift(run))), y: run.trajectory.z,
      name: plotText(run.label), mode: "lines", line: runLine(c, i), hovertemplate: "%{y:.3f} m" }));
    return { data, layout: layout(c, { hovermode: "x unified", xaxis: axis(c, "time [s]", { hoverformat: ".2f" }), yaxis: axis(c, runs[0].axes.z + " [m]", {}) }) };
  };
}

/** Share of the frames that stay below a value. */
function shareFigure(runs, name, title, limit) {
  return (c) => {
    const data = runs.map((run, i) => ({ q: at(run, "quantiles." + name), i, run })).filter((one) => one.q)
      .map(({ q, i, run }) => ({ x: q, y: q.map((_, k) => (100 * k) / (q.length - 1)), name: plotText(run.label), mode: "lines", line: runLine(c, i),
        hovertemplate: "%{y:.0f} % below %{x:.1f}" }));
    const largest = Math.max(...data.map((trace) => trace.x[trace.x.length - 1]), 1e-9);
    // One bad frame must not hide the rest.
    const shown = Math.max(...data.map((trace) => trace.x[trace.x.length - 2]));
    const shapes = isNumber(limit) && limit < 1.1 * shown
      ? [{ type: "line", x0: limit, x1: limit, yref: "paper", y0: 0, y1: 1, line: { color: c.soft, dash: "dash", width: 1 } }] : [];
    return { data, layout: layout(c, { shapes, xaxis: axis(c, title, { range: [0, Math.min(largest, 1.15 * shown) || 1] }),
      yaxis: axis(c, "frames below, %", { range: [0, 101] }) }) };
  };
}
