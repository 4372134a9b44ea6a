"""Reads made-up records (tests/record_sample.c) as VTK does: the .vtkhdf with vtkHDFReader, the .xdmf with VTK's XDMF
reader where this build of VTK has one (Debian's has not: there the description is compared item by item with what
vtkHDFReader found in the file it points to).

Usage: vtk_reader.py FOLDER. Exit code 77: VTK for Python is not installed.
"""

import os
import sys
import xml.etree.ElementTree as ElementTree

try:
    from vtkmodules.vtkIOHDF import vtkHDFReader
except ImportError as missing:
    print(f"skipped: VTK for Python is not here ({missing}); Debian's package is python3-vtk9")
    sys.exit(77)

POINTS, CELLS, VTK_TYPE = {1: 3, 2: 12, 3: 60}, {1: 2, 2: 6, 3: 24}, {1: 3, 2: 9, 3: 12}
WIDTH = {"F": 9, "H": 9, "J": 1, "P": 9, "displacement": 3, "momentum": 3, "pressure": 1, "sigma": 9, "tags": 1,
         "velocity": 3, "volume": 1, "von_mises": 1}
failures = []
checks = 0


def check(what, holds):
    global checks
    checks += 1
    if not holds:
        failures.append(what)


def near(value, expected):
    return abs(value - expected) <= 1e-14 * max(1.0, abs(expected))


def check_values(where, dim, grid):
    """The formulas of tests/unit/body.h, written a second time."""
    data = grid.GetPointData()
    field = {name: [data.GetArray(name).GetTuple(a) for a in range(POINTS[dim])] for name in WIDTH}
    points = [[0.5 * i, 0.5 * j, 0.5 * k] for k in range(5 if dim > 2 else 1) for j in range(4 if dim > 1 else 1)
              for i in range(3)]
    for a, X in enumerate(points):
        G = [[1e-3 * (1 + i + 2 * j) * (1 + 0.1 * X[0]) if max(i, j) < dim else 0.0 for j in range(3)]
             for i in range(3)]
        u = [sum(G[i][j] * X[j] for j in range(dim)) for i in range(3)]
        v = [10 * u[i] + 0.5 if i < dim else 0.0 for i in range(3)]
        trace = sum(G[i][i] for i in range(3))
        expected = {
            "F": [G[i][j] + (i == j) for i in range(3) for j in range(3)],
            "H": [(1 + trace if i >= dim else 1) * (i == j) - G[i][j] for i in range(3) for j in range(3)],
            "P": [1e6 * G[i][j] + (3e5 + a) * (i == j >= dim) for i in range(3) for j in range(3)],
            "sigma": [5e5 * G[i][j] + (4e5 + a) * (i == j >= dim) for i in range(3) for j in range(3)],
            "J": [1 + trace], "displacement": u, "velocity": v, "momentum": [1100 * w for w in v],
            "pressure": [1e6 * trace / 3], "von_mises": [2e6 * trace], "volume": [0.125 + 0.001 * a], "tags": [a % 64],
        }
        check(f"{where}: point {a}", list(grid.GetPoint(a)) == X)
        for name, row in expected.items():
            check(f"{where}: {name} of particle {a}", all(near(got, want) for got, want in zip(field[name][a], row)))


def check_grid(where, dim, grid):
    data = grid.GetPointData()
    names = {data.GetArrayName(i) for i in range(data.GetNumberOfArrays())}
    check(f"{where}: {grid.GetNumberOfPoints()} points", grid.GetNumberOfPoints() == POINTS[dim])
    check(f"{where}: {grid.GetNumberOfCells()} cells", grid.GetNumberOfCells() == CELLS[dim])
    check(f"{where}: fields {sorted(names)}", names == set(WIDTH))
    if failures:
        return
    for name, width in WIDTH.items():
        check(f"{where}: width of {name}", data.GetArray(name).GetNumberOfComponents() == width)
    edge = [0.5 * (axis < dim) for axis in range(3)]
    for c in range(CELLS[dim]):
        kinds = (VTK_TYPE[dim],) if where.endswith(".vtkhdf") else (VTK_TYPE[dim], 4)  # XDMF's polyline is VTK's too
        check(f"{where}: type of cell {c}", grid.GetCellType(c) in kinds)
        bounds = grid.GetCell(c).GetBounds()
        check(f"{where}: extent of cell {c}", all(near(bounds[2 * i + 1] - bounds[2 * i], edge[i]) for i in range(3)))
    check_values(where, dim, grid)


