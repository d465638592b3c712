# SPDX-License-Identifier: MIT
"""check_runs.py GMSIM [KILLS]: the program runs scenes, ends in every way there is, and what it leaves is read by h5py
and VTK. KILLS: how many runs are killed, and how many write to a full disk (10 unless told otherwise)."""

import json
import os
import pathlib
import random
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "io"))
from check_vtkhdf import check_file  # noqa: E402

GMSIM = pathlib.Path(sys.argv[1]).resolve()
KILLS = int(sys.argv[2]) if len(sys.argv) > 2 else 10

SCENE = """
dimension: 2
rules: [springs]
bodies:
  - name: cloth
    mesh: { grid: { patches: [4, 3], size: [0.4, 0.3], cells: quads } }
    mass: 0.02
    interactions:
      stretch_spring:      { stiffness: 20, damping: 0.005 }
      linear_shear_spring: { stiffness: 10, damping: 0.005 }
gravity: [0, 0, -9.81]
fix: [ { where: "position.y > 0.299" } ]
integrator: { method: rk4, dt: 1e-3 }
duration: 0.1
output: { every: 0.01, fields: [mass, { name: height, value: "position.z" }, { name: size, value: "count(v in face(a) / vertex)", on: face }] }
"""


class Run:
    """A finished process: its exit code and what it said."""

    def __init__(self, folder, *words, limit=None):
        before = (lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))) if limit else None
        process = subprocess.run([GMSIM, *words], cwd=folder, capture_output=True, text=True, preexec_fn=before)
        self.code, self.out, self.err = process.returncode, process.stdout, process.stderr

    def events(self, kind=None):
        events = [json.loads(line) for line in self.out.splitlines()]
        return [event for event in events if kind is None or event["event"] == kind]


class RunTest(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.scratch.name)
        (self.folder / "scene.yaml").write_text(SCENE)

    def tearDown(self):
        self.scratch.cleanup()

    def run_scene(self, *words, code=0, **options):
        run = Run(self.folder, "scene.yaml", *words, **options)
        self.assertEqual(run.code, code, run.out + run.err)
        return run

    def hash_of(self, *words):
        return self.run_scene("--no-output", "--json", *words).events("end")[0]["state_hash"]


