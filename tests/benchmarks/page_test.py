#!/usr/bin/env python3
"""docs/benchmarks.md, bench/jobs.toml and the rows of tools/instructions agree, and tools/benchmarks says where they do not.

    page_test.py ROOT
"""
import pathlib
import re
import subprocess
import sys
import tempfile

root = pathlib.Path(sys.argv[1])
PAGE = (root / "docs/benchmarks.md").read_text()
JOBS = (root / "bench/jobs.toml").read_text()
COUNTED = (root / "bench/instructions/table.tsv").read_text()
folder = tempfile.TemporaryDirectory()


def benchmarks(*words, page=PAGE, jobs=JOBS, counted=COUNTED):
    """Calls tools/benchmarks for copies of the page, the jobs and the counted rows; returns its status, what it says, and the page."""
    paths = []
    for name, text in (("page", page), ("jobs", jobs), ("counted", counted)):
        path = pathlib.Path(folder.name) / name
        path.write_text(text)
        paths += ["--" + name, path]
    done = subprocess.run([sys.executable, root / "tools/benchmarks", *words, *paths], capture_output=True, text=True)
    return done.returncode, done.stderr, (pathlib.Path(folder.name) / "page").read_text()


def changed(text, before, after=""):
    """A text in which something is another once."""
    assert text.count(before) >= 1, before
    return text.replace(before, after, 1)


def says(fault, **texts):
    status, said, _ = benchmarks("--check", **texts)
    assert status == 1 and fault in said, (fault, status, said)


status, said, _ = benchmarks("--check")
assert status == 0, said

# tables that nothing makes
says("table without markers: | job | time |", page=PAGE + "\n| job | time |\n|---|---|\n| new | 1 s |\n")
says("engine: bench/jobs.toml does not know this table", jobs=changed(JOBS, 'name    = "engine"', 'name    = "other"'))
says("engine: stands in the page 0 times", page=changed(PAGE, "<!-- table engine -->"))
says("a marker of a table has no other one", page=changed(PAGE, "<!-- end -->"))
says("engine: bench/jobs.toml has neither a row of it nor by_hand",
     jobs=re.sub(r'(name    = "engine"(?:.*\n)*?)\n  \[\[table.row(?:.*\n)*?(?=\[\[table\]\])', r"\1\n", JOBS, count=1))

# rows
row = "| dop853 |"
says("oil films: row is not in bench/jobs.toml: dop854", page=changed(PAGE, row, "| dop854 |"))
says("oil films: row of bench/jobs.toml is not in the page: dop853", page=changed(PAGE, row, "| dop854 |"))
says("linear: row is not in bench/jobs.toml", page=changed(PAGE, "| 40 ms |", "| 45 ms |"))
says("oil films: headings are", page=changed(PAGE, "| tolerance 1e-6 |", "| tolerance 1e-5 |"))

# what is counted
says("oil films: no counted row goes with: dop853", jobs=changed(JOBS, 'counted = ["simulate films dop853"]'))
says("oil films: counts no row simulate films dop8530",
     jobs=changed(JOBS, 'counted = ["simulate films dop853"]', 'counted = ["simulate films dop8530"]'))
says("does not say what is counted as new row", counted=COUNTED + "new row\t1.0\twhirl --version\n")
says("counted: is not what bench/jobs.toml says", page=changed(PAGE, "| [oil films](#oil-films): dop853 |", "| dop853 |"))

# machine, date and commit
measured = re.search(r"<!-- table engine -->(?:.*\n)*?(Measured on .*\n)", PAGE)[1]
says("engine: no line says machine, date and commit", page=changed(PAGE, "\n" + measured + "<!-- end -->", "\n<!-- end -->"))
says("says machine, date and commit", page=re.sub("; commit [0-9a-f]+", "", PAGE, count=1))

if not (root / ".git").exists():  # a table says the commit
    sys.exit()

# jobs that fail leave their table as it is, and the others are written
build = pathlib.Path(folder.name) / "build"
(build / "bin").mkdir(parents=True)
for name, script in (("first", "echo time 2.5 ms"), ("second", "echo no number; exit 3")):
    (build / "bin" / name).write_text(f"#!/bin/sh\n{script}\n")
    (build / "bin" / name).chmod(0o755)
TABLE = """[[table]]
name    = "{name}"
section = "here"
what    = "{name}"
runs    = 3
columns = ["job", "limit set", "measured"]
run     = "{name}"
find    = 'time (?P<number>\\S+) ms'
show    = "{{number}} ms"
counted = ["start"]
  [[table.row]]
  label = "a job"
  limit = "1 s"
"""
EMPTY = "# Here\n<!-- table counted -->\n<!-- end -->\n<!-- table first -->\n<!-- end -->\n<!-- table second -->\nas it is\n<!-- end -->\n"
status, said, page = benchmarks("--as-built", "--build", build, page=EMPTY,
                                jobs=TABLE.format(name="first") + TABLE.format(name="second"))
assert status == 1 and "second stays as it is: second: status 3" in said and "failed: second" in said, said
assert "<!-- table second -->\nas it is\n<!-- end -->" in page, page
assert "| a job | 1 s | 2.5 ms |\n\nMeasured on " in page and "medians of 3 runs.\n<!-- end -->" in page, page
