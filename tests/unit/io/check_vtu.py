# SPDX-License-Identifier: MIT
"""check_vtu.py WRITE_VTU_SAMPLES: every value of the samples, read by VTK and by meshio."""

import json
import pathlib
import subprocess
import sys
import tempfile

import meshio
import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

MESHIO_TYPES = {"vertex": 1, "line": 3, "triangle": 5, "polygon": 7, "quad": 9, "tetra": 10,
                "hexahedron": 12, "wedge": 13, "pyramid": 14}


def check(condition, what):
    if not condition:
        sys.exit(f"FAILED: {what}")


def check_arrays(expected, get, name):
    for array, (components, values) in expected.items():
        found = np.asarray(get(array), dtype=float).reshape(-1)
        check(np.array_equal(found, np.asarray(values, dtype=float)), f"{name}: {array}")
        if len(values):
            check(len(found) % components == 0, f"{name}: components of {array}")


def check_with_vtk(path, expected):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    points = vtk_to_numpy(grid.GetPoints().GetData())
    check(np.array_equal(points, np.asarray(expected["points"])), f"{path.name}: points")
    check(grid.GetNumberOfCells() == len(expected["types"]), f"{path.name}: cells")
    for i, kind in enumerate(expected["types"]):
        check(grid.GetCellType(i) == kind, f"{path.name}: type of cell {i}")
        if kind == 42:
            stream = vtk.vtkIdList()
            grid.GetFaceStream(i, stream)
            flat = [stream.GetId(k) for k in range(stream.GetNumberOfIds())]
            wanted = [len(expected["faces"][i])]
            for face in expected["faces"][i]:
                wanted += [len(face)] + face
            check(flat == wanted, f"{path.name}: faces of cell {i}")
        else:
            ids = grid.GetCell(i).GetPointIds()
            found = [ids.GetId(k) for k in range(ids.GetNumberOfIds())]
            check(found == expected["cells"][i], f"{path.name}: corners of cell {i}")
    for data, source in (("point_data", grid.GetPointData()), ("cell_data", grid.GetCellData())):
        check_arrays(expected[data], lambda a: vtk_to_numpy(source.GetArray(a)), path.name)
        for array, (components, _) in expected[data].items():
            check(source.GetArray(array).GetNumberOfComponents() == components, f"{path.name}: {array}")
    time = grid.GetFieldData().GetArray("TimeValue").GetValue(0)
    check(time == expected["time"], f"{path.name}: time")


def check_with_meshio(path, expected):
    """meshio sorts cells into blocks of one type, in order, and turns the wedges of VTK files round
    (VTK did so too before 9.7)."""
    mesh = meshio.read(path)
    check(np.array_equal(mesh.points, np.asarray(expected["points"])), f"{path.name}: points (meshio)")
    cells = []
    for block in mesh.cells:
        data = block.data[:, [0, 2, 1, 3, 5, 4]] if block.type == "wedge" else block.data
        cells += [(MESHIO_TYPES[block.type], list(map(int, cell))) for cell in data]
    check(cells == list(zip(expected["types"], expected["cells"])), f"{path.name}: cells (meshio)")
    check_arrays(expected["point_data"], lambda a: mesh.point_data[a], path.name)
    check_arrays(expected["cell_data"], lambda a: np.concatenate([np.atleast_1d(b) for b in mesh.cell_data[a]]),
                 path.name)


def main():
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.argv[1], folder], check=True)
        samples = sorted(pathlib.Path(folder).glob("*.vtu"))
        check(len(samples) == 6, "six samples")
        for path in samples:
            expected = json.loads(path.with_suffix(".json").read_text())
            check_with_vtk(path, expected)
            if 42 not in expected["types"] and expected["types"]:
                check_with_meshio(path, expected)
    print(f"{len(samples)} samples read alike")


main()