class WholeRuns(RunTest):
    def test_file_is_read_by_vtk_and_holds_frames_at_their_times(self):
        run = self.run_scene()
        self.assertIn("scene.vtkhdf", run.out)
        self.assertEqual(run.err, "")
        self.assertEqual(check_file(self.folder / "scene.vtkhdf"), 11)
        with h5py.File(self.folder / "scene.vtkhdf") as file:
            steps = file["VTKHDF/Steps"]
            np.testing.assert_allclose(steps["Values"][:], np.arange(11) * 0.01, atol=1e-12)
            self.assertEqual(list(file["gmsim/frame_steps"]), list(range(0, 101, 10)))
            self.assertEqual(file["gmsim"].attrs["ending"], b"finished")
            self.assertEqual(file["VTKHDF/NumberOfPoints"][0], 20)
            self.assertEqual(set(file["VTKHDF/PointData"]), {"velocity", "mass", "dart", "height"})
            self.assertEqual(set(file["VTKHDF/CellData"]), {"dart", "size"})
            first, count = steps["PointDataOffsets/height"][10], 20
            heights = file["VTKHDF/PointData/height"][first : first + count]
            points = file["VTKHDF/Points"][steps["PointOffsets"][10] :][:count]
            np.testing.assert_allclose(heights, points[:, 2], rtol=1e-6, atol=1e-12)
            self.assertTrue((file["VTKHDF/CellData/size"][:] == 4).all())
            self.assertAlmostEqual(file["VTKHDF/PointData/mass"][:count].sum(), 0.02, places=7)
            self.assertIn("stretch_spring", file["gmsim/scene"][()].decode())
            self.assertIn("springs.stretch", file["gmsim/rules"])

    def test_points_are_numbered_as_the_mesh_numbers_them(self):
        self.run_scene()
        with h5py.File(self.folder / "scene.vtkhdf") as file:
            points = file["VTKHDF/Points"][:20]
        grid = [(0.1 * i, 0.1 * j, 0) for j in range(4) for i in range(5)]
        np.testing.assert_allclose(points, grid, atol=1e-12)

    def test_frames_between_steps_have_velocities_that_are_the_derivative_of_positions(self):
        self.run_scene("--set", "integrator.method=dormand_prince", "--set", "integrator.dt=auto", "--set",
                       "output.every=2e-4")
        with h5py.File(self.folder / "scene.vtkhdf") as file:
            frames = file["VTKHDF/Steps"].attrs["NSteps"]
            times = file["VTKHDF/Steps/Values"][:]
            x = file["VTKHDF/Points"][:].reshape(frames, 20, 3)
            v = file["VTKHDF/PointData/velocity"][:].reshape(frames, 20, 3)
        np.testing.assert_allclose(times, np.arange(frames) * 2e-4, atol=1e-12)  # between the steps
        slope = (x[2:] - x[:-2]) / (times[2:] - times[:-2])[:, None, None]
        np.testing.assert_allclose(v[1:-1], slope, atol=2e-4)

    def test_series_has_energies_that_add_up(self):
        swing = SCENE.replace(", damping: 0.005", "").replace("gravity: [0, 0, -9.81]", "")
        push = 'initial: [ { velocity: "(0, 0, position.y - 0.3) / 0.5 [s]" } ]'
        (self.folder / "scene.yaml").write_text(swing.replace("    interactions", f"    {push}\n    interactions"))
        self.run_scene("--set", "output.report_every=1e-3")
        with h5py.File(self.folder / "scene.vtkhdf") as file:
            series = {name: data[:] for name, data in file["gmsim/series"].items()}
        self.assertEqual(len(series["time"]), 101)
        total = series["kinetic"] + series["potential"]
        self.assertLess(np.ptp(total), 1e-6 * series["kinetic"].max())
        self.assertTrue((np.diff(series["evaluations"]) == 4).all())
        self.assertTrue((series["points"] == 20).all() and (series["cells"] == 12).all())

    def test_output_threads_and_kernels_do_not_change_the_run(self):
        reference = self.hash_of()
        self.assertEqual(self.hash_of("--threads", "2"), reference)
        self.run_scene("--set", "output.every=0.0037")
        with h5py.File(self.folder / "scene.vtkhdf") as file:
            self.assertEqual(file["gmsim"].attrs["state_hash"].decode(), reference)

    def test_overrides_are_in_the_scene_inside(self):
        self.run_scene("--set", "integrator.dt=5e-4", "--out", "other.vtkhdf")
        inside = Run(self.folder, "info", "other.vtkhdf", "--scene").out
        (self.folder / "again.yaml").write_text(inside)
        again = Run(self.folder, "again.yaml", "--no-output", "--json")
        self.assertEqual(again.code, 0, again.err)
        self.assertEqual(again.events("end")[0]["step"], 200)
        self.assertEqual(again.events("end")[0]["state_hash"], self.hash_of("--set", "integrator.dt=5e-4"))

    def test_json_lines(self):
        run = self.run_scene("--json")
        self.assertEqual([event["event"] for event in run.events()], ["start"] + 11 * ["frame"] + ["end"])
        self.assertEqual([event["frame"] for event in run.events("frame")], list(range(11)))
        end = run.events("end")[0]
        self.assertEqual((end["ending"], end["step"], end["file"]), ("finished", 100, "scene.vtkhdf"))

    def test_no_output_writes_nothing(self):
        self.run_scene("--no-output")
        self.assertEqual([p.name for p in self.folder.iterdir()], ["scene.yaml"])


