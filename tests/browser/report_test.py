"""Opens reports in a headless Chromium, as a reader would: every plot drawn, hover, zoom, legend, downloads, dark, in space.

    report_test.py WHIRL MODELS        exit status 77 where there is no chromium
"""

import base64
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import chromium  # noqa: E402

FIRST_PICTURE = 2.0  # [s] with 35 000 cells and 200 000 points, of the issue; measured 0.5

# share of the pixels of a canvas that are drawn, and how many colors they have
PIXELS = """(canvas => {
  const {width, height} = canvas, data = canvas.getContext('2d').getImageData(0, 0, width, height).data;
  const colors = new Set(); let drawn = 0;
  for (let i = 0; i < data.length; i += 4) if (data[i + 3] > 0) {
    ++drawn; colors.add((data[i] >> 4) << 8 | (data[i + 1] >> 4) << 4 | data[i + 2] >> 4); }
  return {share: drawn / (width * height), colors: colors.size}; })"""

failures = []


def check(is_true, what):
    if not is_true:
        failures.append(what)
        print("FAILED:", what, flush=True)


# texts of all figures that run out of their picture, or into each other by more than half a line
BAD_TEXTS = """views.flatMap(v => v.figures.flatMap((f, k) => {
  v.choose(k);
  const ctx = new SvgContext(v.width, v.height), place = document.createElement('div'), found = [];
  v.drawing.draw(ctx, v.width, v.height);
  place.innerHTML = ctx.document().replace(/^<.xml.*?>/, '');
  document.body.append(place);
  const whole = place.firstElementChild.getBoundingClientRect();
  const texts = [...place.querySelectorAll('text')].filter(t => t.getAttribute('fill') !== 'none' && t.textContent)
    .map(t => [t.textContent, t.getBoundingClientRect()]);
  texts.forEach(([a, r], i) => {
    if (r.left < whole.left - 1 || r.right > whole.right + 1 || r.top < whole.top - 1) found.push(`${f.kind} ${f.variant}: ${a} runs out`);
    for (const [b, s] of texts.slice(i + 1)) {
      const wide = Math.min(r.right, s.right) - Math.max(r.left, s.left), high = Math.min(r.bottom, s.bottom) - Math.max(r.top, s.top);
      if (wide > 1 && high > 6) found.push(`${f.kind} ${f.variant}: ${a} on ${b}`);
    }
  });
  place.remove();
  return found; }))"""


def check_figures(browser, name):
    """Every figure of a page, every station of it, has ink in the colors of its curves."""
    for i in range(browser.value("views.length")):
        for k in range(browser.value(f"views[{i}].figures.length")):
            browser.value(f"views[{i}].choose({k})")
            kind, variant = browser.value(f"[views[{i}].figure.kind, views[{i}].figure.variant]")
            what = f"{name}: {kind} {variant}"
            pixels = browser.value(f"{PIXELS}(views[{i}].canvas)")
            check(pixels["share"] > 0.005, f"{what} is empty: {pixels}")
            check(pixels["colors"] >= 3, f"{what} has {pixels['colors']} colors")
            # without its curves and cells the plot looks different
            if "never touches" not in str(browser.value(f"views[{i}].figure.panels.map(p => p.title)")):
                same = browser.value(f"""(() => {{ const v = views[{i}], d = v.drawing, kept = d.panels.map(p => [p.curves, p.cells]);
                  const whole = v.canvas.toDataURL(); d.panels.forEach(p => {{ p.curves = []; p.cells = undefined; }}); v.draw();
                  const bare = v.canvas.toDataURL(); d.panels.forEach((p, n) => {{ [p.curves, p.cells] = kept[n]; }}); v.draw();
                  return whole === bare; }})()""")
                check(not same, f"{what}: its curves leave no ink")
            svg = browser.value(f"views[{i}].svg()")
            check(svg.startswith("<?xml") and svg.endswith("</svg>\n") and "NaN" not in svg, f"{what}: SVG")
            check(browser.value(f"views[{i}].csv().split('\\n').length") > 2, f"{what}: CSV")


