"""study_html.py PROGRAM FOLDER PANELS WORD...: runs `PROGRAM verify WORD...` with a title full of markup and checks
report.html: tags balanced, nothing escapes, nothing loaded from elsewhere, both pictures inside, every plotted point
within its frame, and PANELS plots of the stress along the body, in each the exact line, and lines of all levels with
their errors."""
import base64
import html.parser
import os
import re
import shutil
import subprocess
import sys

TITLE = """<script>alert("1 & 2")</script>'"""
VOID = {"meta", "img", "br"}


class Page(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.open, self.seen, self.pictures, self.points, self.heading = [], [], [], 0, ""
        self.frame, self.lines = None, []  # lines: classes of each svg element's polylines

    def handle_startendtag(self, tag, attributes):
        self.look(tag, dict(attributes))

    def handle_starttag(self, tag, attributes):
        self.look(tag, dict(attributes))
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open and self.open[-1] == tag, f"</{tag}> closes {self.open[-1:]}"
        self.open.pop()

    def handle_data(self, data):
        if self.open[-1:] == ["h1"]:
            self.heading += data

    def look(self, tag, attributes):
        self.seen.append(tag)
        for name in ("src", "href", "xlink:href"):
            value = attributes.get(name, "data:")
            assert value.startswith("data:"), f"{tag} loads {value[:60]}"
        if tag == "img":
            self.pictures.append(base64.b64decode(attributes["src"].split(",", 1)[1], validate=True))
        if tag == "svg":
            self.frame = None
            self.lines.append([])
        if tag == "rect" and attributes.get("class") == "frame":
            self.frame = [float(attributes[name]) for name in ("x", "y", "width", "height")]
        kind = attributes.get("class", "")
        if tag == "polyline" and not kind.startswith("key "):
            self.lines[-1].append(kind)
            for point in attributes["points"].split():
                self.inside(*map(float, point.split(",")))
        if tag == "circle" and self.frame:
            self.inside(float(attributes["cx"]), float(attributes["cy"]))
            self.points += 1

    def inside(self, x, y):
        left, top, width, height = self.frame
        inside = left - 0.1 <= x <= left + width + 0.1 and top - 0.1 <= y <= top + height + 0.1
        assert inside, f"a point lies at {x}, {y}, its frame is {self.frame}"


def main():
    program, folder, panels, *words = sys.argv[1:]
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    run = subprocess.run([program, "verify", *words, "--out", folder, "--set", "title=" + TITLE],
                         stdout=subprocess.PIPE, text=True)
    print(run.stdout)
    assert run.returncode in (0, 1), f"exit code {run.returncode}"
    with open(os.path.join(folder, "report.html"), encoding="utf-8") as file:
        text = file.read()
    page = Page()
    page.feed(text)
    page.close()
    assert page.open == [], f"left open: {page.open}"
    assert page.heading == TITLE, f"the title reads {page.heading}"
    assert "script" not in page.seen, "the title became a script"
    assert len(page.pictures) == 2 and page.seen.count("svg") >= 2, "two pictures and two plots are expected"
    for picture in page.pictures:
        assert picture.startswith(b"\x89PNG\r\n\x1a\n") and picture.rstrip().endswith(b"IEND\xaeB`\x82"), "no whole PNG"
    assert page.points >= 2, f"{page.points} points plotted"
    profiles = [lines for lines in page.lines if lines and lines[0] == "exact" and "finer" in lines]
    assert len(profiles) == int(panels), f"{len(profiles)} profiles: {page.lines}"
    levels = words[words.index("--levels") + 1].count(",") + 1
    for lines in profiles:
        assert lines == ["exact"] + 2 * ["fine", "finer", "finest"][-levels:], f"a profile has {lines}"
    for heading in ("Orders of the last two pairs of levels", "Figures extrapolated"):
        there = f"<h2>{heading}</h2>" in text
        assert there == (levels > 2 and ("Figures" not in heading or "<h2>Figures measured" in text)), heading
    assert ["exact"] * 3 + ["kinetic", "strain", "total"] in page.lines, "energies over time"
    assert ["exact", "finest"] in page.lines, "displacements over time"
    shown = re.sub("base64,[^\"]*", "", text.split("<h2>Scene</h2>")[0])
    assert re.search(r"\b-?(nan|inf)\b", shown) is None, "a number that is none is shown"
    print(f"{len(text)} characters, {page.points} points")


main()