class EarlyEnds(RunTest):
    LONG = ("--set", "duration=1000", "--json")

    def start(self, *words):
        return subprocess.Popen([GMSIM, "scene.yaml", *self.LONG, *words], cwd=self.folder, stdout=subprocess.PIPE, text=True)

    def test_control_c_and_sigterm_close_the_file(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            process = self.start()
            for _ in range(4):
                process.stdout.readline()
            process.send_signal(number)
            end = json.loads(process.communicate()[0].splitlines()[-1])
            self.assertEqual(process.returncode, 4)
            self.assertEqual(end["ending"], "interrupted")
            self.assertFalse((self.folder / "scene.vtkhdf.part").exists())
            self.assertEqual(check_file(self.folder / "scene.vtkhdf", orders=1), end["frames"])
            with h5py.File(self.folder / "scene.vtkhdf") as file:
                self.assertEqual(file["VTKHDF/Steps/Values"][-1], end["time"])

    def test_max_wall(self):
        begin = time.monotonic()
        run = self.run_scene(*self.LONG, "--max-wall", "0.5", code=4)
        self.assertEqual(run.events("end")[0]["ending"], "interrupted")
        self.assertLess(time.monotonic() - begin, 60)
        self.assertGreater(check_file(self.folder / "scene.vtkhdf", orders=1), 1)

    def test_blow_up_keeps_what_was_written(self):
        run = self.run_scene("--json", "--set", "integrator.on_unstable=warn", "--set", "integrator.dt=0.04",
                             "--set", "duration=1000", code=1)
        end = run.events("end")[0]
        self.assertEqual(end["ending"], "stopped")
        self.assertIn("[diverged]", run.err)
        self.assertEqual(check_file(self.folder / "scene.vtkhdf", orders=1), end["frames"])
        with h5py.File(self.folder / "scene.vtkhdf") as file:
            self.assertTrue(np.isfinite(file["VTKHDF/Points"][:]).all())
            self.assertEqual(file["gmsim"].attrs["ending"], b"stopped")

    def test_left_over_part_is_not_written_over(self):
        (self.folder / "scene.vtkhdf.part").write_text("somebody's")
        self.assertIn("gmsim recover", self.run_scene(code=2).err)
        self.assertEqual((self.folder / "scene.vtkhdf.part").read_text(), "somebody's")
        self.run_scene("--force")

    def test_every_frame_reported_before_a_kill_is_recovered(self):
        seed = random.SystemRandom().randrange(1 << 30)
        chance = random.Random(seed)
        for _ in range(KILLS):
            process = self.start("--force")
            for _ in range(chance.randrange(2, 40)):
                process.stdout.readline()
            time.sleep(chance.random() * 3e-3)
            process.kill()
            lines = process.communicate()[0].splitlines()
            reported = [json.loads(line)["frame"] for line in lines if line.startswith("{\"event\": \"frame") and line.endswith("}")]
            recover = Run(self.folder, "recover", "scene.vtkhdf.part", "-o", "back.vtkhdf", "--force")
            self.assertEqual(recover.code, 0, f"seed {seed}: {recover.err}")
            self.assertGreaterEqual(check_file(self.folder / "back.vtkhdf", orders=1), max(reported, default=0) + 1, f"seed {seed}")

    def test_every_frame_reported_before_a_failed_write_is_recovered(self):
        seed = random.SystemRandom().randrange(1 << 30)
        chance = random.Random(seed)
        self.run_scene("--set", "duration=1")
        size = os.path.getsize(self.folder / "scene.vtkhdf")
        for _ in range(KILLS):
            limit = chance.randrange(size // 2, size)
            run = self.run_scene("--json", "--force", "--set", "duration=1", code=3, limit=limit)
            self.assertIn("could not be written", run.err, f"seed {seed}")
            frames = len(run.events("frame"))
            if frames == 0:
                continue
            recover = Run(self.folder, "recover", "scene.vtkhdf.part", "-o", "back.vtkhdf", "--force")
            self.assertEqual(recover.code, 0, f"seed {seed}: {recover.err}")
            self.assertGreaterEqual(check_file(self.folder / "back.vtkhdf", orders=1), frames, f"seed {seed}")


class OtherCommands(RunTest):
    def test_study_finds_the_order_of_methods_and_lists_what_is_unstable(self):
        run = Run(self.folder, "study", "scene.yaml", "--methods", "rk4,symplectic_euler", "--dt", "2e-3,1e-3,0.1",
                  "--reference-dt", "1e-4", "--repetitions", "1", "-o", "study")
        self.assertEqual(run.code, 0, run.err)
        self.assertIn("no result", run.out)
        study = json.loads((self.folder / "study" / "study.json").read_text())
        points = {(p["method"], p["dt"]): p for p in study["points"]}
        self.assertEqual(len(points), 6)
        self.assertIn("problem", points["rk4", 0.1])
        for method, order in (("rk4", 4), ("symplectic_euler", 1)):
            coarse, fine = points[method, 2e-3]["e_end"], points[method, 1e-3]["e_end"]
            self.assertAlmostEqual(np.log2(coarse / fine), order, delta=0.5)
        self.assertEqual(points["rk4", 1e-3]["evaluations"], 401)
        lines = (self.folder / "study" / "study.csv").read_text().splitlines()
        self.assertEqual(len(lines), 7)
        self.assertEqual({line.count(",") for line in lines if "rk4,0.1" not in line and "euler,0.1" not in line}, {15})

    def test_verify_says_what_is_not_met(self):
        expect = """
expect:
  - { value: "position.z", point: 0, at: 0.05, at_most: 0 }
  - { value: "position", point: 19, at: end, equals: [0.4, 0.3, 0], within: 1e-12 }
"""
        (self.folder / "scene.yaml").write_text(SCENE + expect)
        good = Run(self.folder, "verify", "scene.yaml", "--json")
        self.assertEqual(good.code, 0, good.out + good.err)
        self.assertEqual(json.loads(good.out)["met"], 2)
        (self.folder / "scene.yaml").write_text(SCENE + expect.replace("[0.4, 0.3, 0]", "[0.4, 0.3, 1]"))
        bad = Run(self.folder, "verify", "scene.yaml")
        self.assertEqual(bad.code, 1, bad.out + bad.err)
        self.assertIn("FAIL", bad.out)
        self.assertIn("1 of 2 met", bad.out)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