def check_description(path, dim, grid):
    """Every item of the XDMF points to an array of the right name, size and type in the record."""
    data, items = grid.GetPointData(), {}
    top = ElementTree.parse(path).getroot().find("Domain/Grid")
    check(f"{path}: name", top.get("Name") == f'made & <up> "{dim}D"')
    check(f"{path}: time", float(top.find("Time").get("Value")) == 0.25)
    check(f"{path}: cells", int(top.find("Topology").get("NumberOfElements")) == CELLS[dim])
    hdf5 = os.path.basename(path).replace(".xdmf", ".vtkhdf")
    for item in top.iter("DataItem"):
        file, _, inside = item.text.strip().partition(":")
        check(f"{path}: file {file}", file == hdf5)
        items[inside] = ([int(n) for n in item.get("Dimensions").split()], item.get("NumberType"), item.get("Precision"))
    expected = {"/VTKHDF/Points": ([POINTS[dim], 3], "Float", "8"),
                "/VTKHDF/Connectivity": ([CELLS[dim] * 2**dim], "Int", "8")}
    for name, width in WIDTH.items():
        shape = [POINTS[dim]] if width == 1 else [POINTS[dim], width]
        kind = {"double": ("Float", "8"), "unsigned int": ("UInt", "4")}[data.GetArray(name).GetDataTypeAsString()]
        expected[f"/VTKHDF/PointData/{name}"] = (shape, *kind)
    check(f"{path}: items {items}", items == expected)
    shapes = {a.get("Name"): a.get("AttributeType") for a in top.iter("Attribute")}
    check(f"{path}: shapes", shapes == {n: {1: "Scalar", 3: "Vector", 9: "Tensor"}[w] for n, w in WIDTH.items()})


def xdmf_readers():
    readers = []
    for module, name in (("vtkIOXdmf2", "vtkXdmfReader"), ("vtkIOXdmf3", "vtkXdmf3Reader")):
        try:
            readers.append(getattr(__import__(f"vtkmodules.{module}", fromlist=[name]), name))
        except ImportError:
            pass
    return readers


def main(folder):
    readers = xdmf_readers()
    for dim in (1, 2, 3):
        path = os.path.join(folder, f"made-up-{dim}d.vtkhdf")
        hdf = vtkHDFReader()
        check(f"{path}: readable", hdf.CanReadFile(path) == 1)
        hdf.SetFileName(path)
        hdf.Update()
        check_grid(path, dim, hdf.GetOutputDataObject(0))
        time = hdf.GetOutputDataObject(0).GetFieldData().GetArray("TimeValue")
        check(f"{path}: time", time is not None and time.GetValue(0) == 0.25)
        xdmf = path.replace(".vtkhdf", ".xdmf")
        if not failures:
            check_description(xdmf, dim, hdf.GetOutputDataObject(0))
        for kind in readers:
            reader = kind()
            reader.SetFileName(xdmf)
            reader.Update()
            check_grid(xdmf, dim, reader.GetOutputDataObject(0))
    for failure in failures:
        print(f"failed: {failure}")
    print(f"{checks} checks, {len(failures)} failed; XDMF readers: {[kind.__name__ for kind in readers] or 'none here'}")
    return 1 if failures or checks < 1000 else 0


sys.exit(main(sys.argv[1]))
