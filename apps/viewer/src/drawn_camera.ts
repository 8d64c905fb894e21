import {
  BufferAttribute, BufferGeometry, CanvasTexture, DoubleSide, Mesh, MeshBasicMaterial, Object3D, SRGBColorSpace,
} from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import { okabe } from "./colours";
import { frustum } from "./frustum";
import { Pose, RunState } from "./protocol";

// The camera of the run, with what it sees on its frustum.
export class DrawnCamera {
  readonly object = new Object3D();
  readonly material = new LineMaterial({ linewidth: 2.5, color: okabe.orange });
  private readonly pane = document.createElement("canvas");
  private readonly paneMaterial = new MeshBasicMaterial(
    { color: okabe.orange, transparent: true, opacity: 0.25, side: DoubleSide, depthWrite: false });

  build(state: RunState) {
    const { corners, edges } = frustum(state, 0.28);
    const geometry = new LineSegmentsGeometry();
    geometry.setPositions(edges.flatMap((i) => corners[i]!.toArray()));
    const pane = new BufferGeometry().setFromPoints([1, 2, 3, 1, 3, 4].map((i) => corners[i]!));
    pane.setAttribute("uv", new BufferAttribute(new Float32Array([0, 1, 1, 1, 1, 0, 0, 1, 1, 0, 0, 0]), 2));
    this.object.clear();
    this.object.add(new LineSegments2(geometry, this.material), new Mesh(pane, this.paneMaterial));
    this.object.traverse((object) => { object.frustumCulled = false; });
  }

  setImage(image: ImageBitmap) {
    const first = this.paneMaterial.map === null;
    this.pane.width = 160;
    this.pane.height = Math.round((160 * image.height) / image.width);
    this.pane.getContext("2d")!.drawImage(image, 0, 0, this.pane.width, this.pane.height);
    if (first) {
      const texture = new CanvasTexture(this.pane);
      texture.colorSpace = SRGBColorSpace;
      Object.assign(this.paneMaterial, { map: texture, opacity: 0.9, needsUpdate: true });
      this.paneMaterial.color.set("#ffffff");
    }
    this.paneMaterial.map!.needsUpdate = true;
  }

  setPose(pose: Pose | null) {
    this.object.visible = pose !== null;
    if (!pose) return;
    this.object.position.fromArray(pose.position);
    this.object.quaternion.fromArray(pose.quaternion);
  }
}
