"""judge_malformed.py PROGRAM SAMPLES FOLDER: files that are damaged, cut short, inconsistent or no results at all, at
least 50 of each format and 200 in all, made from right ones (judge_sample.c) by known edits and by changes of bytes. Each
must end with exit code 2 and a message that names the file. Nothing may crash, and no sanitizer may speak but within the
HDF5 library, which does crash on some damaged files, in a process of its own."""
import concurrent.futures
import os
import random
import re
import subprocess
import sys

PROGRAM, SAMPLES, FOLDER = sys.argv[1:]
WANTED, BATCH = 48, 12
SANITIZER = re.compile(r"ERROR: (Address|Leak|UndefinedBehavior)Sanitizer|runtime error:")
CONTROL = re.compile(r"[\x00-\x09\x0b-\x1f\x7f]")  # what a terminal obeys
IN_HDF5 = re.compile(r"^ *#[0-4] .*libhdf5", re.M)
LOST = "did not survive"

lost = []  # files on which the library did crash

CSV = [  # (from, to): regular expression and what takes its place, once
    (r"X\[m\]", "X"), (r"X\[m\]", "X[s]"), (r"X\[m\]", "X[inch]"), (r"Z\[m\]", "Z[mm]"), (r"X\[m\],Y\[m\]", "Y[m],X[m]"),
    (r"X\[m\]", "A[m]"), (r"Z\[m\]", "Y[m]"), (r"u_x\[m\]", "u_x[Pa]"), (r"u_x\[m\]", "u_x"), (r"u_y\[m\]", "u_x[m]"),
    (r"p_x\[[^]]*\]", "p_x[kg]"), (r"P_xx\[Pa\]", "P_xx[psi]"), (r"P_yy\[Pa\]", "P_yy[MPa]"), (r"time = \S+ s", "time = soon"),
    (r"# time = \S+ s", "#"), (r"time = \S+ s", "time = 2e-3 kg"), (r"time = \S+ s", "time = nan s"),
    (r"time = \S+ s", "time = 1e999 s"), (r"h = \S+ m", "h = 0 m"), (r"h = \S+ m", "h = -1 m"), (r"h = \S+ m", "h = 1 s"),
    (r"\n0,0,0,", "\nnan,0,0,"), (r"\n0,0,0,", "\n-0.1,0,0,"), (r"\n0,0,0,", "\n1e300,0,0,"), (r"\n0,0,0,", "\n0,0,"),
    (r"\n0,0,0,", "\n0,0,0,0,"), (r"\n0,0,0,", "\n0,0,,"), (r"\n0,0,0,", "\n0;0;0,"), (r"\n0,0,0,", "\n0 0,0,0,"),
    (r"\n0,0,0,", "\nzero,0,0,"), (r"\n0,0,0,", "\n0x,0,0,"), (r",weight", ",weight,weight"), (r",weight", ",volume,extra"),
    (r",weight\n(.*),\S+\n", r",weight\n\1,-1\n"), (r",weight\n(.*),\S+\n", r",weight\n\1,inf\n"),
    (r",weight", ",t[s]"), (r"X\[m\]", ""), (r"X\[m\]", "X" * 100 + "[m]"), (r"u_x\[m\]", "u_x[" + "m" * 100 + "]"),
    (r"\n0,0,0,", "\n\0,0,0,"), (r"X\[m\]", "\x1b[2JX[m]"), (r"X\[m\]", "X[\x1b[2J]"), (r"time = \S+ s", "time = \x1b[2J"),
]
VTU = [
    (r"<VTKFile", "<VTUFile"), (r"UnstructuredGrid", "PolyData"), (r"LittleEndian", "Middle"), (r"NumberOfPoints=\"27\"", ""),
    (r"NumberOfPoints=\"27\"", "NumberOfPoints=\"28\""), (r"NumberOfPoints=\"27\"", "NumberOfPoints=\"26\""),
    (r"NumberOfPoints=\"27\"", "NumberOfPoints=\"0\""), (r"NumberOfPoints=\"27\"", "NumberOfPoints=\"-27\""),
    (r"NumberOfPoints=\"27\"", "NumberOfPoints=\"18446744073709551615\""), (r"NumberOfPoints=\"27\"", "NumberOfPoints=\"4e9\""),
    (r"NumberOfPoints=\"27\"", "NumberOfPoints=\"1152921504606846975\""), (r"<Points>", "<Places>"), (r"</Points>", ""),
    (r"<Points>(.|\n)*</Points>", ""), (r"<Points>(.|\n)*</Points>", "<Points/>"), (r"</Piece>", "</Piece><Piece/>"),
    (r"NumberOfComponents=\"3\"", "NumberOfComponents=\"2\""), (r"NumberOfComponents=\"9\"", "NumberOfComponents=\"0\""),
    (r"NumberOfComponents=\"9\"", "NumberOfComponents=\"4294967297\""), (r"Name=\"u\"", "Name=\"P\""),
    (r"Name=\"u\"", "Name=\"\""), (r"Name=\"u\"", "Name=\"displacement [Pa]\""), (r"Name=\"u\"", "Name=\"u\" unit=\"inch\""),
    (r"Name=\"u\"", "Name=\"u\" Name=\"v\""), (r"Name=\"u\"", "Name=\"" + "u" * 1000 + "\""), (r"Name=\"u\"", "Name=\"velocity"),
    (r"Name=\"u\"", "Name=\"p\""), (r"Name=\"p\"", "Name=\"momentum [s]\""), (r"Float64", "Float128"), (r"Float64", ""),
    (r"format=\"ascii\"", "format=\"binary\""), (r"format=\"ascii\"", "format=\"appended\" offset=\"0\""),
    (r"format=\"ascii\"", "format=\"appended\" offset=\"-1\""), (r"format=\"ascii\"", ""), (r"TimeValue", "Clock"),
    (r"TimeValue\"", "TimeValue\" unit=\"m\""), (r"Name=\"h\"", "Name=\"n\""), (r"\n0 0 0\n", "\n0 0 x\n"),
    (r"\n0 0 0\n", "\n0 0 nan\n"), (r"\n0 0 0\n", "\n0 0 -1\n"), (r"\n0 0 0\n", "\n0 0\n"), (r"\n0 0 0\n", "\n0 0 0 0\n"),
    (r"\n0 0 0\n", "\n0 0 1e400\n"), (r"<\?xml version=\"1.0\"\?>", "<!DOCTYPE a [<!ENTITY b \"c\">]>"),
    (r"</UnstructuredGrid>", "<AppendedData encoding=\"raw\">_"), (r"</VTKFile>", "</VTKFile></VTKFile>"),
    (r"version=\"0.1\"", "version=\"0.1\" compressor=\"vtkLZMADataCompressor\""),
    (r"version=\"0.1\"", "version=\"0.1\" header_type=\"UInt8\""), (r"<PointData>(.|\n)*</PointData>", ""),
    (r"<PointData>(.|\n)*</PointData>", "<PointData>"),
]
OTHERS = [b"", b"\n", b"hello", b"\x00" * 100, b"\x89HDF\r\n\x1a\n", b"\x89HDF\r\n\x1a\n" + b"\xff" * 200, b"\x89PNG\r\n\x1a\n" * 9,
          b"<", b"<?xml?>", b"<html></html>", b"# only comments\n", b"X[m]\n", b"{\"X\": 1}", b"\xff\xfe<\x00V\x00"]


