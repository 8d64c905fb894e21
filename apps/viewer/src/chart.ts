import { Theme } from "./colours";

export interface Series { colour: string; dashed?: boolean; value(index: number): number }
export interface Limit { value: number; label: string }
export interface ChartData {
  count: number;
  first: number;                          // of the records that are drawn
  place(index: number): number;           // of a record along the run, in frames
  series: Series[];
  limit?: Limit;
  min?: number;
  max?: number;
  marks?(index: number): string | null;   // colour of a tick at the lower edge
  format(value: number): string;
}

// A curve over the frames, of as many as there are pixels for: of more it draws the range of each column.
export class Chart {
  private data: ChartData | null = null;
  private hover: number | null = null;

  constructor(private readonly canvas: HTMLCanvasElement, private readonly onHover: (index: number | null) => void) {
    const track = (event: PointerEvent) => {
      const data = this.data;
      if (!data || data.count <= data.first) return;
      const share = event.offsetX / Math.max(1, canvas.clientWidth);
      const begin = data.place(data.first), place = begin + share * (data.place(data.count - 1) - begin);
      let low = data.first, high = data.count - 1;  // the last one that is not beyond the place
      while (low < high) {
        const middle = (low + high + 1) >> 1;
        if (data.place(middle) <= place + 0.5) low = middle;
        else high = middle - 1;
      }
      this.onHover(low);
    };
    canvas.addEventListener("pointermove", track);
    canvas.addEventListener("pointerdown", track);
    canvas.addEventListener("pointerleave", () => this.onHover(null));
  }

  setHover(index: number | null) { this.hover = index; }

  private topOf(data: ChartData): number {
    if (data.max !== undefined) return data.max;
    // What nearly all lie below: one slow frame must not flatten the rest.
    const values: number[] = [];
    for (const one of data.series) for (let i = data.first; i < data.count; ++i) values.push(one.value(i));
    values.sort((a, b) => a - b);
    const few = values.length < 30;
    const usual = values[few ? values.length - 1 : Math.floor(0.995 * (values.length - 1))] ?? 1;
    return Math.max(usual * 1.15, (data.limit?.value ?? 0) * 1.15, 1e-6);
  }

  draw(data: ChartData, theme: Theme) {
    this.data = data;
    const canvas = this.canvas, scale = Math.min(2, window.devicePixelRatio || 1);
    const width = Math.round(canvas.clientWidth * scale), height = Math.round(canvas.clientHeight * scale);
    if (width === 0 || height === 0) return;
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    const pen = canvas.getContext("2d")!, low = data.min ?? 0, high = this.topOf(data);
    pen.clearRect(0, 0, width, height);
    const begin = data.count > data.first ? data.place(data.first) : 0;
    const span = data.count > data.first ? Math.max(1, data.place(data.count - 1) - begin) : 1;
    const x = (index: number) => ((data.place(index) - begin) / span) * (width - 2) + 1;
    const y = (value: number) => height - 2 - ((Math.min(value, high) - low) / (high - low)) * (height - 6);
    pen.strokeStyle = theme.grid;
    pen.lineWidth = 1;
    for (const share of [0, 0.5, 1]) {
      const at = Math.round(y(low + share * (high - low))) + 0.5;
      pen.beginPath();
      pen.moveTo(0, at);
      pen.lineTo(width, at);
      pen.stroke();
    }
    if (data.marks) this.drawMarks(pen, data, x, height, scale);
    for (const one of data.series) this.drawSeries(pen, data, one, x, y, width, scale);
    if (data.limit) this.drawLimit(pen, data.limit, y(data.limit.value), width, scale, theme);
    pen.textBaseline = "top";
    pen.textAlign = "left";
    this.write(pen, data.format(high), 2 * scale, 2 * scale, scale, theme);
    if (this.hover !== null && this.hover >= data.first && this.hover < data.count) {
      pen.strokeStyle = theme.ink;
      pen.globalAlpha = 0.6;
      pen.beginPath();
      pen.moveTo(x(this.hover), 0);
      pen.lineTo(x(this.hover), height);
      pen.stroke();
      pen.globalAlpha = 1;
    }
  }

  private drawLimit(pen: CanvasRenderingContext2D, limit: Limit, at: number, width: number, scale: number, theme: Theme) {
    pen.strokeStyle = theme.faint;
    pen.setLineDash([4 * scale, 4 * scale]);
    pen.beginPath();
    pen.moveTo(0, at);
    pen.lineTo(width, at);
    pen.stroke();
    pen.setLineDash([]);
    pen.textAlign = "right";
    pen.textBaseline = at > 16 * scale ? "bottom" : "top";
    this.write(pen, limit.label, width - 2 * scale, at > 16 * scale ? at - 2 * scale : at + 2 * scale, scale, theme);
  }

  // Words on a ground of their own, so that a curve does not run through them.
  private write(pen: CanvasRenderingContext2D, words: string, x: number, y: number, scale: number, theme: Theme) {
    pen.font = `${10 * scale}px system-ui, sans-serif`;
    pen.lineWidth = 4 * scale;
    pen.lineJoin = "round";
    pen.strokeStyle = theme.panel;
    pen.strokeText(words, x, y);
    pen.fillStyle = theme.faint;
    pen.fillText(words, x, y);
  }

  private drawMarks(pen: CanvasRenderingContext2D, data: ChartData, x: (i: number) => number, height: number, scale: number) {
    for (let i = data.first; i < data.count; ++i) {
      const colour = data.marks!(i);
      if (!colour) continue;
      const wide = Math.max(scale, x(Math.min(i + 1, data.count - 1)) - x(i));
      pen.fillStyle = colour;
      pen.fillRect(x(i) - wide / 2, height - 5 * scale, wide + 0.5, 5 * scale);
    }
  }

  private drawSeries(pen: CanvasRenderingContext2D, data: ChartData, series: Series, x: (i: number) => number,
                     y: (v: number) => number, width: number, scale: number) {
    pen.strokeStyle = series.colour;
    pen.lineWidth = 1.6 * scale;
    pen.lineJoin = "round";
    pen.setLineDash(series.dashed ? [5 * scale, 3 * scale] : []);
    pen.beginPath();
    const perColumn = Math.max(1, Math.ceil((data.count - data.first) / width));
    for (let i = data.first; i < data.count; i += perColumn) {
      let least = Infinity, most = -Infinity;
      for (let k = i; k < Math.min(i + perColumn, data.count); ++k) {
        const value = series.value(k);
        least = Math.min(least, value);
        most = Math.max(most, value);
      }
      if (i === data.first) pen.moveTo(x(i), y(most));
      else pen.lineTo(x(i), y(most));
      if (least < most) pen.lineTo(x(i), y(least));
    }
    pen.stroke();
    pen.setLineDash([]);
  }
}
