// report_check.mjs CHROMIUM FOLDER PAGE...: opens pages of stdc-slam as people do, and says what is wrong with them.
// Screenshots (light, dark, phone) and a PDF of each are left in FOLDER.
import { basename } from "node:path";
import { statSync } from "node:fs";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const [executablePath, folder, ...pages] = process.argv.slice(2);
const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
const problems = [];

async function open(file, options) {
  const page = await (await browser.newContext(options)).newPage();
  const say = (text) => problems.push(`${file}: ${text}`);
  page.on("console", (message) => { if (message.type() === "error" || message.type() === "warning") say(message.text()); });
  page.on("pageerror", (error) => say(String(error)));
  page.on("dialog", (dialog) => { say("a dialog opened"); dialog.dismiss(); });
  page.on("request", (request) => { if (!/^(file|data|blob):/.test(request.url())) say(`asked for ${request.url()}`); });
  await page.goto(pathToFileURL(file).href);
  await page.waitForSelector("footer", { timeout: 20000 });
  await page.waitForTimeout(300);
  return [page, say];
}

async function checkFigures(page, say) {
  const figures = await page.evaluate(() => [...document.querySelectorAll(".plot")].map((plot) => ({
    id: plot.id, drawn: plot.querySelectorAll("svg.main-svg").length > 0, points: (plot.data || []).reduce((sum, trace) => sum + (trace.x || []).length, 0),
    width: plot.getBoundingClientRect().width })));
  if (!figures.length) say("has no figure");
  for (const one of figures) if (!one.drawn || !one.points || one.width < 200) say(`figure ${one.id} is not drawn`);
  const broken = await page.evaluate(() => [...document.images].filter((image) => !image.naturalWidth).length);
  if (broken) say(`${broken} pictures are broken`);
  const words = await page.evaluate(() => document.body.innerText);
  for (const odd of ["undefined", "NaN", "[object", "null"]) if (words.includes(odd)) say(`shows "${odd}"`);
}

async function checkEqualAxes(page, say) {
  const ratio = await page.evaluate(() => {
    const full = document.getElementById("plan")?._fullLayout;
    if (!full) return 1;
    const scale = (axis) => axis._length / Math.abs(axis.range[1] - axis.range[0]);
    return scale(full.xaxis) / scale(full.yaxis);
  });
  if (Math.abs(ratio - 1) > 0.01) say(`the plan is drawn ${ratio} times wider than high`);
}

/** The circle in the plan must follow the pointer over time. */
async function checkLink(page, say) {
  const time = page.locator("#over-time .nsewdrag").first();
  if (!(await time.count()) || !(await page.locator("#plan").count())) return;
  await time.scrollIntoViewIfNeeded();
  const box = await time.boundingBox();
  // The page forbids eval, which waitForFunction needs.
  for (let step = 0; step < 20; ++step) {
    await page.mouse.move(box.x + box.width * (0.4 + 0.01 * step), box.y + box.height / 2);
    await page.waitForTimeout(100);
    const x = await page.evaluate(() => document.getElementById("plan").data.at(-1).x[0]);
    if (typeof x === "number") return;
  }
  say("the plan does not follow the pointer");
}

for (const file of pages) {
  const name = `${folder}/${basename(file, ".html")}`;
  const [light, say] = await open(file, { viewport: { width: 1200, height: 900 }, colorScheme: "light" });
  await checkFigures(light, say);
  await checkEqualAxes(light, say);
  await light.screenshot({ path: `${name}-light.png`, fullPage: true });
  await checkLink(light, say);
  await light.pdf({ path: `${name}.pdf`, preferCSSPageSize: true, printBackground: true });
  if (statSync(`${name}.pdf`).size < 20000) say("nothing is on paper");
  const [dark, sayDark] = await open(file, { viewport: { width: 1200, height: 900 }, colorScheme: "dark" });
  const shade = await dark.evaluate(() => getComputedStyle(document.body).backgroundColor.match(/\d+/g).map(Number));
  if (Math.max(...shade) > 60) sayDark("is not dark where that is asked for");
  await dark.screenshot({ path: `${name}-dark.png`, fullPage: true });
  const [phone, sayPhone] = await open(file, { viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true });
  const width = await phone.evaluate(() => document.documentElement.scrollWidth);
  if (width > 390) sayPhone(`is ${width} pixels wide on a phone of 390`);
  await phone.screenshot({ path: `${name}-phone.png`, fullPage: true });
}
await browser.close();
for (const problem of problems) console.error(problem);
console.log(`${pages.length} pages, ${problems.length} problems; screenshots are in ${folder}`);
process.exit(problems.length ? 1 : 0);
