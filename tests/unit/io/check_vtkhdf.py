# SPDX-License-Identifier: MIT
"""check_vtkhdf.py FILES...: every step of every file, read forwards, backwards and at random by
VTK's own reader and compared, value by value, with the slices that h5py takes from the tables. Exit code 1
at the first difference. Import as a module for `check_file` and `RawTrajectory`."""

import random
import sys

import h5py
import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy


class RawTrajectory:
    """Frames straight from the tables, by the arithmetic of the VTKHDF specification."""

    def __init__(self, path):
        self.file = h5py.File(path, "r")
        self.root = self.file["VTKHDF"]
        self.steps = self.root["Steps"]
        self.count = int(self.steps.attrs["NSteps"])

    def close(self):
        self.file.close()

    def at(self, name, step):
        return int(np.ravel(self.steps[name][step])[0])

    def mesh(self, step):
        root, part = self.root, self.at("PartOffsets", step)
        points, cells = int(root["NumberOfPoints"][part]), int(root["NumberOfCells"][part])
        ids = int(root["NumberOfConnectivityIds"][part])
        first_point, first_cell = self.at("PointOffsets", step), self.at("CellOffsets", step)
        first_id = self.at("ConnectivityIdOffsets", step)
        offsets = root["Offsets"][first_cell + part : first_cell + part + cells + 1]
        connectivity = root["Connectivity"][first_id : first_id + ids]
        return {
            "points": root["Points"][first_point : first_point + points],
            "types": root["Types"][first_cell : first_cell + cells],
            "cells": [connectivity[a:b] for a, b in zip(offsets[:-1], offsets[1:])],
            "faces": self.faces(step, part, cells, first_cell),
        }

    def faces(self, step, part, cells, first_cell):
        root = self.root
        if "NumberOfFaces" not in root:
            return [[] for _ in range(cells)]
        faces = int(root["NumberOfFaces"][part])
        first = self.at("FaceOffsetsOffsets", step) + part
        offsets = root["FaceOffsets"][first : first + faces + 1]
        first = self.at("FaceConnectivityOffsets", step)
        ids = root["FaceConnectivity"][first : first + int(root["NumberOfFaceConnectivityIds"][part])]
        first = self.at("PolyhedronToFaceIdOffsets", step)
        numbers = root["PolyhedronToFaces"][first : first + int(root["NumberOfPolyhedronToFaceIds"][part])]
        ends = root["PolyhedronOffsets"][first_cell + part : first_cell + part + cells + 1]
        return [[ids[offsets[f] : offsets[f + 1]] for f in numbers[a:b]] for a, b in zip(ends[:-1], ends[1:])]

    def data(self, place, step, rows):
        """place: "PointData" or "CellData"."""
        first = {name: self.at(f"{place}Offsets/{name}", step) for name in self.root[place]}
        return {name: self.root[place][name][a : a + rows] for name, a in first.items()}

    def field_data(self, step):
        result = {}
        for name in self.root["FieldData"]:
            first = self.at(f"FieldDataOffsets/{name}", step)
            result[name] = self.root["FieldData"][name][first : first + 1]
        return result


class Failure(Exception):
    pass


def require(condition, what):
    if not condition:
        raise Failure(what)


def grid_of(reader):
    output = reader.GetOutputDataObject(0)
    while not output.IsA("vtkUnstructuredGrid"):
        require(output.IsA("vtkPartitionedDataSet") and output.GetNumberOfPartitions() == 1, "one grid")
        output = output.GetPartition(0)
    return output


def check_cells(grid, mesh, step):
    # A mesh without cells has -1 of them for VTK 9.5 and 9.6.
    require(max(grid.GetNumberOfCells(), 0) == len(mesh["cells"]), f"step {step}: number of cells")
    stream, ids = vtk.vtkIdList(), vtk.vtkIdList()
    for i, (kind, cell) in enumerate(zip(mesh["types"], mesh["cells"])):
        require(grid.GetCellType(i) == kind, f"step {step}: type of cell {i}")
        if kind == 42:
            grid.GetFaceStream(i, stream)
            wanted = [len(mesh["faces"][i])]
            for face in mesh["faces"][i]:
                wanted += [len(face), *face]
            found = [stream.GetId(k) for k in range(stream.GetNumberOfIds())]
            require(found == [int(x) for x in wanted], f"step {step}: faces of cell {i}")
        else:
            grid.GetCellPoints(i, ids)
            found = [ids.GetId(k) for k in range(ids.GetNumberOfIds())]
            require(found == [int(x) for x in cell], f"step {step}: corners of cell {i}")


def check_arrays(found, expected, step):
    for name, values in expected.items():
        array = found.GetArray(name)
        require(array is not None, f"step {step}: {name} is missing")
        if not values.size and not array.GetNumberOfTuples():
            continue
        read = vtk_to_numpy(array)
        require(read.dtype.kind == values.dtype.kind and read.itemsize == values.itemsize, f"step {step}: type of {name}")
        require(np.array_equal(read.reshape(values.shape), values, equal_nan=True), f"step {step}: {name}")


def check_grid(grid, raw, mesh, step):
    points = vtk_to_numpy(grid.GetPoints().GetData()) if len(mesh["points"]) else mesh["points"]
    require(points.dtype == np.float64 and np.array_equal(points, mesh["points"]), f"step {step}: points")
    check_cells(grid, mesh, step)
    check_arrays(grid.GetPointData(), raw.data("PointData", step, len(mesh["points"])), step)
    check_arrays(grid.GetCellData(), raw.data("CellData", step, len(mesh["cells"])), step)


def check_step(reader, raw, step):
    reader.SetStep(step)
    reader.Update()
    grid = grid_of(reader)
    check_grid(grid, raw, raw.mesh(step), step)
    check_arrays(grid.GetFieldData(), raw.field_data(step), step)


def check_times(reader, raw):
    executive = reader.GetExecutive()
    info = executive.GetOutputInformation(0)
    key = vtk.vtkStreamingDemandDrivenPipeline.TIME_STEPS()
    if raw.count == 1 and not info.Has(key):
        return  # a file of one frame counts as static
    times = [info.Get(key, i) for i in range(info.Length(key))]
    require(np.array_equal(times, raw.steps["Values"][:]), "times")


def check_file(path, orders=3):
    raw = RawTrajectory(path)
    try:
        require(len(raw.steps["Values"]) == raw.count, "as many times as steps")
        reader = vtk.vtkHDFReader()
        reader.SetFileName(str(path))
        reader.UpdateInformation()
        require(reader.GetNumberOfSteps() == raw.count or raw.count == 1, "number of steps")
        check_times(reader, raw)
        forward = list(range(raw.count))
        shuffled = random.Random(raw.count).choices(forward, k=raw.count)
        for order in [forward, forward[::-1], shuffled][:orders]:
            for step in order:
                check_step(reader, raw, step)
        return raw.count
    finally:
        raw.close()


def main():
    steps = 0
    for path in sys.argv[1:]:
        try:
            steps += check_file(path)
        except Failure as failure:
            sys.exit(f"FAILED: {path}: {failure}")
    print(f"{len(sys.argv) - 1} files, {steps} steps: VTK {vtk.vtkVersion.GetVTKVersion()} reads what h5py reads")


if __name__ == "__main__":
    main()