def middle_of_point(browser, view, panel=0, curve="p.curves.find(c => c.line !== undefined && c.x.length > 8)"):
    """Where a point of a curve is in the window; the figure is scrolled there."""
    browser.value(f"{view}.card.scrollIntoView({{block: 'center'}})")
    return browser.value(f"""(() => {{ const v = {view}, p = v.drawing.panels[{panel}], c = {curve}, r = v.over.getBoundingClientRect();
      const seen = [...c.x.keys()].filter(i => v.drawing.px(p, c.x[i]) > p.box.x + 0.3 * p.box.w && v.drawing.px(p, c.x[i]) < p.box.x + 0.7 * p.box.w
        && v.drawing.py(p, c.y[i]) > p.box.y && v.drawing.py(p, c.y[i]) < p.box.y + p.box.h), i = seen[seen.length >> 1];
      return [r.left + v.drawing.px(p, c.x[i]), r.top + v.drawing.py(p, c.y[i])]; }})()""")


def check_hands(browser, name):
    """Hover tells values with units, a box zooms, two clicks go back, the legend hides."""
    view = "views.find(v => v.figure.kind === 'time_history')"
    x, y = middle_of_point(browser, view)
    browser.mouse("mouseMoved", x, y)
    tip = browser.value("document.getElementById('tip').hidden ? '' : document.getElementById('tip').innerText")
    check("time = " in tip and " s" in tip and "m" in tip.split()[-1], f"{name}: hover says {tip!r}")
    orbit = "views.find(v => v.figure.kind === 'orbit')"
    check(browser.value(f"{orbit}.cursor?.kind") == "time", f"{name}: the orbit does not follow the time")
    check(browser.value(f"{PIXELS}({orbit}.over)")["share"] > 0, f"{name}: no cursor on the orbit")
    before = browser.value(f"{view}.drawing.panels.map(p => p.view.x)")
    browser.drag(x - 60, y - 3, x + 40, y + 3)
    after = browser.value(f"{view}.drawing.panels.map(p => p.view.x)")
    check(after[0][1] - after[0][0] < 0.6 * (before[0][1] - before[0][0]), f"{name}: a box does not zoom: {before} {after}")
    check(after[0] == after[1], f"{name}: panels below do not zoom too")
    browser.click(x, y, count=2)
    check(browser.value(f"{view}.drawing.panels.map(p => p.view.x)") == before, f"{name}: two clicks do not go back")
    ink = browser.value(f"{PIXELS}({view}.canvas)")["share"]
    browser.value(f"{view}.legend.querySelector('button').click()")
    check(browser.value(f"{PIXELS}({view}.canvas)")["share"] < ink, f"{name}: the legend hides nothing")
    browser.value(f"{view}.legend.querySelector('button').click()")
    # a line of the spectrum is a circle in the orbit
    x, y = middle_of_point(browser, "views.find(v => v.figure.kind === 'spectrum')")
    browser.mouse("mouseMoved", x, y)
    check(browser.value(f"{orbit}.cursor?.kind") == "frequency", f"{name}: the orbit does not follow the frequency")
    light = browser.value("getComputedStyle(document.body).backgroundColor")
    browser.value("document.getElementById('theme').click()")
    check(browser.value("getComputedStyle(document.body).backgroundColor") != light, f"{name}: not dark")
    browser.value("document.getElementById('theme').click()")


