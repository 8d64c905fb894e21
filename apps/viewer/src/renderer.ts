import { WebGLRenderer } from "three";

// Whether WebGL is done by the CPU: then there is less of everything while the picture moves.
export function drawsInSoftware(): boolean {
  const gl = document.createElement("canvas").getContext("webgl");
  const info = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = info ? String(gl!.getParameter(info.UNMASKED_RENDERER_WEBGL)) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

// Throws if the browser has no WebGL. The context is made here since three.js always asks for one with alpha: then the
// browser blends the canvas with what is behind it, which without a GPU takes a quarter of the time of a picture.
export function opaqueRenderer(canvas: HTMLCanvasElement, antialias: boolean): WebGLRenderer {
  const context = canvas.getContext("webgl2", { alpha: false, antialias, powerPreference: "high-performance" });
  if (!context) throw new Error("no WebGL");
  return new WebGLRenderer({ canvas, context });
}
