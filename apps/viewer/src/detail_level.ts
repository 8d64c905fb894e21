export const thinLinesFrom = 2;  // level from which on lines are one pixel wide

// Of the pixels along a side, at a level.
export function shareOfPixels(level: number): number { return [1, 1, 0.7, 0.5][level] ?? 0.5; }

// How much is drawn while the picture changes: 0 is all of it. Where pictures come too slowly there is less in them, down
// to the coarsest level.
export class DetailLevel {
  value: number;
  private intervals: number[] = [];

  constructor(private readonly software: boolean) { this.value = software ? 2 : 0; }

  // A picture came so many milliseconds after the one before.
  adapt(interval: number) {
    this.intervals.push(interval);
    if (this.intervals.length < 6) return;
    const mean = this.intervals.reduce((a, b) => a + b, 0) / this.intervals.length;
    this.intervals = [];
    if (mean > 36) this.value = Math.min(3, this.value + 1);
    if (mean < 20 && !this.software) this.value = Math.max(0, this.value - 1);
  }
}
