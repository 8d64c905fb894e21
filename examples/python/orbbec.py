"""Tracks an Orbbec camera (pip install pyorbbecsdk). Written from its documentation; not run here."""
import numpy as np
import pyorbbecsdk as ob

import stdc_slam

pipeline, config = ob.Pipeline(), ob.Config()
colour = pipeline.get_stream_profile_list(ob.OBSensorType.COLOR_SENSOR).get_video_stream_profile(640, 480, ob.OBFormat.RGB, 30)
depth = pipeline.get_stream_profile_list(ob.OBSensorType.DEPTH_SENSOR).get_video_stream_profile(640, 480, ob.OBFormat.Y16, 30)
config.enable_stream(colour)
config.enable_stream(depth)
config.set_align_mode(ob.OBAlignMode.SW_MODE)
pipeline.start(config)
lens = pipeline.get_camera_param().rgb_intrinsic
slam = stdc_slam.Slam(stdc_slam.Camera(lens.width, lens.height, lens.fx, lens.fy, lens.cx, lens.cy, 1000))
try:
    while True:
        frames = pipeline.wait_for_frames(100)
        if not frames or not frames.get_color_frame() or not frames.get_depth_frame():
            continue
        image, range_ = frames.get_color_frame(), frames.get_depth_frame()
        rgb = np.frombuffer(image.get_data(), np.uint8).reshape(lens.height, lens.width, 3)
        z = np.frombuffer(range_.get_data(), np.uint16).reshape(lens.height, lens.width)
        print(slam.track(image.get_timestamp() / 1000, rgb, z))
except KeyboardInterrupt:
    slam.trajectory().save("trajectory.txt")
