import { BufferGeometry, ColorRepresentation, LineBasicMaterial, LineSegments, Object3D } from "three";
import { Line2 } from "three/examples/jsm/lines/Line2.js";
import { LineGeometry } from "three/examples/jsm/lines/LineGeometry.js";
import { LineMaterial, LineMaterialParameters } from "three/examples/jsm/lines/LineMaterial.js";
import { segments, thinned } from "./detail";
import { thinLinesFrom } from "./detail_level";
import { hasLines, replacePoints } from "./geometry";

const maxThinPoints = 1000;

// A line through points; at higher levels of detail one pixel wide, which costs a software renderer a tenth.
export class DrawnLine {
  readonly material: LineMaterial;
  private readonly wide: Line2;
  private readonly thin = new LineSegments(new BufferGeometry(), new LineBasicMaterial());

  constructor(look: LineMaterialParameters, private readonly maxPoints: number) {
    this.material = new LineMaterial(look);
    this.wide = new Line2(new LineGeometry(), this.material);
  }

  get objects(): Object3D[] { return [this.wide, this.thin]; }

  setColour(colour: ColorRepresentation) {
    this.material.color.set(colour);
    this.thin.material.color.set(colour);
  }

  set(points: Float32Array) {
    this.wide.geometry.dispose();
    this.wide.geometry = new LineGeometry();
    if (points.length >= 6) {
      this.wide.geometry.setPositions(thinned(points, this.maxPoints));
      this.wide.computeLineDistances();
    }
    replacePoints(this.thin, segments(thinned(points, maxThinPoints), this.material.dashed ? 2 : 1));
  }

  show(shown: boolean, level: number) {
    const visible = shown && hasLines(this.wide), thin = level >= thinLinesFrom;
    [this.wide.visible, this.thin.visible] = [visible && !thin, visible && thin];
  }
}
