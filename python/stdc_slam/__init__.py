"""STDC-SLAM: RGB-D visual SLAM that keeps its accuracy when people and things move.

    import stdc_slam

    recording = stdc_slam.open_input("rgbd_dataset_freiburg1_xyz")
    slam = stdc_slam.Slam(recording.camera, {"segmentation.source": "off"})
    for frame in recording:
        result = slam.track(frame.timestamp, frame.colour, frame.depth)
        print(result.status.name, result.cam_from_world)
    slam.finish()
    slam.trajectory().save("trajectory.txt")

Poses are cam_from_world: p_cam = cam_from_world @ p_world; metres, seconds, radians. Images are numpy arrays, RGB.
"""

from ._core import (
    Camera,
    Error,
    Features,
    Frame,
    Input,
    Mesh,
    Segmenter,
    Slam,
    Status,
    TrackingResult,
    Trajectory,
    evaluate,
    extract_features,
    open_input,
)

__version__ = "0.1.0"
__all__ = [
    "Camera",
    "Error",
    "Features",
    "Frame",
    "Input",
    "Mesh",
    "Segmenter",
    "Slam",
    "Status",
    "TrackingResult",
    "Trajectory",
    "evaluate",
    "extract_features",
    "open_input",
]
