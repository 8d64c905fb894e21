"""Tracks an RGB-D recording and shows it by OpenCV: keypoints, what moves, the pose.   track_video.py INPUT
Needs python3-opencv."""
import sys

import cv2

import stdc_slam

recording = stdc_slam.open_input(sys.argv[1])
slam = stdc_slam.Slam(recording.camera)
for frame in recording:
    result = slam.track(frame.timestamp, frame.colour, frame.depth)
    picture = cv2.cvtColor(frame.colour, cv2.COLOR_RGB2BGR)
    if result.dynamic_mask is not None:
        picture[result.dynamic_mask > 0] //= 2
    for (x, y), good in zip(result.keypoints, result.inlier_mask):
        cv2.circle(picture, (int(x), int(y)), 2, (0, 200, 0) if good else (0, 100, 255), -1)
    cv2.putText(picture, f"{result.status.name}, {result.inliers} inliers", (10, 24), cv2.FONT_HERSHEY_SIMPLEX, 0.6, (255, 255, 255))
    cv2.imshow("STDC-SLAM", picture)
    if cv2.waitKey(1) == 27:
        break
slam.finish()
slam.trajectory().save("trajectory.txt")
