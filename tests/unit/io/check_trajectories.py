# SPDX-License-Identifier: MIT
"""check_trajectories.py WRITE_TRAJECTORY_SAMPLES: the samples hold what was to be written (h5py against the
JSON beside them), and VTK reads what h5py reads, there and in the exported .vtu."""

import json
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

import h5py
import numpy as np
import vtk

from check_vtkhdf import Failure, RawTrajectory, check_file, check_grid, require


def field_of(raw, name, step, frame):
    rows = {"PointData": len(frame["points"]), "CellData": len(frame["cells"])}
    for place, count in rows.items():
        if name in raw.root[place]:
            return raw.data(place, step, count)[name]
    if name in raw.root["FieldData"]:
        return raw.field_data(step)[name]
    group = raw.file[f"gmsim/fields/{name}"]
    first, count = int(group["offsets"][step]), int(group["counts"][step])
    require(list(group["darts"][first : first + count]) == frame["darts"], f"step {step}: darts of {name}")
    return group["values"][first : first + count]


def check_frame(raw, step, frame):
    mesh = raw.mesh(step)
    require(raw.steps["Values"][step] == frame["time"], f"step {step}: time")
    require(raw.file["gmsim/frame_steps"][step] == frame["step"], f"step {step}: step")
    require(np.array_equal(mesh["points"], np.reshape(frame["points"], (-1, 3))), f"step {step}: points")
    require([list(map(int, cell)) for cell in mesh["cells"]] == frame["cells"], f"step {step}: cells")
    for name, values in frame["fields"].items():
        found = np.ravel(field_of(raw, name, step, frame)).astype(float)
        require(np.array_equal(found, values), f"step {step}: {name}")


def check_gmsim_group(raw, frames):
    group = raw.file["gmsim"]
    require(group.attrs["format"] == b"gmsim-trajectory" and group.attrs["complete"] == 1, "attributes")
    require(group["scene"][()].decode().startswith("dimension: 2  # größer"), "scene")
    require(group["rules/springs"].attrs["path"] == b"stdlib-rules/springs.rule", "rules")
    events = group["events"]
    require(list(events["frame"]) == [i for i, f in enumerate(frames) for _ in range(f["events"])], "events")
    require(events.dtype["position"].shape == (3,) and events.dtype.itemsize == 92, "events are packed")
    reports = [report for frame in frames for report in frame["reports"]]
    require(np.array_equal(group["series/step"][:], [r[0] for r in reports]), "series/step")
    require(np.array_equal(group["series/momentum"][:], [r[2:] for r in reports]), "series/momentum")
    extents = group["extents"]
    for name, rows in zip(extents.attrs["names"], extents[-1]):
        require(len(raw.file[name.decode()]) == rows, f"extents: {name.decode()}")
    types = raw.root.attrs["Type"]
    require(h5py.h5a.open(raw.root.id, b"Type").dtype == np.dtype("S16") and types == b"UnstructuredGrid", "Type")
    has_polyhedra = "NumberOfFaces" in raw.root and raw.root["NumberOfFaces"][:].any()
    require(list(raw.root.attrs["Version"]) == ([2, 5] if has_polyhedra else [2, 0]), "Version")


def check_export(raw, folder):
    """The exported .vtu hold the same frames, and the .pvd has their times."""
    collection = xml.etree.ElementTree.parse(folder / f"{folder.name}.pvd").getroot()
    entries = list(collection.iter("DataSet"))
    require([float(e.get("timestep")) for e in entries] == list(raw.steps["Values"]), "times in the .pvd")
    for step, entry in enumerate(entries):
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(folder / entry.get("file")))
        reader.Update()
        mesh = raw.mesh(step)
        check_grid(reader.GetOutput(), raw, mesh, step)


def main():
    polyhedra = vtk.vtkVersion().GetVTKMajorVersion() * 100 + vtk.vtkVersion().GetVTKMinorVersion() >= 906
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.argv[1], folder], check=True)
        samples = sorted(pathlib.Path(folder).glob("*.vtkhdf"))
        require(len(samples) == 5, "five samples")
        for path in samples:
            frames = json.loads(path.with_suffix(".json").read_text())
            raw = RawTrajectory(path)
            require(raw.count == len(frames), "number of frames")
            for step, frame in enumerate(frames):
                check_frame(raw, step, frame)
            check_gmsim_group(raw, frames)
            check_export(raw, path.with_suffix(""))
            raw.close()
            if polyhedra or path.stem != "polyhedra":
                check_file(path)
    print(f"{len(samples)} files hold what was written, and VTK {vtk.vtkVersion.GetVTKVersion()} reads it")


try:
    main()
except Failure as failure:
    sys.exit(f"FAILED: {failure}")