def check_ranges(browser, name):
    """Boxes that the keyboard reaches tell the ranges of the axes and set them; what is no range is marked."""
    view = "views.find(v => v.figure.kind === 'time_history')"
    button = f"[...{view}.card.querySelectorAll('.tools button')].find(b => b.textContent === 'Range')"
    before = browser.value(f"{view}.drawing.panels.map(p => p.view)")
    browser.value(f"{button}.click()")
    told = browser.value(f"[...{view}.ranges.querySelectorAll('input')].map(i => [i.ariaLabel, i.value, i.tabIndex])")
    check([t[0] for t in told] == ["x from", "x to", "y from", "y to"], f"{name}: boxes {told}")
    check(all(t[2] == 0 for t in told), f"{name}: the keyboard does not reach {told}")
    first, last = before[0]["x"]
    check(abs(float(told[1][1]) - last) < 1e-4 * (last - first) + 1e-5, f"{name}: x ends at {last}, the box says {told[1][1]}")
    write = f"""((n, text) => {{ const box = {view}.ranges.querySelectorAll('input')[n]; box.focus(); box.value = text;
      box.dispatchEvent(new Event('change')); return box.getAttribute('aria-invalid'); }})"""
    middle = 0.5 * (first + last)
    browser.value(f"{write}(0, '{middle}')")
    now = browser.value(f"{view}.drawing.panels.map(p => p.view)")
    check(abs(now[0]["x"][0] - middle) < 1e-9 and now[1]["x"] == now[0]["x"], f"{name}: from {middle} gives {now}")
    check(browser.value(f"{write}(2, 'word')") == "true", f"{name}: a word is taken for a range")
    check(browser.value(f"{write}(2, '1e9')") == "true", f"{name}: a range from high to low is taken")
    check(browser.value(f"{view}.drawing.panels[0].view.y") == before[0]["y"], f"{name}: what is no range changes y")
    browser.value(f"{view}.reset()")
    check(browser.value(f"{view}.drawing.panels.map(p => p.view)") == before, f"{name}: Reset does not go back")
    browser.value(f"{button}.click()")
    check(browser.value(f"{view}.ranges.hidden"), f"{name}: the boxes stay")


def check_space(browser, name):
    """The canvas in space is drawn, moves, and each motion looks different."""
    browser.value("spaces[0].card.scrollIntoView({block: 'center'})")
    browser.wait_for("Number(document.querySelector('.space').dataset.frames || 0) > 3")
    copy = f"""(() => {{ const from = document.querySelector('.space canvas'), to = document.createElement('canvas');
      spaces[0].render(); to.width = from.width; to.height = from.height; to.getContext('2d').drawImage(from, 0, 0);
      return to; }})()"""
    pixels = browser.value(f"{PIXELS}({copy})")
    check(pixels["share"] > 0.005 and pixels["colors"] > 10, f"{name}: space is empty: {pixels}")
    frames = browser.value("spaces[0].frames")
    browser.wait_for(f"spaces[0].frames > {frames} + 3")
    browser.value("spaces[0].playButton.click()")
    hashes = set()
    for at in (0.0, 0.3, 0.6):
        browser.value(f"spaces[0].scrub.value = {at}; spaces[0].scrub.dispatchEvent(new Event('input'))")
        hashes.add(browser.value(f"{copy}.toDataURL()"))
    check(len(hashes) == 3, f"{name}: moments in space look alike")


def check_map(browser, name):
    """A click on a map gives the command of that point, and the command runs."""
    view = "views.find(v => v.figure.kind === 'map')"
    browser.value(f"{view}.card.scrollIntoView({{block: 'center'}})")
    x, y = browser.value(f"""(() => {{ const v = {view}, b = v.drawing.panels[0].box, r = v.over.getBoundingClientRect();
      return [r.left + b.x + b.w / 2, r.top + b.y + b.h / 2]; }})()""")
    browser.click(x, y)
    command = browser.value(f"{view}.command.querySelector('code')?.textContent || ''")
    check(command.startswith("whirl classify ") and command.count("--set") == 2, f"{name}: click says {command!r}")
    return command


def check_strangers(browser, whirl, folder, model):
    """Names of strangers: braces in them are no places of a command, and no text of a saved table is a formula."""
    strange = os.path.join(folder, "a{x}{n}{{y}.toml")
    with open(model) as there, open(strange, "w") as file:
        file.write(there.read().replace('name      = "ring"', 'name      = "r{-x}"').replace('name  = "rotor"', 'name  = "=1+{y}"')
                   .replace('"rotor"', '"=1+{y}"'))
    page = os.path.join(folder, "strange.html")
    for verb, words in (("map", ["--over", "operation.speed=130:140:5rad/s", "--over", "contact.r{-x}.stiffness=20,40MN/m", "--discard", "5",
                                 "--revolutions", "5"]), ("simulate", ["--revolutions", "12", "--discard", "5"])):
        result = os.path.join(folder, f"strange_{verb}.h5")
        for line in ([whirl, verb, strange, *words, "--out", result, "--quiet"], [whirl, "report", result, "--out", page, "--quiet"]):
            done = subprocess.run(line, capture_output=True, text=True)
            check(done.returncode in (0, 3), f"{line}: {done.stderr}")
        browser.open(page)
        browser.wait_for("document.documentElement.dataset.state === 'drawn'")
        if verb == "map":
            command = shlex.split(check_map(browser, "strange"))
            check(command[2] == strange, f"the model is {command[2]}")
            check(command[-1].startswith("contact.r{-x}.stiffness=") and float(command[-1].split("=")[1].removesuffix("N/m")) > 1e7,
                  f"a click says {command}")
        cells = [cell for table in browser.value("views.map(v => v.csv())") for line in table.split("\n") for cell in line.split('"')[1::2]]
        check(not [cell for cell in cells if cell[:1] in ("=", "+", "-", "@")], f"{verb}: formulas in {cells[:9]}")
        check(verb == "map" or any("'=1+{y}" in cell for cell in cells), f"{verb}: the name is not in the tables")
    check(not browser.problems, f"strange: {browser.problems}")


