import { Chart, ChartData } from "./chart";
import { currentTheme, okabe } from "./colours";
import { Model } from "./model";
import { Status } from "./protocol";

interface Curve { chart: Chart; data(first: number): ChartData; value: HTMLElement; say(index: number): string }

const percent = (share: number) => `${(100 * share).toFixed(share > 0.995 && share < 1 ? 2 : 0)} %`;

function statusColour(status: Status): string | null {
  switch (status) {
    case Status.uncertain: return okabe.orange;
    case Status.lost: return okabe.vermillion;
    case Status.skipped: return "#888888";
    case Status.initialising: return "#bbbbbb";
    default: return null;
  }
}

// The curves under the map: of the last frames or of the whole run; over one of them the values of a frame are shown.
export class Curves {
  private hover: number | null = null;
  private wholeRun = false;
  private readonly curves: Curve[];

  constructor(private readonly model: Model, private readonly onChange: () => void) {
    const frameAt = (index: number) => model.frames[index]!;
    const curve = (...parts: Parameters<Curves["curve"]>) => this.curve(...parts);
    this.curves = [
      curve("time", () => ({
        series: [{ colour: currentTheme().path, value: (i) => frameAt(i).ms }],
        limit: { value: model.period, label: `camera ${model.period.toFixed(0)} ms` },
        marks: (i) => (frameAt(i).ms > model.period ? okabe.vermillion : null),
        format: (v) => `${v.toFixed(0)} ms`,
      }), (i) => `${frameAt(i).ms.toFixed(1)} ms`),
      curve("inliers", () => ({
        series: [{ colour: currentTheme().keyframe, value: (i) => frameAt(i).inliers }],
        format: (v) => v.toFixed(0),
      }), (i) => `${frameAt(i).inliers}`),
      curve("dynamic", () => ({
        series: [
          { colour: okabe.purple, value: (i) => frameAt(i).network },
          { colour: okabe.orange, dashed: true, value: (i) => frameAt(i).motion },
        ],
        max: Math.max(0.25, ...model.frames.slice(-2000).map((f) => Math.max(f.network, f.motion))),
        format: percent,
      }), (i) => `network ${percent(frameAt(i).network)}, motion ${percent(frameAt(i).motion)}`),
      curve("coverage", () => ({
        series: [{ colour: currentTheme().ink, value: (i) => model.coverage[i]! }],
        max: 1, min: 0,
        marks: (i) => statusColour(frameAt(i).status),
        format: percent,
      }), (i) => percent(model.coverage[i]!)),
    ];
  }

  private curve(id: string, make: (first: number) => Omit<ChartData, "count" | "first" | "place">, say: (index: number) => string): Curve {
    return {
      chart: new Chart(document.getElementById(`chart-${id}`) as HTMLCanvasElement, (index) => {
        this.hover = index;
        this.onChange();
      }),
      data: (first) => ({ ...make(first), count: this.model.frames.length, first, place: (i) => this.model.starts[i]! }),
      value: document.getElementById(`value-${id}`)!,
      say,
    };
  }

  // Whether the whole run is shown from now on.
  toggleRange(): boolean {
    this.wholeRun = !this.wholeRun;
    this.onChange();
    return this.wholeRun;
  }

  draw() {
    if (document.getElementById("chart-time")!.clientWidth === 0) return;
    const count = this.model.frames.length, theme = currentTheme();
    const first = this.wholeRun ? 0 : Math.max(0, count - 600);
    const shown = this.hover !== null && this.hover < count ? this.hover : null;
    for (const one of this.curves) {
      one.chart.setHover(this.hover);
      one.chart.draw(one.data(first), theme);
      const index = shown ?? count - 1;
      one.value.textContent = index >= 0 ? one.say(index) : "";
    }
    document.getElementById("hovered")!.textContent = shown !== null ? `frame ${this.model.frames[shown]!.frame}` : "";
  }
}
