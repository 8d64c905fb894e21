import { cividis, okabe } from "./colours";
import { CameraImage, Point } from "./protocol";

export interface PictureOptions { depth: boolean; points: boolean; masks: boolean }

// Hatching in the direction of `slope`, so that the two causes differ without their colours.
function hatching(context: CanvasRenderingContext2D, colour: string, slope: 1 | -1): CanvasPattern | string {
  const side = 10, tile = document.createElement("canvas");
  tile.width = tile.height = side;
  const pen = tile.getContext("2d")!;
  pen.fillStyle = colour;
  pen.globalAlpha = 0.24;
  pen.fillRect(0, 0, side, side);
  pen.globalAlpha = 0.85;
  pen.strokeStyle = colour;
  pen.lineWidth = 1.6;
  for (const shift of [-side, 0, side]) {
    pen.beginPath();
    pen.moveTo(shift, slope > 0 ? side : 0);
    pen.lineTo(shift + side, slope > 0 ? 0 : side);
    pen.stroke();
  }
  return context.createPattern(tile, "repeat") ?? colour;
}

// The camera's image with what was found in it.
export class Picture {
  private image: CameraImage | null = null;
  private bitmaps: { colour: ImageBitmap | null; depth: ImageBitmap | null; masks: ImageBitmap | null } =
    { colour: null, depth: null, masks: null };
  private readonly table = cividis();
  private latest = 0;

  constructor(private readonly canvas: HTMLCanvasElement, public options: PictureOptions,
              private readonly onColour: (image: ImageBitmap) => void) {}

  async show(image: CameraImage) {
    const mine = ++this.latest;
    const open = (blob: Blob | null) =>
      blob ? createImageBitmap(blob, { colorSpaceConversion: "none", premultiplyAlpha: "none" }).catch(() => null)
        : Promise.resolve(null);
    const [colour, depth, masks] = await Promise.all([open(image.colour), open(image.depth), open(image.masks)]);
    const old = this.bitmaps;
    if (mine !== this.latest) {
      for (const bitmap of [colour, depth, masks]) bitmap?.close();
      return;
    }
    this.image = image;
    this.bitmaps = { colour, depth, masks };
    for (const bitmap of Object.values(old)) bitmap?.close();
    if (colour) this.onColour(colour);
    this.draw();
  }

  get frame(): number | null { return this.image?.frame ?? null; }
  get far(): number { return this.image?.far ?? 0; }

  draw() {
    const image = this.image, canvas = this.canvas;
    if (!image) return;
    const scale = Math.min(2, window.devicePixelRatio || 1);
    const width = Math.round(canvas.clientWidth * scale), height = Math.round((width * image.height) / image.width);
    if (width === 0) return;
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    canvas.style.aspectRatio = `${image.width} / ${image.height}`;
    const pen = canvas.getContext("2d")!;
    pen.imageSmoothingEnabled = true;
    pen.clearRect(0, 0, width, height);
    if (this.options.depth && this.bitmaps.depth) this.drawDepth(pen, this.bitmaps.depth);
    else if (this.bitmaps.colour) pen.drawImage(this.bitmaps.colour, 0, 0, width, height);
    if (this.options.masks && this.bitmaps.masks) this.drawMasks(pen, this.bitmaps.masks);
    if (this.options.points) this.drawPoints(pen, image, width / image.width, scale);
  }

  private static pixelsOf(bitmap: ImageBitmap): ImageData {
    const canvas = document.createElement("canvas");
    canvas.width = bitmap.width;
    canvas.height = bitmap.height;
    const pen = canvas.getContext("2d", { willReadFrequently: true })!;
    pen.drawImage(bitmap, 0, 0);
    return pen.getImageData(0, 0, bitmap.width, bitmap.height);
  }

  private static canvasOf(pixels: ImageData): HTMLCanvasElement {
    const canvas = document.createElement("canvas");
    canvas.width = pixels.width;
    canvas.height = pixels.height;
    canvas.getContext("2d")!.putImageData(pixels, 0, 0);
    return canvas;
  }