def check_branches(browser, whirl, folder, model):
    """A click on a point of a branch tells its multipliers and a command that finds its orbit."""
    result, page = os.path.join(folder, "branches.h5"), os.path.join(folder, "branches.html")
    subprocess.run([whirl, "continue", model, "--speed", "138.4rad/s", "--set", "contact.ring.stiffness=64e6", "--over",
                    "contact.ring.friction=0.14:0.15:0.002", "--at", "0.15", "--out", result, "--quiet"], check=True)
    subprocess.run([whirl, "report", result, "--out", page, "--quiet"], check=True)
    browser.open(page)
    browser.wait_for("document.documentElement.dataset.state === 'drawn'")
    view = "views.find(v => v.figure.kind === 'branches')"
    x, y = middle_of_point(browser, view, curve="p.curves.find(c => c.details)")
    browser.click(x, y)
    lines = browser.value(f"[...{view}.command.querySelectorAll('.detail')].map(e => e.innerText)")
    check(len(lines) == 3 and lines[0].startswith("Point ") and "multipliers: " in lines[1] and "% in touch" in lines[2], f"a click says {lines}")
    command = shlex.split(browser.value(f"{view}.command.querySelector('code')?.textContent || ''"))
    check(command[:2] == ["whirl", "orbit"] and "--point" in command, f"a click says {command}")
    done = subprocess.run([whirl, *command[1:], "--json", "-"], capture_output=True, text=True)
    check(done.returncode == 0, f"{command}: {done.stderr}")
    size = abs(complex(*json.loads(done.stdout)["floquet"][0]))
    told = lines[1].split(": ")[1].split(", ")[0].replace("−", "-")
    check(abs(size - abs(float(told.split("(")[1][:-1] if "(" in told else told))) < 1e-4, f"{told} is not of size {size}")
    check(not browser.problems, f"branches: {browser.problems}")
    print("branches", flush=True)


def check_comparison(browser, whirl, folder, model):
    """A page of two runs begins with what was changed and with both over each other, each in its color."""
    for verb, words in (("unbalance", ["--speeds", "0:3000:20rpm"]), ("campbell", []), ("simulate", ["--revolutions", "40", "--discard", "40"])):
        files = [os.path.join(folder, f"{verb}_{name}.h5") for name in ("light", "heavy")]
        for file, mass in zip(files, ("2kg", "2.6kg")):
            subprocess.run([whirl, verb, model, "--set", f"disk.1.mass={mass}", *words, "--out", file, "--quiet"], check=True)
        page = os.path.join(folder, f"compared_{verb}.html")
        subprocess.run([whirl, "report", *files, "--out", page, "--quiet"], check=True)
        browser.open(page)
        browser.wait_for("document.documentElement.dataset.state === 'drawn'")
        check(browser.value("[...document.querySelectorAll('#differences td')].map(e => e.innerText)") == ["disk.disk.mass", "2kg", "2.6kg"],
              f"{verb}: the difference of the models is not told")
        own = "views.filter(v => v.result.number === 'compared')"
        check(browser.value(f"{own}.length") > 0, f"{verb}: nothing is compared")
        # both results have curves in every panel, in two colors; a hidden one leaves less ink
        mixed = browser.value(f"""{own}.flatMap(v => v.drawing.panels.filter(p => {{
            const of = name => p.curves.filter(c => c.name.startsWith(name)), a = of('{verb}_light'), b = of('{verb}_heavy');
            return !a.length || a.length !== b.length || a.some(c => b.some(d => c.paint === d.paint)); }}).map(() => v.figure.kind))""")
        check(mixed == [], f"{verb}: not both results, or not in colors of their own: {mixed}")
        for i in range(browser.value(f"{own}.length")):
            ink = browser.value(f"{PIXELS}({own}[{i}].canvas)")["share"]
            browser.value(f"{own}[{i}].drawing.hidden = new Set({own}[{i}].drawing.legend().map(e => e.name).filter(n => n.startsWith('{verb}_heavy'))); {own}[{i}].draw()")
            check(browser.value(f"{PIXELS}({own}[{i}].canvas)")["share"] < ink, f"{verb}: the second result leaves no ink in a figure")
        check(not browser.problems, f"{verb}, compared: {browser.problems}")
        print(f"compared {verb}", flush=True)


