import { BufferAttribute, BufferGeometry, ColorRepresentation, Points, PointsMaterial } from "three";
import { sparse } from "./detail";
import { hasPoints, replacePoints } from "./geometry";

// Landmarks as points, fewer at higher levels of detail.
export class DrawnLandmarks {
  readonly object = new Points(new BufferGeometry(), new PointsMaterial({ size: 2, sizeAttenuation: false }));
  private levels: (BufferAttribute | null)[] = [];  // null: all of them

  setColour(colour: ColorRepresentation) { this.object.material.color.set(colour); }

  set(positions: Float32Array) {
    replacePoints(this.object, positions);
    const few = (max: number) => new BufferAttribute(sparse(positions.length / 3, max), 1);
    const many = few(20000);
    this.levels = [null, many, many, few(4000)];
  }

  show(shown: boolean) { this.object.visible = shown && hasPoints(this.object); }

  setLevel(level: number) { this.object.geometry.setIndex(this.levels[level] ?? null); }
}