def edits(text, table):
    for before, after in table:
        changed, count = re.subn(before, after, text, count=1)
        if count != 1 or changed == text:
            sys.exit(f"FAIL: the edit of {before} changes nothing")
        yield changed.encode()


def damage(whole, chance):
    """One to four changes of bytes, ranges or the length."""
    data = bytearray(whole)
    for _ in range(chance.randint(1, 4)):
        at, how = chance.randrange(max(1, len(data))), chance.randrange(6)
        length = chance.choice((1, 2, 4, 8, 16, 64))
        if how == 0:
            data[at:at + 1] = bytes([chance.randrange(256)])
        elif how == 1:
            data[at:at + length] = bytes([chance.choice((0, 0xff, 0x7f, 0x80))]) * length
        elif how == 2:
            del data[at:at + length]
        elif how == 3:
            data[at:at] = data[at:at + length]
        elif how == 4:
            del data[at:]
        else:
            # the structure of an HDF5 file stands mostly at its beginning
            data[at % 2048:at % 2048 + length] = chance.randbytes(length)
    return bytes(data)


def judge(path):
    run = subprocess.run([PROGRAM, "judge", path, "--oracle", "swinging-cube", "--typical"], stdout=subprocess.PIPE,
                         stderr=subprocess.PIPE, timeout=100)
    return run.returncode, run.stdout.decode(errors="replace") + run.stderr.decode(errors="replace")


def verdict(name, data):
    """2 if the file is refused as it should be, 0 if what was changed does not show; anything else is a failure."""
    path = os.path.join(FOLDER, name)
    with open(path, "wb") as file:
        file.write(data)
    code, said = judge(path)
    if SANITIZER.search(said) and not ("h5" in name and IN_HDF5.search(said)):
        return f"{path}: {said}"
    if code not in (0, 2) or (code == 2 and path not in said):
        return f"{path}: exit code {code}: {said}"
    if CONTROL.search(said):
        return f"{path}: what is printed holds control characters: {said!r}"
    if LOST in said:
        lost.append(path)
    os.remove(path)
    return code


def refused(name, files, all_of_them):
    """How many are; where all must be, one that is not is a failure."""
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        codes = list(pool.map(lambda item: verdict(f"{item[0]}-{name}", item[1]), enumerate(files)))
    for i, code in enumerate(codes):
        if isinstance(code, str):
            sys.exit("FAIL: " + code)
        if all_of_them and code != 2:
            sys.exit(f"FAIL: {name}: edit {i} was not noticed")
    return codes.count(2)


def main():
    os.makedirs(FOLDER, exist_ok=True)
    count = refused("other", OTHERS, True)
    for ending, table in (("csv", CSV), ("vtu", VTU), ("h5", None), ("vtkhdf.h5", None)):
        with open(os.path.join(SAMPLES, "right-2." + ending.split(".")[0]), "rb") as file:
            whole = file.read()
        chance = random.Random(ending)
        sound, said = verdict("sound." + ending, whole), 0
        if sound != 0:
            sys.exit(f"FAIL: the sound {ending} is refused: {sound}")
        if table:
            said = refused(ending, edits(whole.decode(), table), True)
        tried = 0
        while (said < WANTED or tried == 0) and tried < 4 * WANTED:
            batch = [damage(whole, chance) for _ in range(BATCH)]
            said += refused("damaged." + ending, batch, False)
            tried += len(batch)
        if said < WANTED:
            sys.exit(f"FAIL: only {said} damaged files of {ending} in {tried}")
        print(f"{ending}: {said} refused, {tried} damaged at random")
        count += said
    print(f"{count} malformed files, each with exit code 2; HDF5's library crashed on {len(lost)}")
    if count < 200:
        sys.exit("FAIL: fewer than 200")


main()
