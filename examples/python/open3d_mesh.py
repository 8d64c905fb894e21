"""Makes the dense static map of a recording and shows it by Open3D (pip install open3d; not run here).   open3d_mesh.py INPUT"""
import sys

import open3d

import stdc_slam

recording = stdc_slam.open_input(sys.argv[1])
slam = stdc_slam.Slam(recording.camera, {"dense.active": True})
for frame in recording:
    slam.track(frame.timestamp, frame.colour, frame.depth)
slam.finish()
surface = slam.mesh()
mesh = open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(surface.vertices.astype(float)),
                                    open3d.utility.Vector3iVector(surface.triangles.astype("int32")))
mesh.vertex_colors = open3d.utility.Vector3dVector(surface.colours / 255)
mesh.vertex_normals = open3d.utility.Vector3dVector(surface.normals.astype(float))
open3d.visualization.draw_geometries([mesh])
