// What all figures share: colours from the style sheet, axes, and drawing anew when the theme changes or the page is printed.

const figures = [];  // {place, make, wide, height}
let printing = false;

function colours() {
  const style = getComputedStyle(document.documentElement);
  const names = ["ink", "soft", "grid", "line", "paper", "estimate", "truth", "orange", "green", "violet", "yellow", "sky",
    "uncertain", "lost"];
  return Object.fromEntries(names.map((name) => [name, style.getPropertyValue("--" + name).trim()]));
}

/** Colours of runs side by side. */
function runColours(c) {
  return [c.estimate, c.orange, c.green, c.violet, c.yellow, c.sky, c.truth, c.ink];
}
/** And dashes, for those beyond, and for print in grey. */
const runDashes = ["solid", "dash", "dot", "dashdot"];

function runLine(c, index) {
  const list = runColours(c);
  return { color: list[index % list.length], dash: runDashes[Math.floor(index / list.length) % runDashes.length], width: 1.6 };
}

function axis(c, title, more) {
  return {
    title: { text: title, standoff: 6, font: { size: 12, color: c.soft } },
    gridcolor: c.grid, zerolinecolor: c.line, linecolor: c.line, tickfont: { size: 11, color: c.soft },
    automargin: true, exponentformat: "none", ...more,
  };
}

function layout(c, more) {
  return {
    font: { family: getComputedStyle(document.body).fontFamily, size: 12, color: c.ink },
    paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)",
    margin: { l: 54, r: 14, t: 12, b: 44 },
    legend: { orientation: "h", x: 0, y: 1.01, yanchor: "bottom", font: { size: 11.5 }, bgcolor: "rgba(0,0,0,0)" },
    hoverlabel: { bgcolor: c.paper, bordercolor: c.line, font: { color: c.ink, size: 12 } },
    hovermode: "closest",
    ...more,
  };
}

const plotOptions = {
  // Without a pointer that hovers the buttons would always lie over the figure.
  displayModeBar: matchMedia("(hover: none)").matches ? false : "hover",
  responsive: true, displaylogo: false, modeBarButtonsToRemove: ["lasso2d", "select2d", "autoScale2d"],
  toImageButtonOptions: { format: "svg" },
};

function drawFigure(figure) {
  const made = figure.make(colours());
  made.layout.autosize = !printing;
  // Where the paper's width is known and the page's is not: A4 with margins of 14 mm, at 96 px per inch.
  if (printing) made.layout.width = figure.wide ? 686 : 335;
  const height = printing && !figure.wide ? Math.min(figure.height, 340) : figure.height;
  figure.place.style.height = height + "px";
  made.layout.height = height;
  Plotly.react(figure.place, made.data, made.layout, plotOptions);
}

/** A figure: `make` gives data and layout from the colours. */
function figure(id, height, wide, caption, make) {
  const place = element("div", { class: "plot", id, style: `height:${height}px` });
  figures.push({ place, make, wide, height });
  return element("figure", wide ? { class: "wide" } : {}, place, caption ? element("figcaption", {}, caption) : null);
}

/** To be called when all figures are in the page. */
function drawFigures() {
  const draw = () => figures.forEach(drawFigure);
  draw();
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);
  const print = (start) => {
    printing = start;
    document.documentElement.classList.toggle("print", start);
    draw();
  };
  addEventListener("beforeprint", () => print(true));
  addEventListener("afterprint", () => print(false));
}
