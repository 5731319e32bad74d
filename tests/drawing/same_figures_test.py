"""Files and pages show the same figure: every kind is drawn by the program, as SVG, and by the script of a page
(web/figure.js, run by node), and the geometry of both is compared.

    same_figures_test.py WHIRL REPOSITORY        exit status 77 where there is no node

Compared, panel by panel in pixels: the frame; ticks with their places and labels; names of axes; titles; rules; lines
of curves and their strokes; markers; colors of cells; numbers of color scales; labels and names at the ends of lines;
and the legend in its order.
"""

import cmath
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

NODE = shutil.which("node") or shutil.which("nodejs")

PLACE = 0.06  # [pixels] both write hundredths
LINE = 0.75  # [pixels] of lines: both leave out points nearer than 0.35 to the last
DOT = 0.35  # [pixels] of dots below 3 pixels: both snap them to a grid
TEXT = 2.0  # [pixels] of texts beside ticks and in panels
SHADE = 6  # of 255: files have 96 shades of a color scale

failures = []


def check(is_true, what):
    if not is_true:
        failures.append(what)
        print("FAILED:", what, flush=True)


# ---- shapes of a picture


def numbers(text):
    return [float(v) for v in re.findall(r"-?\d+\.?\d*(?:e-?\d+)?", text)]


def path_runs(d):
    """Points of the runs of a path of straight lines."""
    runs, x, y = [], 0.0, 0.0
    for command, rest in re.findall(r"([A-Za-z])([^A-Za-z]*)", d):
        v = numbers(rest)
        if command == "M":
            x, y = v
            runs.append([(x, y)])
            continue
        if command in "zZ":
            runs[-1].append(runs[-1][0])
            continue
        if command == "a":  # half a circle, of a marker
            x, y = x + v[5], y + v[6]
        else:
            x, y = {"L": lambda: (v[0], v[1]), "H": lambda: (v[0], y), "V": lambda: (x, v[0]),
                    "h": lambda: (x + v[0], y), "v": lambda: (x, y + v[0])}[command]()
        runs[-1].append((x, y))
    return runs


