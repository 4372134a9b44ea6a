"""judge_vtk.py PROGRAM FOLDER: VTU files as VTK itself writes them, in every encoding it has, judged against the oracle
that their values come from. Exit code 77 where Python has no VTK."""
import csv
import itertools
import os
import subprocess
import sys

try:
    from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkFloatArray, vtkPoints
    from vtkmodules.vtkCommonDataModel import VTK_VERTEX, vtkUnstructuredGrid
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter
except ImportError:
    sys.exit(77)

PROGRAM, FOLDER = sys.argv[1:]
EXACT = os.path.join(FOLDER, "exact.csv")
TIME = "2e-3"


def table():
    subprocess.run([PROGRAM, "oracle", "swinging-cube", "--typical", "--grid", "0:1:7,0:1:7,0:1:7", "--time", TIME, "-o",
                    EXACT], check=True, stdout=subprocess.DEVNULL)
    with open(EXACT, encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return rows


def array(rows, name, columns, single):
    made = (vtkFloatArray if single else vtkDoubleArray)()
    made.SetName(name)
    made.SetNumberOfComponents(len(columns))
    made.SetNumberOfTuples(len(rows))
    for a, row in enumerate(rows):
        made.SetTuple(a, [float(row[column]) for column in columns])
    return made


def grid(rows, single):
    made, points = vtkUnstructuredGrid(), vtkPoints()
    points.SetData(array(rows, "Points", ["X[m]", "Y[m]", "Z[m]"], single))
    made.SetPoints(points)
    for a in range(len(rows)):
        made.InsertNextCell(VTK_VERTEX, 1, [a])
    pairs = [i + j for i in "xyz" for j in "xyz"]
    made.GetPointData().AddArray(array(rows, "displacement", [f"u_{i}[m]" for i in "xyz"], single))
    made.GetPointData().AddArray(array(rows, "P", [f"P_{ij}[Pa]" for ij in pairs], single))
    time = vtkDoubleArray()
    time.SetName("TimeValue")
    time.InsertNextValue(float(TIME))
    made.GetFieldData().AddArray(time)
    return made


def main():
    os.makedirs(FOLDER, exist_ok=True)
    rows, path = table(), os.path.join(FOLDER, "vtk.vtu")
    grids = [grid(rows, single) for single in (0, 1)]
    count = 0
    for mode, packed, wide, big in itertools.product(("Ascii", "Binary", "Raw", "Base64"), (0, 1), (0, 1), (0, 1)):
        single = count % 3 == 0
        writer = vtkXMLUnstructuredGridWriter()
        writer.SetFileName(path)
        writer.SetInputData(grids[single])
        getattr(writer, "SetDataModeToAppended" if mode in ("Raw", "Base64") else "SetDataModeTo" + mode)()
        writer.SetEncodeAppendedData(mode == "Base64")
        writer.SetCompressorTypeToZLib() if packed else writer.SetCompressorTypeToNone()
        writer.SetHeaderTypeToUInt64() if wide else writer.SetHeaderTypeToUInt32()
        writer.SetByteOrderToBigEndian() if big else writer.SetByteOrderToLittleEndian()
        writer.SetBlockSize(4096)
        writer.Write()
        bound = "1e-6" if single else "1e-10" if mode == "Ascii" else "0"
        run = subprocess.run([PROGRAM, "judge", path, "--oracle", "swinging-cube", "--typical", "--gate", f"u={bound}",
                              "--gate", f"P_all={bound}"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if run.returncode != 0 or "PASS: all gates hold" not in run.stdout:
            sys.exit(f"FAIL: {mode}, single {single}, packed {packed}, wide {wide}, big {big}: {run.stdout[-900:]}")
        count += 1
    print(f"{count} files of VTK's read")


main()
