# SPDX-License-Identifier: MIT
"""What must not depend on where, how and how often a scene is run.

Usage: invariance.py GMSIM [--slow]

Each check runs scenes written here and compares the numbers of their trajectories: turned, moved and mirrored
scenes, momentum of free bodies, the long-time energy of velocity Verlet, repeated runs, a step above the limit.
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy as np

GMSIM = sys.argv[1]
SLOW = "--slow" in sys.argv
FOLDER = pathlib.Path(tempfile.mkdtemp())
failures = []


def check(name, value, limit):
    ok = bool(value <= limit)
    print(f"{'ok    ' if ok else 'FAILED'} {name}: {value:.3g} (at most {limit:g})")
    if not ok:
        failures.append(name)


def run(name, scene, expect=0, extra=()):
    """Runs a scene; gives the path of its trajectory and what the program said."""
    path = FOLDER / f"{name}.yaml"
    path.write_text(json.dumps(scene, indent=1))  # JSON is YAML
    out = FOLDER / f"{name}.vtkhdf"
    command = [GMSIM, "run", str(path), "--out", str(out), "--force", *extra]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != expect:
        raise SystemExit(f"{' '.join(command)}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return out, done.stdout + done.stderr


def points(path, frame=-1):
    """Positions in one frame, in the order of the mesh."""
    with h5py.File(path) as file:
        steps = file["VTKHDF/Steps"]
        offsets = steps["PointOffsets"][:]
        part = steps["PartOffsets"][:]
        first = offsets[frame]
        count = file["VTKHDF/NumberOfPoints"][part[frame]]
        return file["VTKHDF/Points"][first:first + count]


def series(path, name):
    with h5py.File(path) as file:
        return file[f"gmsim/series/{name}"][:]


def cloth(turn=np.eye(3), shift=np.zeros(3), method="rk4", dt=2.5e-4, duration=1.0, n=3, damping=0.1,
          cells="quads", fixed=None, gravity=(0, 0, -9.81), every=None, velocity=None):
    """A cloth of n x n cells of 60/43/10 N/m hung by its upper corners, turned and shifted as a whole."""
    flat = np.array([[i / n, j / n, 0.0] for j in range(n + 1) for i in range(n + 1)])
    placed = flat @ turn.T + shift
    at = lambda i, j: j * (n + 1) + i
    faces = [[at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)] for j in range(n) for i in range(n)]
    if cells == "triangles":
        faces = [t for a, b, c, d in faces for t in ([a, b, c], [a, c, d])]
    fixed = [at(0, n), at(n, n)] if fixed is None else fixed
    near = lambda p: f"norm(position - ({p[0]!r}, {p[1]!r}, {p[2]!r})) < 1e-3"
    springs = {"stretch_spring": {"stiffness": 60, "damping": damping},
               "linear_bending_spring": {"stiffness": 10, "damping": damping}}
    if cells == "quads":
        springs["linear_shear_spring"] = {"stiffness": 43, "damping": damping}
    body = {"name": "cloth", "mesh": {"points": placed.tolist(), "cells": faces}, "mass": 0.1,
            "interactions": springs}
    if velocity:
        body["initial"] = [{"velocity": velocity}]
    scene = {"dimension": 2, "rules": ["springs"], "bodies": [body],
             "integrator": {"method": method, "dt": dt}, "duration": duration,
             "output": {"every": every or duration}}
    if gravity is not None:
        scene["gravity"] = [float(x) for x in turn @ np.array(gravity, float)]
    if fixed:
        scene["fix"] = [{"where": " or ".join(near(p) for p in placed[fixed].tolist())}]
    return scene


def rotation(axis, angle):
    x, y, z = np.array(axis) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross


def same_everywhere():
    here = points(run("here", cloth())[0])
    turn = rotation((1, 2, 3), 1.1)
    there = points(run("turned", cloth(turn=turn))[0])
    check("a turned scene gives the turned result", np.abs(there @ turn - here).max(), 1e-10)
    shift = np.array([1e4, -1e4, 1e4])
    moved = points(run("moved", cloth(shift=shift))[0])
    check("a scene 10 km away gives the shifted result", np.abs(moved - shift - here).max(), 1e-7)


def mirror():
    n = 3
    end = points(run("mirror", cloth(dt=1e-3, duration=10))[0])
    at = np.arange((n + 1) ** 2).reshape(n + 1, n + 1)
    twin = end[at[:, ::-1].ravel()]
    twin[:, 0] = 1 - twin[:, 0]
    check("mirror symmetry after 10^4 steps", np.abs(twin - end).max(), 1e-10)


def free_body(method):
    scene = cloth(fixed=[], gravity=None, method=method, dt=1e-3, duration=1.0, every=0.1,
                  damping=0.1, velocity="cross((0.3, 0.2, 1) [1/s], position) + (0.1, 0, 0.2) [m/s]")
    path, _ = run(f"free_{method}", scene)
    momentum = series(path, "momentum")
    scale = np.abs(momentum).max()
    check(f"momentum of a free body, {method}", np.abs(momentum - momentum[0]).max() / scale, 1e-13)
    if method in ("symplectic_euler", "velocity_verlet"):
        angular = series(path, "angular_momentum")
        scale = np.abs(angular).max()
        check(f"angular momentum of a free body, {method}",
              np.abs(angular - angular[0]).max() / scale, 1e-12)


def energy(steps, dt, limit):
    """Energy of the undamped triangle cloth over many steps: no trend over fifths of the run."""
    scale = 0.04404982307148597  # J, the largest kinetic energy of this scene
    scene = cloth(cells="triangles", damping=0, method="velocity_verlet", dt=dt,
                  fixed=[0, 3, 12, 15], duration=steps * dt, every=max(0.05, steps * dt / 20000))
    path, _ = run(f"energy_{steps}", scene)
    total = series(path, "kinetic") + series(path, "potential")
    error = np.abs(total - total[0]) / scale
    check(f"energy of velocity Verlet over {steps} steps of {dt} s", error.max(), limit)
    fifths = [part.max() for part in np.array_split(error, 5)]
    check(f"its worst error, last fifth against first ({steps} steps)", fifths[-1] / fifths[0], 1.5)


def twice():
    hashes = []
    for name, threads in (("once", "1"), ("again", "1"), ("threads", "2")):
        path, _ = run(name, cloth(n=12, dt=2e-4, duration=0.05), extra=("--threads", threads))
        hashes.append(points(path).tobytes())
    check("runs that differ from the first, one of them on two threads",
          sum(other != hashes[0] for other in hashes), 0)


def output_changes_nothing():
    """A force that reads `step` too: the clock may not depend on when frames are written."""
    (FOLDER / "kick.rule").write_text(
        "interaction kick on vertex(a) { param size : real; force a on vertex = (0, 0, 1) [N] * size * step; }")
    ends = []
    for name, every in (("often", 0.001), ("seldom", 0.05)):
        scene = cloth(dt=1e-3, duration=0.05, every=every)
        scene["rules"].append("./kick.rule")
        scene["bodies"][0]["interactions"]["kick"] = {"size": 1e-5}
        ends.append(points(run(name, scene)[0]).tobytes())
    check("runs that differ because frames were written more often", int(ends[0] != ends[1]), 0)


def tearing_cloth(turn=np.eye(3), scale=1.0, tear=None, n=3, cells="quads", order=None, stretch=1, **more):
    """A hanging cloth that tears. `scale` changes the unit of length and of whatever holds one, `order` (a seed) the
    order and the walking direction of its faces and the order in which interactions are declared."""
    scene = cloth(turn=turn, n=n, cells=cells, dt=1e-3, every=more.pop("every", 0.05), **more)
    body = scene["bodies"][0]
    body["mesh"]["points"] = (scale * np.array(body["mesh"]["points"])).tolist()
    scene["gravity"] = [scale * g for g in scene["gravity"]]
    scene["fix"] = [{"where": " or ".join(
        f"norm(position - ({x!r}, {y!r}, {z!r})) < {1e-3 * scale!r}"
        for x, y, z in [body["mesh"]["points"][k] for k in (n * (n + 1), n * (n + 2))])}]
    body["initial"] = [{"position": f"{stretch} * position"}]
    scene["rules"] += ["criteria", "tear"]
    scene["tear"] = [dict(line, threshold=line["threshold"] * (scale if line.pop("is_force") else 1))
                     for line in map(dict, tear)]
    if order is not None:
        random = np.random.default_rng(order)
        faces = [face[::-1] if random.random() < 0.5 else face for face in body["mesh"]["cells"]]
        faces = [np.roll(face, random.integers(len(face))).tolist() for face in faces]
        body["mesh"]["cells"] = [faces[k] for k in random.permutation(len(faces))]
        body["interactions"] = dict(reversed(body["interactions"].items()))
        scene["tear"] = scene["tear"][::-1]
    return scene


def tears(path):
    """(step, place) of everything that tore, the ties of a step in an order of their own."""
    with h5py.File(path) as file:
        events = file["gmsim/events"]
        return [(int(event["step"]), np.array(event["position"], float)) for event in events[:]]


def same_tears(name, got, wanted, back=lambda x: x, within=1e-7):
    """The same steps, and in each the same places, whatever the order of ties."""
    steps = [step for step, _ in got] == [step for step, _ in wanted]
    distance = math.inf
    if steps:
        distance = 0.0
        for step in {step for step, _ in wanted}:
            left = [back(x) for s, x in got if s == step]
            for place in (x for s, x in wanted if s == step):
                nearest = min(range(len(left)), key=lambda k: np.abs(left[k] - place).max())
                distance = max(distance, np.abs(left.pop(nearest) - place).max())
    check(f"{name}: {len(wanted)} tears, same steps, places apart by", distance, within)
    return steps


EQ4 = [{"when": "atomic_facet_force", "threshold": 0.5, "is_force": True, "do": "separate_elements"}]
SEVERAL = [{"when": "facet_traction", "threshold": 22, "is_force": False, "do": "separate_elements"},
           {"when": "spring_elongation", "threshold": 1.12, "is_force": False, "do": "split_edge_ends"},
           {"when": "vertex_force", "threshold": 2, "is_force": True, "do": "split_vertex", "at_most": 2}]


def tears_alike():
    """Quads by one criterion, which has independent references, and triangles by several."""
    for name, tear, cells, n, stretch in (("eq. 4", EQ4, "quads", 3, 1), ("several", SEVERAL, "triangles", 4, 1.1)):
        build = lambda **more: tearing_cloth(tear=tear, cells=cells, n=n, stretch=stretch, duration=0.6, **more)
        path, _ = run("tears", build())
        wanted, end = tears(path), points(path)
        check(f"{name}: scenes that never tear", int(len(wanted) == 0), 0)
        turn = rotation((1, 2, 3), 1.1)
        same_tears(f"{name}, turned", tears(run("tears_turned", build(turn=turn))[0]), wanted, lambda x: x @ turn)
        same_tears(f"{name}, in millimetres", tears(run("tears_mm", build(scale=1000.0))[0]), wanted,
                   lambda x: x / 1000)
        same_tears(f"{name}, two threads", tears(run("tears_2", build(), extra=("--threads", "2"))[0]), wanted,
                   within=0)
        same_tears(f"{name}, frames at other times", tears(run("tears_often", build(every=0.007))[0]), wanted,
                   within=0)
        for order in (1, 2):
            path, _ = run("tears_order", build(order=order))
            check(f"{name}, declared in order {order}: steps that differ",
                  int([step for step, _ in tears(path)] != [step for step, _ in wanted]), 0)
            apart = np.abs(points(path)[:, None] - end[None]).max(axis=2)
            check(f"{name}, declared in order {order}: particles at the end apart by",
                  max(apart.min(axis=0).max(), apart.min(axis=1).max()), 1e-6)


def above_the_limit():
    path, text = run("unstable", cloth(dt=0.1, method="rk4"), expect=2)
    words = [word for word in ("0.1", "limit", "_spring` at vertex") if word not in text]
    check("what the message of a step above the limit leaves out " + ", ".join(words), len(words), 0)
    scene = cloth(dt=0.0135, method="rk4", duration=20)
    scene["integrator"]["on_unstable"] = "warn"
    path, text = run("blow_up", scene, expect=1)
    for candidate in (path, pathlib.Path(str(path) + ".part")):
        if candidate.exists():
            with h5py.File(candidate) as file:
                check("numbers in the file of a blown-up run that are not finite",
                      int((~np.isfinite(file["VTKHDF/Points"][:])).sum()), 0)


same_everywhere()
mirror()
for name in ("symplectic_euler", "velocity_verlet", "rk4", "bogacki_shampine", "dormand_prince"):
    free_body(name)
twice()
output_changes_nothing()
above_the_limit()
tears_alike()
energy(20000, 1e-3, 7.4e-4)
if SLOW:
    energy(100000, 1e-3, 7.5e-4)
    energy(25000, 4e-3, 1.6e-2)
    energy(1000000, 1e-3, 1e-3)
sys.exit(1 if failures else 0)
