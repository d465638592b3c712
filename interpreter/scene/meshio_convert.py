# Run by gmsim as `python3 -c`: converts argv[1], any format of meshio, to argv[2] + ".msh", or to
# argv[2] + ".obj" when it has polygons. Lines that begin with "gmsim: " are shown to the user.
import sys

sys.path = [folder for folder in sys.path if folder not in ("", ".")]
try:
    import meshio
    import numpy
except ImportError:
    sys.exit(42)

source, target = sys.argv[1:3]
mesh = meshio.read(source)
mesh.points = numpy.asarray(mesh.points, dtype=float)
if mesh.points.shape[1] == 2:
    mesh.points = numpy.column_stack([mesh.points, numpy.zeros(len(mesh.points))])


def usable(name, blocks):
    arrays = [numpy.asarray(block) for block in blocks]
    if all(a.dtype.kind in "iufb" and a.ndim <= 2 and numpy.isfinite(a).all() for a in arrays):
        return True
    print(f"gmsim: data `{name}` is not made of finite numbers and is left out")
    return False


regions = [numpy.zeros(len(block.data), dtype=int) for block in mesh.cells]
for key in ("gmsh:physical", "medit:ref", "cell_tags"):
    if key in mesh.cell_data:
        regions = [numpy.asarray(block).astype(int) for block in mesh.cell_data.pop(key)]
        break
names = {name: value for name, value in mesh.field_data.items() if numpy.size(value) == 2}
number = max([0] + [int(block.max()) for block in regions if len(block)])
for name, members in mesh.cell_sets.items():
    if name.startswith("gmsh:"):
        continue
    number += 1
    for region, block, cells in zip(regions, mesh.cells, members):
        if cells is None or len(cells) == 0:
            continue
        names[f"{name}"] = [number, block.dim]
        cells = numpy.asarray(cells, dtype=int)
        region[cells[region[cells] == 0]] = number

polygons = any(block.type == "polygon" for block in mesh.cells)
if polygons:
    if mesh.point_data or mesh.cell_data:
        print("gmsim: data on points and cells is left out, because the mesh has polygons")
    with open(target + ".obj", "w") as out:
        for point in mesh.points:
            out.write("v %r %r %r\n" % tuple(float(x) for x in point))
        for block, region in zip(mesh.cells, regions):
            if block.dim != 2:
                print(f"gmsim: {len(block.data)} cells of type {block.type} are left out")
                continue
            for cell, group in zip(block.data, region):
                out.write("g region_%d\n" % group if group else "g\n")
                out.write("f " + " ".join(str(int(corner) + 1) for corner in cell) + "\n")
    sys.exit(0)

point_data = {n: v for n, v in mesh.point_data.items() if n != "gmsh:dim_tags" and usable(n, [v])}
cell_data = {n: v for n, v in mesh.cell_data.items() if not n.startswith("gmsh:") and usable(n, v)}
cell_data["gmsh:physical"] = regions
cell_data["gmsh:geometrical"] = [numpy.zeros_like(region) for region in regions]
result = meshio.Mesh(mesh.points, mesh.cells, point_data=point_data, cell_data=cell_data)
result.field_data = {name.replace('"', "'"): numpy.asarray(value) for name, value in names.items()}
meshio.write(target + ".msh", result, file_format="gmsh22")
