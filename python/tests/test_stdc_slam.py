"""Tests of the Python module: python3 -m unittest python/tests/test_stdc_slam.py

The sequence is rendered by the program STDC_PROGRAM; without it, or without its renderer, a moving wall is tracked."""
import os
import pathlib
import subprocess
import sys
import tempfile
import threading
import unittest

import numpy as np

import stdc_slam

PROGRAM = os.environ.get("STDC_PROGRAM", "")
FRAMES = 25
OFF = {"segmentation.source": "off"}


def camera(**more):
    return stdc_slam.Camera(320, 240, 300, 300, 160, 120, depth_units_per_metre=5000, **more)


def wall(number):
    """A textured wall 2 m away that slides by 6 mm a frame."""
    x = (np.arange(320) + int(round(number * 0.006 * 300 / 2))) // 9
    y = np.arange(240) // 9
    cells = (x[None, :] * 73856093) ^ (y[:, None] * 19349663)
    grey = ((cells * 2654435761) >> 13 & 255).astype(np.uint8)
    return number / 30.0, np.dstack([grey, grey, grey]), np.full((240, 320), 10000, np.uint16)


def track_wall(slam, frames=12, **options):
    return [slam.track(*wall(i), **options) for i in range(frames)]


class Tracking(unittest.TestCase):
    def test_tracks_a_wall(self):
        slam = stdc_slam.Slam(camera(), OFF)
        results = track_wall(slam)
        slam.finish()
        last = results[-1]
        self.assertEqual(last.status, stdc_slam.Status.ok)
        self.assertEqual(last.cam_from_world.shape, (4, 4))
        self.assertEqual(last.covariance.shape, (6, 6))
        self.assertEqual(len(last.keypoints), len(last.inlier_mask))
        self.assertGreater(last.inlier_mask.sum(), 30)
        self.assertLess(abs(last.world_from_cam[0, 3] - 11 * 0.006), 0.02)
        self.assertTrue(np.allclose(np.linalg.inv(last.cam_from_world), last.world_from_cam))
        trajectory = slam.trajectory()
        self.assertEqual(len(trajectory), 12)
        self.assertEqual(trajectory.positions.shape, (12, 3))
        self.assertEqual(slam.landmarks().shape[1], 3)
        self.assertGreater(slam.keyframe_count, 0)
        self.assertIn("total", last.milliseconds)

    def test_any_layout_of_the_same_values_gives_the_same_bytes(self):
        def run(change):
            slam = stdc_slam.Slam(camera(), OFF)
            for i in range(8):
                time, colour, depth = wall(i)
                slam.track(*change(time, colour, depth))
            slam.finish()
            return str(slam.trajectory())

        def read_only(time, colour, depth):
            colour.flags.writeable = depth.flags.writeable = False
            return time, colour, depth

        expected = run(lambda t, c, d: (t, c, d))
        self.assertTrue(expected)
        for change in (
            read_only,
            lambda t, c, d: (t, np.asfortranarray(c), np.asfortranarray(d)),
            lambda t, c, d: (t, np.ascontiguousarray(c[::-1, ::-1])[::-1, ::-1], np.ascontiguousarray(d[::-1])[::-1]),
            lambda t, c, d: (t, c, d.astype(">u2")),
            lambda t, c, d: (np.datetime64(0, "ns") + np.timedelta64(int(round(t * 1e9)), "ns"), c, d),
        ):
            self.assertEqual(run(change), expected)

    def test_arrays_may_be_used_again_after_each_frame(self):
        def run(overwrite, grey, **settings):
            slam = stdc_slam.Slam(camera(), {**OFF, **settings})
            for i in range(12):
                time, colour, depth = wall(i)
                colour = np.ascontiguousarray(colour[..., 0]) if grey else colour
                slam.track(time, colour, depth)
                if overwrite:
                    colour[:], depth[:] = 77, 0
            slam.finish()
            mesh = slam.mesh(0.02).vertices.tobytes() if settings.get("dense.active") else b""
            return str(slam.trajectory()), mesh

        for grey in (False, True):
            for settings in ({}, {"motion.method": "map"}, {"dense.active": True}):
                self.assertEqual(run(True, grey, **settings), run(False, grey, **settings), settings)

    def test_float_depth_with_nan_and_none(self):
        for kind in (np.float32, np.float64):
            slam = stdc_slam.Slam(camera(), OFF)
            for i in range(6):
                time, colour, depth = wall(i)
                metres = depth.astype(kind) / 5000
                metres[:20] = np.nan
                self.assertIsNotNone(slam.track(time, colour, metres))
            self.assertEqual(slam.track(1.0, wall(6)[1], None).frame, 6)

    def test_two_threads_do_not_disturb_each_other(self):
        def run(results, key):
            slam = stdc_slam.Slam(camera(), OFF)
            track_wall(slam)
            slam.finish()
            results[key] = str(slam.trajectory())

        results = {}
        threads = [threading.Thread(target=run, args=(results, i)) for i in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        run(results, "alone")
        self.assertEqual(len(set(results.values())), 1)
        self.assertEqual(len(results), 4)

    def test_one_object_in_two_threads(self):
        slam = stdc_slam.Slam(camera(), OFF)
        track_wall(slam, 4)
        threads = [threading.Thread(target=lambda: [slam.trajectory() for _ in range(50)]) for _ in range(2)]
        for thread in threads:
            thread.start()
        for i in range(4, 12):
            slam.track(*wall(i))
        for thread in threads:
            thread.join()
        self.assertEqual(len(slam.trajectory()), 12)

    def test_goes_on_after_finish(self):
        slam = stdc_slam.Slam(camera(), OFF)
        track_wall(slam, 6)
        slam.finish()
        slam.finish()
        self.assertEqual(slam.track(*wall(6)).status, stdc_slam.Status.ok)

    def test_map_is_saved_and_loaded(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "room.map"
            slam = stdc_slam.Slam(camera(), OFF)
            track_wall(slam)
            slam.save_map(path)
            again = stdc_slam.Slam(camera(), OFF)
            again.load_map(path)
            self.assertEqual(again.landmark_count, slam.landmark_count)
            with self.assertRaises(stdc_slam.Error):
                again.load_map(pathlib.Path(folder) / "none.map")

    def test_dense_map(self):
        slam = stdc_slam.Slam(camera(), {**OFF, "dense.active": True})
        track_wall(slam, 20)
        slam.finish()
        mesh = slam.mesh(0.02)
        self.assertEqual(mesh.vertices.shape, mesh.normals.shape)
        self.assertEqual(mesh.triangles.shape[1], 3)
        if len(mesh.triangles):
            self.assertLess(mesh.triangles.max(), len(mesh.vertices))


class BadInput(unittest.TestCase):
    def refused(self, *arguments, **options):
        with self.assertRaises(stdc_slam.Error) as caught:
            stdc_slam.Slam(camera(), OFF).track(*arguments, **options)
        error = caught.exception
        self.assertTrue(error.where and error.problem and error.hint)
        self.assertNotIn("\n", str(error))

    def test_arrays(self):
        time, colour, depth = wall(0)
        for bad in (colour.astype(float), colour[:, :, :2], colour[:100], colour[None], colour.tolist(), None, "x",
                    np.zeros((0, 0), np.uint8), np.zeros((240, 320, 4), np.uint8), colour.astype(np.int8)):
            self.refused(time, bad, depth)
        for bad in (depth.astype(np.int32), depth[:, :100], depth[..., None], depth.tolist(), "x", depth.astype(bool),
                    depth.astype(np.uint8), np.zeros((0, 320), np.uint16)):
            self.refused(time, colour, bad)
        self.refused(time, colour, depth, order="gbr")

    def test_times(self):
        _, colour, depth = wall(0)
        for bad in (None, "now", True, 1700000000000000000, float("nan"), [1], np.datetime64("nat")):
            self.refused(bad, colour, depth)
        slam = stdc_slam.Slam(camera(), OFF)
        slam.track(5, colour, depth)
        self.assertEqual(slam.track(5.0, colour, depth).status, stdc_slam.Status.skipped)
        self.assertEqual(slam.track(4.0, colour, depth).status, stdc_slam.Status.skipped)

    def test_settings(self):
        for bad in ({"features.keypoint": 3}, {"features": {"keypoints": -3}}, {"x": 1}, "features: [", "none.yaml",
                    {"features.keypoints": None}):
            with self.assertRaises(stdc_slam.Error):
                stdc_slam.Slam(camera(), bad)
        for bad in (3, [1]):
            with self.assertRaises((stdc_slam.Error, TypeError)):
                stdc_slam.Slam(camera(), bad)
        stdc_slam.Slam(camera(), "features: {keypoints: 500}\nsegmentation: {source: 'off'}")

    def test_camera(self):
        with self.assertRaises(stdc_slam.Error):
            stdc_slam.Camera(0, 240, 300, 300, 160, 120)
        with self.assertRaises(stdc_slam.Error):
            camera(zoom=3)
        with self.assertRaises(stdc_slam.Error):
            stdc_slam.Camera.read("none.yaml")
        self.assertEqual(camera(k1=0.1).lens, "radial-tangential")

    def test_files(self):
        for call in (lambda: stdc_slam.open_input("none"), lambda: stdc_slam.Segmenter("none.safetensors"),
                     lambda: stdc_slam.evaluate("none.txt", "none.txt"),
                     lambda: stdc_slam.evaluate(np.zeros((4, 7)), np.zeros((4, 7)))):
            with self.assertRaises(stdc_slam.Error):
                call()

    def test_fork_after_construction_says_so(self):
        slam = stdc_slam.Slam(camera(), OFF)
        track_wall(slam, 3)
        child = os.fork()
        if child == 0:
            try:
                slam.track(*wall(3))
                os._exit(1)
            except stdc_slam.Error:
                del slam
                os._exit(0)
        self.assertEqual(os.waitpid(child, 0)[1], 0)
        self.assertEqual(slam.track(*wall(3)).frame, 3)

    def test_the_interpreter_may_end_in_the_middle(self):
        code = ("import sys; sys.path[:0] = %r; sys.argv = ['']\n"
                "import test_stdc_slam as t, threading, stdc_slam\n"
                "slam = stdc_slam.Slam(t.camera(), t.OFF); t.track_wall(slam, 5)\n"
                "threading.Thread(target=lambda: t.track_wall(stdc_slam.Slam(t.camera(), t.OFF), 400),"
                " daemon=True).start()\n" % sys.path)
        folder = str(pathlib.Path(__file__).parent)
        done = subprocess.run([sys.executable, "-c", code], cwd=folder, capture_output=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)


class Tools(unittest.TestCase):
    def test_features(self):
        image = wall(0)[1]
        features = stdc_slam.extract_features(image, settings={"features.keypoints": 300})
        self.assertEqual(features.descriptors.shape, (len(features), 32))
        self.assertEqual(features.keypoints.shape, (len(features), 2))
        self.assertEqual(len(features.angles), len(features))
        mask = np.zeros((240, 320), bool)
        mask[:, :160] = True
        self.assertGreater(stdc_slam.extract_features(image, mask=mask).keypoints[:, 0].min(), 159)
        grey = stdc_slam.extract_features(image[:, :, 0].copy(), settings={"features.keypoints": 300})
        self.assertEqual(len(grey), len(features))

    def test_segmenter(self):
        segment = stdc_slam.Segmenter()
        mask = segment(wall(0)[1], wall(0)[2], depth_units_per_metre=5000)
        self.assertEqual((mask.shape, mask.dtype), ((240, 320), np.dtype(np.uint8)))
        self.assertIn("person", segment.classes)
        self.assertTrue(segment.description)

    def test_trajectories_are_scored(self):
        times = np.arange(20) / 10
        poses = np.tile(np.eye(4), (20, 1, 1))
        poses[:, 0, 3] = np.sin(times)
        poses[:, 1, 3] = times ** 2
        truth = stdc_slam.Trajectory(times, poses)
        with tempfile.TemporaryDirectory() as folder:
            truth.save(folder + "/truth.txt")
            scores = stdc_slam.evaluate(folder + "/truth.txt", truth)
            self.assertEqual(len(stdc_slam.Trajectory.read(folder + "/truth.txt")), 20)
        self.assertEqual(scores["pairs"], 20)
        self.assertLess(scores["ate"]["rmse"], 1e-6)
        poses[0, 0, 0] = 3
        with self.assertRaises(stdc_slam.Error):
            stdc_slam.Trajectory(times, poses)


@unittest.skipUnless(PROGRAM, "needs the program in STDC_PROGRAM")
class LikeTheCommandLine(unittest.TestCase):
    def test_same_bytes(self):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([PROGRAM, "render", "walking-xyz", "--frames", str(FRAMES), "--output", folder + "/s",
                                   "--quiet"], capture_output=True)
            if done.returncode != 0:
                self.skipTest("the program has no renderer")
            for settings, grey in ((OFF, True), ({}, False)):
                options = ["--segmentation", "off"] if grey else []
                subprocess.run([PROGRAM, "run", folder + "/s", "--output", folder + "/r", "--quiet", *options],
                               check=True)
                recording = stdc_slam.open_input(folder + "/s", grey=grey)
                self.assertEqual(len(recording), FRAMES)
                slam = stdc_slam.Slam(recording.camera, settings)
                for frame in recording:
                    slam.track(frame.timestamp, frame.colour, frame.depth)
                slam.finish()
                slam.trajectory().save(folder + "/trajectory.txt")
                expected = pathlib.Path(folder + "/r/trajectory.txt").read_bytes()
                self.assertEqual(pathlib.Path(folder + "/trajectory.txt").read_bytes(), expected)
                self.assertIsNotNone(recording.ground_truth)
                self.assertEqual(sum(1 for _ in recording), FRAMES)  # a second time


if __name__ == "__main__":
    unittest.main()
