import { BufferAttribute, BufferGeometry, Mesh as ThreeMesh, MeshBasicMaterial } from "three";
import { coarseMesh } from "./detail";
import { hasPoints } from "./geometry";
import { Mesh } from "./protocol";

function geometryOf(mesh: Mesh): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(mesh.positions, 3, true));
  geometry.setAttribute("color", new BufferAttribute(mesh.colours, 3, true));
  geometry.setIndex(new BufferAttribute(mesh.triangles, 1));
  return geometry;
}

// The dense mesh, with fewer triangles at higher levels of detail.
export class DrawnMesh {
  readonly object = new ThreeMesh(new BufferGeometry(), new MeshBasicMaterial({ vertexColors: true }));
  private levels: BufferGeometry[] = [];

  set(mesh: Mesh) {
    for (const old of new Set(this.levels)) old.dispose();
    const full = geometryOf(mesh), medium = geometryOf(coarseMesh(mesh, 60000)), coarse = geometryOf(coarseMesh(mesh, 10000));
    this.levels = [full, medium, medium, coarse];
    this.object.geometry = full;
    this.object.position.fromArray(mesh.corner);
    this.object.scale.fromArray(mesh.size);
  }

  show(shown: boolean) { this.object.visible = shown && hasPoints(this.object); }

  setLevel(level: number) { this.object.geometry = this.levels[level] ?? this.object.geometry; }
}