UP = dict(zip("-−0123456789", "⁻⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def text_of(element):
    """What a text says, exponents as raised signs."""
    words = element.text or ""
    for part in element:
        raised = float(part.get("dy", "0")) < 0
        words += "".join(UP.get(c, c) for c in part.text or "") if raised else part.text or ""
        words += part.tail or ""
    return words


def texts_in(group):
    """(text, x, y, anchor, size, is bold) of a group, turned texts at the place they turn around."""
    found = []

    def walk(element, dx, dy):
        move = re.search(r"translate\(([-\d.]+) ([-\d.]+)\)", element.get("transform", ""))
        if move:
            dx, dy = dx + float(move[1]), dy + float(move[2])
        if element.tag.endswith("}text"):
            if element.get("fill") != "none" and text_of(element):
                found.append((text_of(element), float(element.get("x")) + dx, float(element.get("y")) + dy,
                              element.get("text-anchor"), float(element.get("font-size")), element.get("font-weight") == "bold"))
            return
        for child in element:
            walk(child, dx, dy)

    walk(group, 0.0, 0.0)
    return found


def strokes_in(group):
    """(points, color, width, dashes) of every line of a group."""
    found = []
    for e in group.iter():
        tag = e.tag.split("}")[-1]
        if e.get("stroke") is None or tag == "text":
            continue
        if tag == "line":
            runs = [[(float(e.get("x1")), float(e.get("y1"))), (float(e.get("x2")), float(e.get("y2")))]]
        elif tag == "polyline":
            v = numbers(e.get("points"))
            runs = [list(zip(v[::2], v[1::2]))]
        else:
            runs = path_runs(e.get("d"))
        style = (e.get("stroke"), round(float(e.get("stroke-width")), 2), tuple(numbers(e.get("stroke-dasharray", ""))))
        found += [(run, *style) for run in runs if len(run) > 1]
    return found


def fills_in(group):
    """(outline, color, opacity) of every area."""
    found = []
    for e in group.iter():
        tag = e.tag.split("}")[-1]
        if e.get("fill") in (None, "none") or tag in ("text", "tspan", "clipPath"):
            continue
        if tag == "circle":
            x, y, r = (float(e.get(k)) for k in ("cx", "cy", "r"))
            outline = [(x - r, y), (x + r, y)]
        elif tag == "polygon":
            v = numbers(e.get("points"))
            outline = list(zip(v[::2], v[1::2]))
        elif tag == "rect":
            x, y, w, h = (float(e.get(k)) for k in ("x", "y", "width", "height"))
            outline = [(x, y), (x + w, y), (x + w, y + h), (x, y + h)]
        elif tag == "path":
            for run in path_runs(e.get("d")):
                found.append((run, e.get("fill"), float(e.get("fill-opacity", 1))))
            continue
        else:
            continue
        found.append((outline, e.get("fill"), float(e.get("fill-opacity", 1))))
    return found


def rgb(color):
    if color.startswith("#"):
        return tuple(int(color[i:i + 2], 16) for i in (1, 3, 5))
    return tuple(int(v) for v in numbers(color)[:3])


# ---- panels of both pictures


class Panel:
    """Groups of shapes of a panel, by what they are."""

    def __init__(self):
        self.box = None
        self.cells = self.axes = self.bar = self.rules = None
        self.lines, self.markers = [], []  # (name, group)
        self.texts = xml.Element("g")  # names at the ends of lines, labels


def clip_of(element):
    rect = element[0]
    return [float(rect.get(k)) for k in ("x", "y", "width", "height")]


def panels_of_file(svg):
    """Panels of a picture of the program, and its legend; the order of shapes tells what they are."""
    panels, legend, clips = [], None, 0
    for child in svg:
        tag, name = child.tag.split("}")[-1], child.get("data-name")
        if tag == "clipPath":
            clips += 1
            if clips % 3 == 1:
                panels.append(Panel())
                panels[-1].box = clip_of(child)
                panels[-1].bar, panels[-1].rules = xml.Element("g"), xml.Element("g")
            continue
        if not panels:
            continue
        panel = panels[-1]
        if tag == "g" and child.get("clip-path"):
            if clips % 3 == 1:
                panel.cells = child
            else:
                (panel.lines if clips % 3 == 2 else panel.markers).extend((g.get("data-name"), g) for g in child)
        elif name == "legend" and clips % 3 == 0:
            legend = child
        elif name == "table" and clips % 3 == 0:
            continue
        elif clips % 3 == 1 and name == "axes" and panel.axes is None:
            panel.axes = child
        elif clips % 3 == 1:
            (panel.bar if name is None else panel.rules).append(child)
        elif legend is None and not (tag == "text" and child.get("font-size") == "12"):  # those are notes
            panel.texts.append(child)
    return panels, legend


def panels_of_page(answer):
    svg = xml.fromstring(answer["svg"].encode())
    panels = [Panel() for _ in answer["boxes"]]
    for panel, box in zip(panels, answer["boxes"]):
        panel.box = box
    legend = None
    for group in svg.iter():
        part = group.get("data-part")
        if part is None:
            continue
        panel = panels[int(group.get("data-panel"))]
        if part == "drawLegend":
            legend = group
        elif part in ("drawLine", "drawMarkers"):
            if len(group):
                (panel.lines if part == "drawLine" else panel.markers).append((group.get("data-name"), group))
        elif part in ("drawEndNames", "drawLabel"):
            panel.texts.append(group)
        else:
            setattr(panel, {"drawCells": "cells", "drawAxes": "axes", "drawColorBar": "bar", "drawRules": "rules"}[part], group)
    return panels, legend


# ---- comparing


def compare_texts(what, ours, theirs, place=TEXT):
    """The same texts at the same places; the order does not matter."""
    left = list(theirs)
    for text in ours:
        near = [t for t in left if t[0] == text[0] and t[3] in (text[3], None) and
                abs(t[1] - text[1]) <= place and abs(t[2] - text[2]) <= place and t[5] == text[5]]
        if near:
            left.remove(near[0])
        else:
            others = [t for t in left if t[0] == text[0]]
            check(False, f"{what}: the file has {text}, the page {others or [t[0] for t in left]}")
    check(not left, f"{what}: only the page has {left[:5]}")


def inside(point, box, margin=0.0):
    x, y, w, h = box
    return x - margin <= point[0] <= x + w + margin and y - margin <= point[1] <= y + h + margin


def distance(p, a, b):
    dx, dy = b[0] - a[0], b[1] - a[1]
    length = dx * dx + dy * dy
    s = min(1.0, max(0.0, ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length)) if length else 0.0
    return ((p[0] - a[0] - s * dx) ** 2 + (p[1] - a[1] - s * dy) ** 2) ** 0.5


def far_points(ours, theirs, box, tolerance):
    """Points of runs, inside a box, that are on no line of others."""
    segments = [pair for run in theirs for pair in zip(run, run[1:] if len(run) > 1 else run)]
    cells = {}  # of some pixels, with the segments that cross them
    size = 16.0
    for a, b in segments:
        steps = int(max(abs(a[0] - b[0]), abs(a[1] - b[1])) / size) + 1
        if steps > 2000:
            steps = 2000
        for k in range(steps + 1):
            key = (int((a[0] + (b[0] - a[0]) * k / steps) // size), int((a[1] + (b[1] - a[1]) * k / steps) // size))
            cells.setdefault(key, set()).add((a, b))
    found = []
    for run in ours:
        for p in run:
            if not inside(p, box):
                continue
            i, j = int(p[0] // size), int(p[1] // size)
            # most are near a line of their own cell
            near = (s for di in (0, -1, 1) for dj in (0, -1, 1) for s in cells.get((i + di, j + dj), ()))
            if not any(distance(p, a, b) <= tolerance for a, b in near):
                found.append(p)
    return found


def merged(groups):
    """Shapes of all groups of a name."""
    names = {}
    for name, group in groups:
        names.setdefault(name or "", xml.Element("g")).append(group)
    return names


def compare_lines(what, a, b, box):
    ours, theirs = merged(a), merged(b)
    for name in sorted(set(ours) | set(theirs)):
        empty = xml.Element("g")
        one, other = ours.get(name, empty), theirs.get(name, empty)
        for shapes in (strokes_in, fills_in):
            mine, its = shapes(one), shapes(other)
            seen = lambda list_: {s[1:] for s in list_ if any(inside(p, box) for p in s[0])}  # noqa: E731
            check(seen(mine) == seen(its), f"{what}, curve {name!r}: drawn with {seen(mine)} and {seen(its)}")
            for left, right, who in ((mine, its, "file"), (its, mine, "page")):
                far = far_points([s[0] for s in left], [s[0] for s in right], box, LINE)
                check(not far, f"{what}, curve {name!r}: {len(far)} points only in the {who}: {far[:3]}")


def middles(groups, box):
    """Middles, size class and colors of markers inside a panel; dots are lines without length."""
    dots, shapes = [], []
    for _, group in groups:
        dots += [(s[0][0], s[1]) for s in strokes_in(group) if inside(s[0][0], box, -1.0)]
        for outline, color, _opacity in fills_in(group):
            xs, ys = [p[0] for p in outline], [p[1] for p in outline]
            middle = (0.5 * (min(xs) + max(xs)), 0.5 * (min(ys) + max(ys)))
            if inside(middle, box, -1.0):
                shapes.append((middle, color))
    return dots, shapes


def compare_markers(what, a, b, box):
    (dots, shapes), (its_dots, its_shapes) = middles(a, box), middles(b, box)
    check(len(shapes) == len(its_shapes), f"{what}: {len(shapes)} markers in the file, {len(its_shapes)} on the page")
    for mine, its, who, tolerance in ((shapes, its_shapes, "file", 2 * PLACE), (its_shapes, shapes, "page", 2 * PLACE),
                                      (dots, its_dots, "file", DOT), (its_dots, dots, "page", DOT)):
        places = {}
        for (x, y), color in its:
            places.setdefault((int(x), int(y), color), []).append((x, y))
        missing = [p for p, color in mine if not any(
            abs(q[0] - p[0]) <= tolerance and abs(q[1] - p[1]) <= tolerance
            for i in (-1, 0, 1) for j in (-1, 0, 1) for q in places.get((int(p[0]) + i, int(p[1]) + j, color), []))]
        check(not missing, f"{what}: {len(missing)} markers only in the {who}: {missing[:3]}")


def colors_at(group, places):
    """Colors of cells at places; none where there is none."""
    areas = []
    for outline, color, _ in fills_in(group):
        xs, ys = [p[0] for p in outline], [p[1] for p in outline]
        areas.append((min(xs), max(xs), min(ys), max(ys), rgb(color)))
    for e in group.iter():
        if not e.tag.endswith("}image"):
            continue
        x, y, w, h = (float(e.get(k)) for k in ("x", "y", "width", "height"))
        _, nx, ny, data = e.get("href").split(":")
        nx, ny, data = int(nx), int(ny), [int(v) for v in data.split(",")]
        for j in range(ny):
            for i in range(nx):
                r, g, b, alpha = data[4 * (j * nx + i):4 * (j * nx + i) + 4]
                if alpha:
                    areas.append((x + w * i / nx, x + w * (i + 1) / nx, y + h * j / ny, y + h * (j + 1) / ny, (r, g, b)))
    return [next((a[4] for a in areas if a[0] <= x <= a[1] and a[2] <= y <= a[3]), None) for x, y in places]


def compare_cells(what, a, b, places):
    if a is None or b is None or not places:
        return
    for place, mine, its in zip(places, colors_at(a, places), colors_at(b, places)):
        same = mine == its if None in (mine, its) else max(abs(p - q) for p, q in zip(mine, its)) <= SHADE
        check(same, f"{what}: a cell at {place} is {mine} in the file and {its} on the page")
    compare_texts(f"{what}: numbers in cells", texts_in(a), texts_in(b))


def compare_rules(what, a, b, box):
    ours, theirs = (strokes_in(g) if g is not None else [] for g in (a, b))
    for left, right, who in ((ours, theirs, "file"), (theirs, ours, "page")):
        for run, *style in left:
            alike = [s[0] for s in right if list(s[1:]) == style]
            middle = tuple(0.5 * (p + q) for p, q in zip(*run))
            ends = [p for p in (*run, middle) if inside(p, box)]
            check(not far_points([ends], alike, box, LINE), f"{what}: only the {who} has a rule {run} {style}")
    compare_texts(f"{what}: names of rules", *(texts_in(g) if g is not None else [] for g in (a, b)))


def compare_axes(what, a, b, box):
    def ticks(group):
        """Ends of ticks outside the frame."""
        found = set()
        for run, *_ in strokes_in(group):
            (x0, y0), (x1, y1) = run[0], run[-1]
            if len(run) == 2 and abs(y0 - box[1] - box[3]) < 0.1 and y1 > y0 + 1 and x0 == x1:
                found.add(("x", round(x0, 1), round(y1 - y0)))
            if len(run) == 2 and abs(max(x0, x1) - box[0]) < 0.1 and min(x0, x1) < box[0] - 1 and y0 == y1:
                found.add(("y", round(y0, 1), round(abs(x1 - x0))))
        return found

    mine, its = ticks(a), ticks(b)
    near = lambda t, others: any(t[0] == o[0] and abs(t[1] - o[1]) <= 0.15 and t[2] == o[2] for o in others)  # noqa: E731
    check(all(near(t, its) for t in mine) and all(near(t, mine) for t in its),
          f"{what}: ticks only in the file {sorted(t for t in mine if not near(t, its))}, only on the page "
          f"{sorted(t for t in its if not near(t, mine))}")
    compare_texts(f"{what}: axes", texts_in(a), texts_in(b))


def compare(what, figure, svg, answer):
    ours, our_legend = panels_of_file(svg)
    theirs, their_legend = panels_of_page(answer)
    check(len(ours) == len(theirs), f"{what}: {len(ours)} panels in the file, {len(theirs)} on the page")
    for i, (a, b) in enumerate(zip(ours, theirs)):
        where = f"{what}, panel {i + 1}"
        check(max(abs(p - q) for p, q in zip(a.box, b.box)) <= PLACE, f"{where}: frames {a.box} and {b.box}")
        compare_axes(where, a.axes, b.axes, a.box)
        compare_cells(where, a.cells, b.cells, answer["cells"][i])
        compare_texts(f"{where}: color scale", *(texts_in(g) if g is not None else [] for g in (a.bar, b.bar)))
        compare_rules(where, a.rules, b.rules, a.box)
        compare_lines(where, a.lines, b.lines, a.box)
        compare_markers(where, a.markers, b.markers, a.box)
        compare_texts(f"{where}: names and labels", texts_in(a.texts), texts_in(b.texts))
    names = [[t[0] for t in texts_in(g)] if g is not None else [] for g in (our_legend, their_legend)]
    check(names[0] == names[1], f"{what}: legend {names[0]} and {names[1]}")


# ---- figures of every kind


PROBED = """
[[force]]
node = 5
force = "200 N"
order = 2
[[force]]
node = 9
force = "100 N"
frequency = "40 Hz"
[[probe]]
name = "1X"
node = 3
angle = "45 deg"
unit = "mil"
[[probe]]
name = "1Y"
node = 3
angle = "135 deg"
"""


def run_up_record(folder):
    """A run-up of the Jeffcott rotor by its closed form, seen by two probes."""
    rows = ["time [s],x [um],y [um],key [V]"]
    for j in range(12 * 500):
        t = j / 500
        turns, speed = 5 * t + 1.5 * t * t, 5 + 3 * t
        r = speed / 21.6
        z = (100 * r * r / (1 - r * r + 0.074j * r) + 5j) * cmath.exp(2j * cmath.pi * turns) + 800 + 4j * t
        key = 5 if turns % 1 < 0.15 else 0
        rows.append(f"{t},{z.real:.4f},{z.imag:.4f},{key}")
    (folder / "run_up.csv").write_text("\n".join(rows) + "\n")
    (folder / "two.toml").write_text('[keyphasor]\nchannel = "key"\n' + "".join(
        f'[[probe]]\nname = "{name}"\nat = "250 mm"\nangle = "{angle} deg"\n' for name, angle in (("x", 0), ("y", 90))))
    return folder / "run_up.csv"


def results(whirl, repository, folder):
    """Result files with figures of every kind: those that fuzzing starts from, and of verbs that it has none of."""
    files = []
    for path in sorted((repository / "tests/fuzz/results").glob("*.h5")):
        shutil.copy(path, folder)
        files.append(folder / path.name)
    models = repository / "models"
    probed = folder / "probed.toml"
    probed.write_text((models / "two_disk_mac.toml").read_text() + PROBED)
    rig, measured_by = models / "two_disk_mac.toml", folder / "probes.toml"
    measured_by.write_text(PROBED[PROBED.index("[[probe]]"):] + '[keyphasor]\nchannel = "key"\n')
    balanced_by = folder / "balance.toml"
    balanced_by.write_text('angles = "with rotation"\n[[plane]]\nname = "left"\nnode = 4\nradius = "120 mm"\n'
                           '[[probe]]\nname = "left"\nnode = 4\nangle = 0\n')
    for name, *words in (
        ("rig", "simulate", rig, "--discard", "20", "--revolutions", "64", "--measure", measured_by,
         "--measured-out", folder / "run.csv"),
        ("measured", "identify", rig, "--measured", folder / "run.csv", "--probes", measured_by, "--orders", "1,2",
         "--running-modes"),
        ("run_up", "identify", models / "jeffcott.toml", "--measured", run_up_record(folder), "--probes", folder / "two.toml",
         "--orders", "1", "--slow-roll", "300rpm", "--model-curve", "fit", "--trend", "--alarm", "500um", "--zones", "shaft"),
        ("fitted", "fit", rig, "--measured", folder / "run.csv", "--probes", measured_by, "--free",
         "contact.ring.stiffness", "--revolutions", "4"),
        ("bench", "bench", models / "jeffcott_stator.toml", "--methods", "dop853,rk4", "--tolerances", "1e-4,1e-6",
         "--discard", "2", "--revolutions", "2"),
        ("balanced", "balance", rig, "--speed", "1500rpm", "--runs", balanced_by),
        ("long", "simulate", models / "dropped_rotor.toml", "--discard", "0", "--revolutions", "128"),
        ("disks", "unbalance", models / "two_disk_mac.toml", "--speeds", "0:8000:400rpm"),
        ("forces", "unbalance", probed, "--speeds", "0:8000:400rpm"),
        ("probed", "simulate", probed, "--discard", "20", "--revolutions", "40"),
        ("ups", "sweep", probed, "--over", "operation.speed=3000:4000:500rpm", "--discard", "20",
         "--revolutions", "10", "--spectra", "8"),
        ("responses", "frf", models / "two_disk_mac.toml", "--from", "7:forward,7:x"),
        ("magnets", "sensitivity", models / "magnetic_bearing.toml", "--steps", "50ms"),
        ("pedestal", "check", models.parent / "tests" / "data" / "pedestal" / "pedestal.toml"),
        ("lateral", "lateral", models / "compressor.toml", "--minimum-speed", "4000rpm", "--cross-coupling", "5MN/m"),
        ("critical", "critical", models / "two_disk_mac.toml"),
        ("shapes", "modes", models / "two_disk_mac.toml"),
        ("locus", "modes", models / "two_disk_mac.toml",
         "--over", "bearing.left.stiffness.xy,-bearing.left.stiffness.yx=0:2:0.2MN/m"),
        ("stiffnesses", "critical", models / "two_disk_mac.toml", "--over", "bearing.left.stiffness=2:8:1MN/m"),
        ("dampings", "unbalance", models / "two_disk_mac.toml", "--over", "bearing.left.damping=1:8:1kN.s/m"),
        ("sag", "static", models / "two_disk_double_rub.toml"),
        ("borders", "continue", models / "jeffcott_stator.toml", "--speed", "138.4rad/s",
         "--over", "contact.ring.friction=0.1:0.15:0.005", "--over", "contact.ring.stiffness=50:80:5MN/m",
         "--at", "0.15,64MN/m", "--points", "12"),
        ("torus", "torus", models / "two_disk_mac.toml", "--discard", "1500", "--harmonics", "33", "--most", "3",
         "--over", "operation.speed=4425:4435:5rpm", "--at", "4430rpm"),
    ):
        out = folder / f"{name}_made.h5"
        call = [whirl, *map(str, words), "--out", str(out), "--quiet"]
        done = subprocess.run(call, capture_output=True, text=True)
        check(done.returncode == 0, f"{' '.join(call)}: {done.stderr}")
        files.append(out)
    return files


def main():
    if not NODE:
        print("there is no node (Debian: nodejs)")
        return 77
    whirl, repository = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
    kinds = set()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for result in results(whirl, repository, folder):
            page = result.with_suffix(".html")
            subprocess.run([whirl, "report", str(result), "--out", str(page), "--quiet"], check=True)
            data = json.loads(re.search(r'id="data">(.*?)</script>', page.read_text(), re.S)[1])
            figures, files, known_here = [], [], set()
            for figure in data["results"][0]["figures"]:
                if figure["kind"] in known_here and not figure["variant"]:
                    continue  # `plot` draws the first one of a kind, or one by its name
                known_here.add(figure["kind"])
                svg = folder / "figure.svg"
                which = ["--which", figure["variant"]] if figure["variant"] else []
                subprocess.run([whirl, "plot", str(result), figure["kind"], *which, "--out", str(svg), "--quiet", "--force"],
                               check=True)
                tree = xml.fromstring(svg.read_bytes())
                panels, _ = panels_of_file(tree)
                first = figure["panels"][0]
                # panels begin below the titles, which the page has beside its pictures
                top = panels[0].box[1] - data["style"]["title" if first["title"] else "above"]
                figures.append({"figure": figure, "top": top})
                files.append(tree)
                kinds.add(figure["kind"])
            tasks = folder / "tasks.json"
            tasks.write_text(json.dumps({"page": {k: v for k, v in data.items() if k not in ("results", "arrays")},
                                         "arrays": data["arrays"], "figures": figures}))
            script = repository / "tests/drawing/draw_page.js"
            answers = json.loads(subprocess.run([NODE, str(script), str(repository / "web/figure.js"), str(tasks)],
                                                check=True, capture_output=True, text=True).stdout)
            for entry, tree, answer in zip(figures, files, answers):
                figure = entry["figure"]
                compare(f"{result.stem}: {figure['kind']} {figure['variant']}".strip(), figure, tree, answer)
    source = "\n".join(p.read_text() for p in (repository / "libio/figures").glob("*.cpp"))
    known = set(re.findall(r'^\s+\.name = "(\w+)",\n\s+\.title', source, re.M))
    check(len(known) > 25 and known == kinds, f"kinds not compared: {sorted(known ^ kinds)}")
    print(f"{len(kinds)} kinds of figures, {len(failures)} differences")
    return 1 if failures else 0


sys.exit(main())