  private drawDepth(pen: CanvasRenderingContext2D, bitmap: ImageBitmap) {
    const pixels = Picture.pixelsOf(bitmap), data = pixels.data;
    for (let i = 0; i < data.length; i += 4) {
      const step = data[i]!, at = 3 * (255 - step);  // near is bright
      const known = step > 0;
      data[i] = known ? this.table[at]! : 0;
      data[i + 1] = known ? this.table[at + 1]! : 0;
      data[i + 2] = known ? this.table[at + 2]! : 0;
      data[i + 3] = 255;
    }
    pen.drawImage(Picture.canvasOf(pixels), 0, 0, this.canvas.width, this.canvas.height);
  }

  private drawMasks(pen: CanvasRenderingContext2D, bitmap: ImageBitmap) {
    const pixels = Picture.pixelsOf(bitmap);
    const causes = [[1, okabe.purple, 1], [2, okabe.orange, -1]] as const;
    for (const [bit, colour, slope] of causes) {
      const mask = new ImageData(pixels.width, pixels.height);
      let any = false;
      for (let i = 0; i < mask.data.length; i += 4) {
        const set = (pixels.data[i]! & bit) !== 0;
        mask.data[i + 3] = set ? 255 : 0;
        any ||= set;
      }
      if (!any) continue;
      const layer = document.createElement("canvas");
      layer.width = this.canvas.width;
      layer.height = this.canvas.height;
      const brush = layer.getContext("2d")!;
      brush.drawImage(Picture.canvasOf(mask), 0, 0, layer.width, layer.height);
      brush.globalCompositeOperation = "source-in";
      brush.fillStyle = hatching(brush, colour, slope);
      brush.fillRect(0, 0, layer.width, layer.height);
      pen.drawImage(layer, 0, 0);
    }
  }

  private drawPoints(pen: CanvasRenderingContext2D, image: CameraImage, zoom: number, scale: number) {
    const { x, y, state, high } = image.points, size = 2.5 * scale;
    const shapes = new Map<string, Path2D>();
    const shape = (name: string) => {
      if (!shapes.has(name)) shapes.set(name, new Path2D());
      return shapes.get(name)!;
    };
    for (let i = 0; i < x.length; ++i) {
      const u = (x[i]! + 0.5) * zoom, v = (y[i]! + 0.5) * zoom;
      const r = state[i] === Point.unmatched ? 0.72 * size : size;
      const path = shape(`${state[i]}${high[i] ? "" : "low"}`);
      if (state[i] === Point.outlier) {
        path.moveTo(u - r, v - r);
        path.lineTo(u + r, v + r);
        path.moveTo(u - r, v + r);
        path.lineTo(u + r, v - r);
      } else if (high[i]) {
        path.moveTo(u + r, v);
        path.arc(u, v, r, 0, 2 * Math.PI);
      } else {
        path.moveTo(u, v - 1.2 * r);
        path.lineTo(u + 1.1 * r, v + 0.8 * r);
        path.lineTo(u - 1.1 * r, v + 0.8 * r);
        path.closePath();
      }
    }
    for (const [name, path] of shapes) {
      const kind: Point = Number(name[0]);
      const colour = kind === Point.inlier ? "#1fd6a0" : kind === Point.outlier ? "#ff7a1a" : okabe.sky;
      const thin = kind === Point.unmatched;
      pen.lineWidth = (thin ? 2 : 3) * scale;
      pen.strokeStyle = "rgba(0,0,0,0.55)";  // an edge, so that they show on any image
      pen.stroke(path);
      pen.lineWidth = (thin ? 1 : 1.4) * scale;
      pen.strokeStyle = colour;
      pen.stroke(path);
      if (kind === Point.inlier) {
        pen.fillStyle = colour;
        pen.fill(path);
      }
    }
  }
}