def check_phone(browser, name):
    """On a phone nothing is wider than the screen: panels are below each other, wide tables scroll in their place."""
    browser.resize(390, 844)
    browser.wait_for("views.every(v => !v.width || v.width < 390)")
    check(browser.value("document.documentElement.scrollWidth") <= 390, f"{name}: the page is wider than a phone")
    side_by_side = browser.value("views.filter(v => v.isDrawn && new Set(v.drawing.panels.map(p => p.box.x)).size > 1).map(v => v.figure.kind)")
    check(side_by_side == [], f"{name}: panels beside each other on a phone: {side_by_side}")
    high = browser.value("views.filter(v => v.drawing.panels.some(p => p.box && p.box.h < 60)).map(v => v.figure.kind)")
    check(high == [], f"{name}: panels too low to read on a phone: {high}")
    bad = browser.value(BAD_TEXTS)
    check(bad == [], f"{name}: texts on a phone: {bad}")
    # circles are as wide as there is room; a logarithmic axis of two powers of ten and more tells two
    narrow = browser.value("""views.flatMap(v => v.drawing.panels.filter(p => p.frame === false && p.equal && p.box.h < 0.95 * p.box.w)
      .map(() => v.figure.kind))""")
    check(narrow == [], f"{name}: circles smaller than a phone: {narrow}")
    untold = browser.value("""views.flatMap(v => v.drawing.panels.flatMap(p => [[p.ax, v.drawing.ticksAlong(p)], [p.ay, v.drawing.ticksUp(p)]]
      .filter(([axis, ticks]) => axis.log && axis.last / axis.first >= 100 && ticks.filter(t => t.label.startsWith('10')).length < 2)
      .map(() => v.figure.kind)))""")
    check(untold == [], f"{name}: axes without powers of ten: {untold}")
    tables = browser.value("""[...document.querySelectorAll('table')].filter(t => t.scrollWidth > t.parentElement.clientWidth
      && getComputedStyle(t.parentElement).overflowX !== 'auto').length""")
    check(tables == 0, f"{name}: {tables} tables are cut off on a phone")
    browser.resize(1400, 1000)
    browser.wait_for("views.every(v => !v.width || v.width > 390)")


