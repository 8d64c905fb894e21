// The figures of one run. All times count from its first frame.

function hasErrors(run) {
  return Boolean(run.trajectory && run.trajectory.error_mm);
}

/** The path in plan with equal axes; coloured by its error where that is known. */
function planFigure(run) {
  return (c) => {
    const { trajectory, truth, keyframes, landmarks } = run;
    const data = [];
    if (landmarks) {
      data.push({ x: landmarks.x, y: landmarks.y, name: "landmarks", mode: "markers", hoverinfo: "skip",
        marker: { size: 2.2, color: c.truth, opacity: 0.45 }, visible: true });
    }
    if (truth) {
      data.push({ x: truth.x, y: truth.y, name: "ground truth", mode: "lines", hoverinfo: "skip", connectgaps: false,
        line: { color: c.truth, width: 5 }, opacity: 0.7 });
    }
    data.push({ x: trajectory.x, y: trajectory.y, name: "estimate", mode: "lines", hoverinfo: "skip",
      line: { color: c.estimate, width: 1.6 } });
    const time = trajectory.time;
    if (hasErrors(run)) {
      data.push({ x: trajectory.x, y: trajectory.y, name: "error", mode: "markers", showlegend: false,
        customdata: time.map((t, i) => [t, trajectory.error_mm[i]]),
        hovertemplate: "%{customdata[0]:.2f} s, error %{customdata[1]:.1f} mm<br>%{x:.3f}, %{y:.3f} m<extra></extra>",
        marker: { size: 5, color: trajectory.error_mm, colorscale: "Viridis", cmin: 0, showscale: true,
          colorbar: { title: { text: "error, mm", side: "right", font: { size: 11 } }, thickness: 10, outlinewidth: 0,
            tickfont: { size: 10, color: c.soft }, x: 1.01, len: 0.9 } } });
    } else {
      data.push({ x: trajectory.x, y: trajectory.y, name: "poses", mode: "markers", showlegend: false, customdata: time,
        hovertemplate: "%{customdata:.2f} s<br>%{x:.3f}, %{y:.3f} m<extra></extra>", marker: { size: 3, color: c.estimate } });
    }
    if (keyframes && keyframes.x.length) {
      data.push({ x: keyframes.x, y: keyframes.y, name: `keyframes (${keyframes.x.length})`, mode: "markers",
        customdata: keyframes.time, hovertemplate: "keyframe, %{customdata:.2f} s<extra></extra>",
        marker: { size: 7, symbol: "square-open", color: c.ink, line: { width: 1.2 } } });
    }
    data.push(...loopTraces(run, c));
    const first = trajectory.x.findIndex(isNumber);
    if (first >= 0) {
      data.push({ x: [trajectory.x[first]], y: [trajectory.y[first]], name: "start", mode: "markers", hoverinfo: "name",
        marker: { size: 12, symbol: "triangle-up", color: c.green, line: { width: 1, color: c.paper } } });
    }
    data.push({ x: [null], y: [null], name: "here", mode: "markers", showlegend: false, hoverinfo: "skip",
      marker: { size: 15, symbol: "circle-open", color: c.orange, line: { width: 3 } } });
    return { data, layout: layout(c, {
      xaxis: axis(c, run.axes.x + " [m]", { range: planRange(run, "x") }),
      yaxis: axis(c, run.axes.y + " [m]", { range: planRange(run, "y"), scaleanchor: "x", scaleratio: 1 }),
    }) };
  };
}

/** What the camera did is to fill the figure; landmarks may lie outside. */
function planRange(run, name) {
  const values = [run.trajectory, run.truth].filter(Boolean).flatMap((path) => path[name]).filter(isNumber);
  if (!values.length) return undefined;
  const low = values.reduce((a, b) => Math.min(a, b)), high = values.reduce((a, b) => Math.max(a, b));
  const margin = Math.max(0.12 * (high - low), 0.02);
  return [low - margin, high + margin];
}

/** A line from each place that was recognised to the place where that was noticed. */
function loopTraces(run, c) {
  const placed = (run.loops || []).filter((loop) => loop.from && loop.to);
  if (!placed.length) return [];
  const x = placed.flatMap((loop) => [loop.from[0], loop.to[0], null]);
  const y = placed.flatMap((loop) => [loop.from[1], loop.to[1], null]);
  return [{ x, y, name: `loops (${placed.length})`, mode: "lines+markers", hoverinfo: "name",
    line: { color: c.orange, width: 1.6, dash: "dot" }, marker: { size: 6, color: c.orange, symbol: "x" } }];
}

function heightFigure(run) {
  return (c) => {
    const { trajectory, truth } = run;
    const data = [];
    const line = { mode: "lines", hovertemplate: "%{y:.3f} m" };
    if (truth) data.push({ ...line, x: truth.time, y: truth.z, name: "ground truth", line: { color: c.truth, width: 4 }, opacity: 0.7 });
    data.push({ ...line, x: trajectory.time, y: trajectory.z, name: "estimate", line: { color: c.estimate, width: 1.6 } });
    return { data, layout: layout(c, {
      hovermode: "x unified",
      xaxis: axis(c, "time [s]", { hoverformat: ".2f" }),
      yaxis: axis(c, run.axes.z + " [m]", {}),
    }) };
  };
}

/** How often which value came: counts of all frames, made by the program. */
function histogramFigure(histogram, title, colour, mark) {
  return (c) => {
    const { start, step, counts } = histogram;
    const x = counts.map((_, i) => start + (i + 0.5) * step);
    const last = counts.length - 1;
    const ranges = counts.map((_, i) => `${number(start + i * step)} to ${number(start + (i + 1) * step)}${i === last && histogram.more ? " and more" : ""}`);
    const shapes = mark && mark.at < start + step * counts.length
      ? [{ type: "line", x0: mark.at, x1: mark.at, yref: "paper", y0: 0, y1: 1, line: { color: c.orange, dash: "dash", width: 1.5 } }] : [];
    const annotations = shapes.length
      ? [{ x: mark.at, yref: "paper", y: 1, text: mark.text, showarrow: false, xanchor: "left", xshift: 4, font: { size: 11, color: c.orange } }] : [];
    return {
      data: [{ type: "bar", x, y: counts, width: step, customdata: ranges, marker: { color: c[colour], line: { color: c.paper, width: 0.5 } },
        hovertemplate: "%{customdata}: %{y} frames<extra></extra>" }],
      layout: layout(c, { bargap: 0, shapes, annotations, xaxis: axis(c, title, {}), yaxis: axis(c, "frames", { rangemode: "tozero" }) }),
    };
  };
}
