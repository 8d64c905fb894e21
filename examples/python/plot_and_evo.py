"""Tracks a recording, scores it, plots it by matplotlib and hands it to evo.   plot_and_evo.py INPUT
Needs python3-matplotlib; evo is optional (pip install evo)."""
import sys

import matplotlib
import numpy as np

import stdc_slam

matplotlib.use("Agg")
import matplotlib.pyplot as plt

recording = stdc_slam.open_input(sys.argv[1])
slam = stdc_slam.Slam(recording.camera)
for frame in recording:
    slam.track(frame.timestamp, frame.colour, frame.depth)
slam.finish()
estimate, truth = slam.trajectory(), recording.ground_truth
figure, axes = plt.subplots()
at = estimate.positions
if truth is not None:
    scores = stdc_slam.evaluate(truth, estimate)
    print(f"ATE {1000 * scores['ate']['rmse']:.1f} mm over {scores['pairs']} poses")
    at = at @ scores["truth_from_estimate"][:3, :3].T + scores["truth_from_estimate"][:3, 3]
    axes.plot(truth.positions[:, 0], truth.positions[:, 1], "k--", label="truth")
axes.plot(at[:, 0], at[:, 1], label="estimate")
axes.set_aspect("equal")
axes.legend()
figure.savefig("trajectory.png")
try:
    from evo.core.trajectory import PoseTrajectory3D

    print(PoseTrajectory3D(poses_se3=list(estimate.world_from_cam), timestamps=np.array(estimate.timestamps)))
except ImportError:
    print("evo is not installed; trajectory files of TUM format go there too")
