// Calls back for a click or tap that was no drag, with how far [pixels] something may be from it to be meant.
export function onClick(canvas: HTMLCanvasElement, callback: (x: number, y: number, reach: number) => void) {
  let down: { x: number; y: number } | null = null;
  canvas.addEventListener("pointerdown", (event) => { down = { x: event.offsetX, y: event.offsetY }; });
  canvas.addEventListener("pointerup", (event) => {
    const still = down && Math.hypot(event.offsetX - down.x, event.offsetY - down.y) < 6;
    if (still) callback(event.offsetX, event.offsetY, event.pointerType === "touch" ? 28 : 14);
  });
}
