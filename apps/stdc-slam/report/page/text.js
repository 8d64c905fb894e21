// Words, numbers and elements. Whatever comes from the data enters the page as text, never as HTML.

/** An element with attributes and children: strings become text, null is left out. */
function element(tag, attributes, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes || {})) made.setAttribute(name, value);
  for (const child of children.flat()) {
    if (child === null || child === undefined) continue;
    made.append(child instanceof Node ? child : String(child));
  }
  return made;
}

/** Text for Plotly, which takes some of it for HTML. */
function plotText(text) {
  return String(text).replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;");
}

const isNumber = (value) => typeof value === "number" && Number.isFinite(value);

/** With three significant digits at least, never in powers of ten. */
function number(value, unit) {
  if (!isNumber(value)) return "–";
  const size = Math.abs(value);
  const digits = size >= 100 || Number.isInteger(value) ? 0 : size >= 10 ? 1 : size >= 1 ? 2 : 3;
  return value.toFixed(digits) + (unit ? " " + unit : "");
}

function percent(share, digits = 1) {
  if (!isNumber(share)) return "–";
  const text = (100 * share).toFixed(digits);
  // 99.96 % is not all.
  return (share < 1 && Number(text) === 100 ? "99.9" : text.replace(/\.0+$/, "")) + " %";
}

/** Of nested objects, or undefined: at(summary, "scores.ate_m.rmse"). */
function at(object, path) {
  return path.split(".").reduce((value, key) => (value === null || value === undefined ? undefined : value[key]), object);
}

/** A table of rows of cells; a cell is text, a node, or {text, best, number}. */
function table(head, rows, numbers = true) {
  const cell = (tag, content, index) => {
    const plain = content === null || typeof content !== "object" || content instanceof Node;
    const text = plain ? content : content.text;
    const classes = [numbers && index > 0 && !(text instanceof Node) ? "number" : "", !plain && content.best ? "best" : ""];
    const kind = classes.join(" ").trim();
    return element(tag, kind ? { class: kind } : {}, text);
  };
  return element("div", { class: "scroll" },
    element("table", {},
      head ? element("thead", {}, element("tr", {}, head.map((text, i) => cell("th", text, i)))) : null,
      element("tbody", {}, rows.map((row) => element("tr", {}, row.map((content, i) => cell("td", content, i)))))));
}

function section(id, title, ...content) {
  return element("section", { id }, element("h2", {}, title), ...content);
}

function note(text) {
  return element("p", { class: "note" }, text);
}
