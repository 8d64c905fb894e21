"""Tracks a RealSense camera (pip install pyrealsense2). Written from its documentation; not run here."""
import numpy as np
import pyrealsense2 as rs

import stdc_slam

pipeline, config = rs.pipeline(), rs.config()
config.enable_stream(rs.stream.depth, 640, 480, rs.format.z16, 30)
config.enable_stream(rs.stream.color, 640, 480, rs.format.rgb8, 30)
profile = pipeline.start(config)
align = rs.align(rs.stream.color)
lens = profile.get_stream(rs.stream.color).as_video_stream_profile().get_intrinsics()
units = 1 / profile.get_device().first_depth_sensor().get_depth_scale()
slam = stdc_slam.Slam(stdc_slam.Camera(lens.width, lens.height, lens.fx, lens.fy, lens.ppx, lens.ppy, units))
try:
    while True:
        frames = align.process(pipeline.wait_for_frames())
        colour, depth = frames.get_color_frame(), frames.get_depth_frame()
        result = slam.track(colour.get_timestamp() / 1000, np.asanyarray(colour.get_data()), np.asanyarray(depth.get_data()))
        print(result.status.name, result.world_from_cam[:3, 3] if result.world_from_cam is not None else "")
except KeyboardInterrupt:
    slam.trajectory().save("trajectory.txt")