def check_paper(browser, name):
    """On paper: white, no buttons, a picture of every figure, and of what moves in space."""
    browser.dark()
    browser.value("""addEventListener('beforeprint', () => { window.onPaper = {
      pictures: document.querySelectorAll('.plot .paper svg').length, spaces: document.querySelectorAll('.space img.paper').length }; })""")
    pdf = base64.b64decode(browser.call("Page.printToPDF", printBackground=True)["data"])
    pages = len(re.findall(rb"/Type\s*/Page\b", pdf))
    held = browser.value("window.onPaper")
    check(held["pictures"] == browser.value("views.length"), f"{name}: {held['pictures']} figures on paper")
    check(held["spaces"] == browser.value("spaces.length"), f"{name}: no picture of what moves on paper")
    check(0 < pages <= 1 + browser.value("views.length") / 1.5, f"{name}: {pages} pages for {browser.value('views.length')} figures")
    check(browser.value("document.querySelectorAll('.paper').length") == 0, f"{name}: pictures for paper stay")
    browser.call("Emulation.setEmulatedMedia", media="print", features=[{"name": "prefers-color-scheme", "value": "dark"}])
    check(browser.value("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)", f"{name}: the paper is not white")
    seen = browser.value("[...document.querySelectorAll('button, select, input, nav')].filter(e => e.getClientRects().length).length")
    check(seen == 0, f"{name}: {seen} buttons on paper")
    browser.call("Emulation.setEmulatedMedia", media="", features=[])


def check_machine(browser, whirl, folder, model):
    """Analyses of one model are one report: its drawing once, a section per analysis, in their order."""
    files = []
    for verb in ("unbalance", "modes", "static"):
        files.append(os.path.join(folder, f"machine_{verb}.h5"))
        subprocess.run([whirl, verb, model, "--out", files[-1], "--quiet"], check=True)
    page = os.path.join(folder, "machine.html")
    subprocess.run([whirl, "report", *files, "--out", page, "--quiet"], check=True)
    browser.open(page)
    browser.wait_for("document.documentElement.dataset.state === 'drawn'")
    check(browser.value("views.filter(v => v.figure.kind === 'layout').length") == 1, "the machine is not drawn once")
    headings = browser.value("[...document.querySelectorAll('h2')].map(h => h.innerText)")
    check(headings == ["Sag and bearing loads", "Modes", "Unbalance response"], f"sections are {headings}")
    check(browser.value("!document.getElementById('differences')"), "a machine is compared with itself")
    check_figures(browser, "machine")
    # a figure that fails leaves the others
    text = open(page).read()
    begin = text.index('id="data">') + 10
    end = text.index("</script>", begin)
    data = json.loads(text[begin:end])
    data["results"][1]["figures"][0]["panels"] = None
    with open(page, "w") as file:
        file.write(text[:begin] + json.dumps(data).replace("</", "<\\/") + text[end:])
    browser.open(page)
    browser.wait_for("document.documentElement.dataset.state === 'drawn'")
    told = browser.value("[...document.querySelectorAll('.warning')].map(e => e.innerText)")
    check(len(told) == 1 and told[0].startswith('no figure "Mode shapes": '), f"a broken figure says {told}")
    check(browser.value("views.filter(v => v.isDrawn).length") >= 4, "a broken figure costs the others")
    print("machine", flush=True)


def check_speed(browser, folder, page):
    """35 000 cells and 200 000 points put into a page of the program are drawn in time."""
    text = open(page).read()
    begin = text.index('id="data">') + 10
    end = text.index("</script>", begin)
    data = json.loads(text[begin:end])
    import array
    import math

    def stored(values):
        data["arrays"].append("f32:" + base64.b64encode(array.array("f", values).tobytes()).decode())
        return len(data["arrays"]) - 1

    result = data["results"][0]
    map_figure = next(f for f in result["figures"] if f["kind"] == "map")
    cells = map_figure["panels"][0]["cells"]
    cells.update(x=stored(range(250)), y=stored(range(140)), values=stored([(i * 7919) % len(cells["categories"]) for i in range(35000)]))
    for axis, last in (("x", 249.5), ("y", 139.5)):
        map_figure["panels"][0][axis].update(first=-0.5, last=last)
    dots = {"kind": "bifurcation", "variant": "", "title": "many", "subtitle": "many", "summary": "", "columns": 1, "width": 720, "height": 480,
            "table": {"header": [], "rows": []}, "notes": [],
            "panels": [{"title": "", "x": {"title": "x", "log": False, "first": 0, "last": 1}, "y": {"title": "y", "log": False, "first": -1, "last": 1},
                        "share": 1, "cursor": "", "rules": [], "labels": [],
                        "curves": [{"name": "dots", "end_name": "", "paint": "up", "marker": "circle", "size": 1.7,
                                    "x": stored([i / 200000 for i in range(200000)]),
                                    "y": stored([math.sin(0.37 * i * i) for i in range(200000)])}]}]}
    result["figures"] = [map_figure, dots]
    path = os.path.join(folder, "many.html")
    with open(path, "w") as file:
        file.write(text[:begin] + json.dumps(data).replace("</", "<\\/") + text[end:])
    start = time.time()
    browser.open(path)
    browser.wait_for("document.documentElement.dataset.state === 'drawn'")
    took = time.time() - start
    print(f"35 000 cells and 200 000 points: {took:.2f} s", flush=True)
    check(took < FIRST_PICTURE, f"the first picture took {took:.2f} s")
    for i in (0, 1):
        check(browser.value(f"{PIXELS}(views[{i}].canvas)")["share"] > 0.1, "a large plot is empty")


def main():
    if not chromium.find():
        print("skipped: there is no chromium (Debian package chromium)")
        return 77
    whirl, models = sys.argv[1:3]
    short = ["--revolutions", "48", "--discard", "60"]
    study = ["--discard", "20", "--revolutions", "10"]
    model = lambda name: os.path.join(models, name + ".toml")  # noqa: E731
    runs = {
        "campbell": ["campbell", model("overhung_disk")],
        "unbalance": ["unbalance", model("two_disk_mac"), "--speeds", "0:8000:20rpm"],
        "critical": ["critical", model("two_disk_mac")],
        "identify": ["identify", model("two_disk_mac"), *short],
        "double_rub": ["simulate", model("two_disk_double_rub"), *short],
        "jeffcott": ["simulate", model("jeffcott"), *short],
        "cross": ["simulate", model("cross_coupled_bearing"), *short],
        "dropped": ["simulate", model("dropped_rotor"), *short],
        "stator": ["classify", model("jeffcott_stator"), *study],
        "sweep": ["sweep", model("jeffcott_stator"), "--over", "operation.speed=130:134:0.5rad/s", *study],
        "map": ["map", model("jeffcott_stator"), "--over", "operation.speed=130:140:2rad/s", "--over",
                "contact.ring.stiffness=10:150:40MN/m", *study],
        "basins": ["basins", model("jeffcott_stator"), "--starts", "40", *study],
        "bench": ["bench", model("jeffcott"), "--methods", "dop853,rk4", "--tolerances", "1e-4,1e-6", "--revolutions", "2",
                  "--discard", "2"],
    }
    with tempfile.TemporaryDirectory() as folder, chromium.Browser() as browser:
        for name, words in runs.items():
            result, page = (os.path.join(folder, name + ending) for ending in (".h5", ".html"))
            for line in ([whirl, *words, "--out", result, "--quiet"], [whirl, "report", result, "--out", page, "--quiet"]):
                done = subprocess.run(line, capture_output=True, text=True)
                check(done.returncode in (0, 3) and os.path.exists(line[line.index("--out") + 1]), f"{' '.join(line)}: {done.stderr}")
            browser.problems.clear(), browser.requests.clear()
            browser.open(page)
            browser.wait_for("document.documentElement.dataset.state === 'drawn'")
            check(browser.value("views.length") > 0, f"{name}: no figure")
            check_figures(browser, name)
            if browser.value("spaces.length"):
                check_space(browser, name)
            if name == "identify":
                check_hands(browser, name)
                check_ranges(browser, name)
                check_paper(browser, name)
            check_phone(browser, name)
            if name == "map":
                command = check_map(browser, name).split()
                done = subprocess.run([whirl, *command[1:], *study, "--quiet"], capture_output=True, text=True)
                check(done.returncode == 0, f"{' '.join(command)}: {done.stderr}")
            outside = [r for r in browser.requests if not r.startswith(("file:", "data:", "blob:"))]
            check(not outside, f"{name} asks the network: {outside}")
            check(not browser.problems, f"{name}: {browser.problems}")
            print(name, flush=True)
        browser.problems.clear()
        check_strangers(browser, whirl, folder, model("jeffcott_stator"))
        browser.problems.clear()
        check_branches(browser, whirl, folder, model("jeffcott_stator"))
        browser.problems.clear()
        check_comparison(browser, whirl, folder, model("jeffcott"))
        browser.problems.clear()
        check_machine(browser, whirl, folder, model("two_disk_double_rub"))
        browser.problems.clear()
        check_speed(browser, folder, os.path.join(folder, "map.html"))
        check(not browser.problems, f"many: {browser.problems}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
