"""Tracks an OAK camera (pip install depthai, version 2). Written from its documentation; not run here."""
import depthai as dai

import stdc_slam

pipeline = dai.Pipeline()
colour, stereo = pipeline.create(dai.node.ColorCamera), pipeline.create(dai.node.StereoDepth)
left, right = pipeline.create(dai.node.MonoCamera), pipeline.create(dai.node.MonoCamera)
left.setBoardSocket(dai.CameraBoardSocket.CAM_B)
right.setBoardSocket(dai.CameraBoardSocket.CAM_C)
colour.setPreviewSize(640, 480)
stereo.setDepthAlign(dai.CameraBoardSocket.CAM_A)
stereo.setOutputSize(640, 480)
left.out.link(stereo.left)
right.out.link(stereo.right)
for output, name in ((colour.preview, "colour"), (stereo.depth, "depth")):
    link = pipeline.create(dai.node.XLinkOut)
    link.setStreamName(name)
    output.link(link.input)
with dai.Device(pipeline) as device:
    matrix = device.readCalibration().getCameraIntrinsics(dai.CameraBoardSocket.CAM_A, 640, 480)
    slam = stdc_slam.Slam(stdc_slam.Camera(640, 480, matrix[0][0], matrix[1][1], matrix[0][2], matrix[1][2], 1000))
    images, depths = device.getOutputQueue("colour", 4, False), device.getOutputQueue("depth", 4, False)
    while True:
        image, depth = images.get(), depths.get()
        print(slam.track(image.getTimestampDevice().total_seconds(), image.getCvFrame(), depth.getFrame(), order="bgr"))
