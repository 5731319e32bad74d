"""Prints reports as PDF files and reads them as an engineer would: verdict, every case, numbers of pages, templates.

    printed_test.py WHIRL MODELS        exit status 77 where there is no chromium, or no pdftotext
"""

import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import chromium  # noqa: E402

failures = []


def check(is_true, what):
    if not is_true:
        failures.append(what)
        print("FAILED:", what, flush=True)


def run(line, status=0, **more):
    done = subprocess.run(line, capture_output=True, text=True, **more)
    check(done.returncode == status, f"{' '.join(line)}: status {done.returncode}: {done.stderr}")
    return done


def pages_of(pdf):
    """Texts of the pages, their blanks as one."""
    with open(pdf, "rb") as file:
        check(file.read(5) == b"%PDF-", f"{pdf} is no PDF file")
    text = run(["pdftotext", "-layout", pdf, "-"]).stdout
    return [re.sub(r"\s+", " ", page) for page in text.split("\f")[:-1]]


def has(text, words, what):
    for word in words:
        check(word in text, f"{what}: no {word!r}")


def check_lateral(whirl, models, folder):
    """The first page has the verdict and the places for signatures; all cases, stations and checks are there, and all pages numbered."""
    result, pdf = (os.path.join(folder, "la" + ending) for ending in (".h5", ".pdf"))
    run([whirl, "lateral", os.path.join(models, "compressor.toml"), "--out", result, "--quiet"])
    answer = json.loads(run([whirl, "lateral", os.path.join(models, "compressor.toml"), "--json", "-"]).stdout)
    run([whirl, "report", result, "--out", pdf, "--cover", "author=J. Jeffcott", "--cover", "company=Rotor <Works> & Co",
         "--cover", "revision=B", "--cover", "checked_by=A. Stodola", "--cover", "date=2026-11-29"])
    pages = pages_of(pdf)
    whole = " ".join(pages)
    failed = sum(c["verdict"] == "failed" for c in answer["checks"])
    unknown = sum(c["verdict"] == "unknown" for c in answer["checks"])
    total = len(answer["checks"])
    headline = (f"FAILED: {failed} of {total} checks" if failed else
                f"{total - unknown} of {total} checks passed, {unknown} could not be made" if unknown else f"PASSED: all {total} checks")
    has(pages[0], [headline, "Centrifugal compressor of eight stages", "J. Jeffcott", "Rotor <Works> & Co", "A. Stodola", "2026-11-29",
                   "signature", "SHA-256"], "first page")
    for number, text in enumerate(pages):
        has(text, [f"page {number + 1} of {len(pages)}", "revision B"], f"page {number + 1}")
        is_full = len(text) > 400 or "Figure " in text or number + 1 == len(pages)
        check(is_full, f"page {number + 1} is nearly empty: {text!r}")
    for number in range(1, len(answer["cases"]) + 1):
        has(whole, [f"Unbalance at antinodes and overhung ends, case {number}."], "cases")
    for rule in {c["rule"] for c in answer["checks"]}:
        has(whole, [rule], "rules")
    rows = len(re.findall(r"(?:separation margin|vibration|running clearance|log decrement|cross-coupling|stability region) (?:\d+|-) ", whole))
    check(rows >= total, f"{rows} rows of {total} checks")
    has(whole, ["impeller 8", "Coefficients: seal eye 1, seal eye 2", "thrust collar", "Oil films", "What was not checked", "Assumptions",
                "Torsional and axial vibration", "Stations", "Materials"], "whole")
    figures = [int(n) for n in re.findall(r"Figure (\d+)\.", whole)]
    check(sorted(set(figures)) == list(range(1, max(figures) + 1)), f"figures are {figures}")
    check("<details" not in whole and "Reset" not in whole, "buttons on paper")
    return result


def check_kinds(whirl, models, folder):
    """Other analyses say what can be said; the digest of a model without further files is that of its file."""
    model = os.path.join(models, "two_disk_mac.toml")
    for verb, words, told in (("unbalance", ["--speeds", "0:8000:50rpm"], ["Separation margin kept", "beyond the clearance of contact ring",
                                                                     "Largest response of every station"]),
                              ("modes", [], ["Stable at", "Least logarithmic decrement"]),
                              ("campbell", ["--speeds", "0:6000:200rpm"], ["No mode of the"]),
                              ("critical", [], ["critical speeds, the lowest at"]),
                              ("static", [], ["Largest static deflection of the shaft"]),
                              ("simulate", ["--revolutions", "12", "--discard", "4"], ["Largest displacement", "Displacements of stations", "Forces of the rotor on its supports"]),
                              ("identify", ["--revolutions", "12", "--discard", "4"], ["No verdict"])):
        result, pdf = (os.path.join(folder, verb + ending) for ending in (".h5", ".pdf"))
        run([whirl, verb, model, *words, "--out", result, "--quiet"])
        run([whirl, "report", result, "--out", pdf, "--quiet"])
        whole = " ".join(pages_of(pdf))
        has(whole, told, verb)
        with open(model, "rb") as file:
            digest = hashlib.sha256(file.read()).hexdigest()
        check(digest in whole, f"{verb}: the digest is not that of the model file")
    several = [os.path.join(folder, verb + ".h5") for verb in ("static", "modes", "unbalance")]
    pdf = os.path.join(folder, "machine.pdf")
    run([whirl, "report", *several, "--out", pdf, "--quiet"])
    whole = " ".join(pages_of(pdf))
    has(whole, ["Sag and bearing loads", "Modes", "Unbalance response", "Largest static deflection"], "machine")
    check(len(re.findall(r"Table \d+\. Stations\.", whole)) == 1, "the model of one machine is told more than once")


def check_units(whirl, folder, result):
    """What is printed is in the units that are asked for: tables of the model, of findings, of checks, and figures."""
    pdf = os.path.join(folder, "us.pdf")
    run([whirl, "report", result, "--out", pdf, "--units", "us,Hz", "--quiet"])
    whole = " ".join(pages_of(pdf)).split("Appendix: model file")[0]  # which is as it was written
    has(whole, ["z [in]", "density [lb/in^3]", "[lbf/in]", "[lbf.s/in]", "mass [lb]", "polar inertia [lb.in^2]", "[mil]", "peak [Hz]",
                "speed [Hz]"], "US units")
    for word in ("[mm]", "[kg", "[um]", "[MN/m]", " rpm ", "g.mm"):
        check(word not in whole, f"US units: {word!r} in {whole[max(0, whole.find(word) - 60):whole.find(word) + 20]!r}")


TEMPLATE = """<html><head><style>{{style}} .house { color: #0a0 }</style></head><body>
<script>document.write("SCRIPT" + "WASRUN")</script><p class="house" onclick="x()">House of {{company}}, {{ title }}</p>
<img src="missing.png" onerror="document.body.append('HANDLER' + 'WASRUN')">{{verdict}}{{report}}</body></html>"""


def check_template(whirl, folder, result):
    """A house's own page: its words and places, no scripts; what is wrong in it is an error and leaves no file."""
    page, pdf = os.path.join(folder, "house.html"), os.path.join(folder, "house.pdf")

    def attempt(text, status, *more):
        with open(page, "w") as file:
            file.write(text)
        if os.path.exists(pdf):
            os.remove(pdf)
        done = run([whirl, "report", result, "--out", pdf, "--template", page, *more], status)
        check(os.path.exists(pdf) == (status == 0), f"a file after status {status}")
        return done.stderr

    attempt(TEMPLATE, 0, "--cover", "company=Stodola & Sons")
    whole = " ".join(pages_of(pdf))
    has(whole, ["House of Stodola & Sons, Centrifugal compressor", "What was not checked"], "template")
    check("WASRUN" not in whole, "a script of a template was run")
    has(attempt(TEMPLATE, 2), ["house.html:2: {{company}} has no value", "--cover company="], "a text that nobody said")
    has(attempt(TEMPLATE.replace("{{verdict}}", ""), 2, "--cover", "company=S"), ["the place {{verdict}} is missing"], "without a verdict")
    has(attempt(TEMPLATE + "\n{{titel}}", 2, "--cover", "company=S"), ["house.html:4: {{titel}} stands for nothing", "title"], "unknown place")
    has(attempt(TEMPLATE + "{{title", 2, "--cover", "company=S"), ["without \"}}\""], "open place")
    done = run([whirl, "report", result, "--out", os.path.join(folder, "x.html"), "--template", page], 2)
    has(done.stderr, ["--template", "--out FILE.pdf"], "a template for the screen")


def main():
    if not chromium.find() or not shutil.which("pdftotext"):
        print("skipped: there is no chromium, or no pdftotext (Debian packages chromium, poppler-utils)")
        return 77
    whirl, models = sys.argv[1:3]
    with tempfile.TemporaryDirectory() as folder:
        result = check_lateral(whirl, models, folder)
        check_template(whirl, folder, result)
        check_units(whirl, folder, result)
        check_kinds(whirl, models, folder)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
