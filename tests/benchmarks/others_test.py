#!/usr/bin/env python3
"""bench/others.py: times for an error, what is read of programs, the figure, and that an absent program is told.

    others_test.py ROOT
"""
import contextlib
import importlib.util
import io
import json
import math
import pathlib
import re
import sys
import types
import xml.etree.ElementTree

try:
    import numpy as np
except ImportError:
    sys.exit(77)

root = pathlib.Path(sys.argv[1])
sys.dont_write_bytecode = True
spec = importlib.util.spec_from_file_location("others", root / "bench/others.py")
others = importlib.util.module_from_spec(spec)
spec.loader.exec_module(others)
from other_programs import cases, figure, octave_runs, rows, whirl_runs, xppaut_runs  # noqa: E402
from other_programs.rows import Row  # noqa: E402


def of(*points, program="whirl taylor", case="P1"):
    """Rows of a program from (error, us)."""
    return [Row(case, program, f"1e-{2 * i}", *point) for i, point in enumerate(points)]


def said(call):
    """What a call returns and prints."""
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        result = call()
    return result, out.getvalue()


# times for an error of 1e-6
nan = math.nan
assert math.isclose(rows.time_for(of((1e-4, 10.0), (1e-8, 1000.0)))[0], 100.0)  # a straight line, both logarithmic
assert math.isclose(rows.time_for(of((1e-5, 10.0), (1e-6, 20.0)))[0], 20.0)  # exactly reached
assert rows.time_for(of((1e-4, 10.0), (2e-6, 1000.0))) is None
assert rows.time_for(of((1e-7, 10.0), (1e-9, 20.0))) == (10.0, True)  # below from the first setting on
assert rows.time_for([]) is None and rows.time_for(of((nan, nan))) is None
small_by_chance, failed = (1e-7, 5.0), (nan, nan)  # do not count
assert math.isclose(rows.time_for(of(small_by_chance, (1e-5, 10.0), (1e-7, 1000.0)))[0], 100.0)
assert math.isclose(rows.time_for(of((1e-4, 10.0), failed, (1e-8, 1000.0)))[0], 100.0)
assert rows.time_for(of((1e-4, 10.0), (1e-8, -0.5))) is None  # nor a time that is none
assert rows.least_error(of((1e-4, 1.0), (1e-9, 2.0), (3e-9, 3.0))) == 1e-9
assert rows.least_error(of((nan, 1.0))) is None

# texts
assert [rows.time_text(us) for us in (7.234, 13.46, 104.0, 999.6, 1234.0, 8.16e5, 1.78e6)] == [
    "7.2 us", "13.5 us", "104 us", "1.0 ms", "1.23 ms", "820 ms", "1.78 s"]
assert rows.error_text(3.6e-12) == "4e-12" and rows.error_text(0.0) == "0"
both = [*of((1e-4, 10.0), (1e-8, 1000.0)), *of((1e-2, 1.0), (1e-3, 5.0), case="two disks"),
        *of((1e-7, 3.0), program="Siconos")]
assert rows.summary(both, ["P1", "two disks"]) == ["summary | whirl taylor | 1e-8 | 100 us | 1e-3 | not reached",
                                                  "summary | Siconos | 1e-7 | at most 3.0 us | - | -"]
text = "P1: a remark\n" + "\n".join(row.line() for row in both) + "\nanother | remark\nP1 | x | 1e-4 | nan | nan us\n"
assert rows.parsed(text)[:-1] == both and math.isnan(rows.parsed(text)[-1].error)  # the first row after a remark, too

# what whirl's programs print
bench = {"reference": {"error": 4e-17}, "runs": [
    {"method": "taylor", "tolerance": 1e-06, "error": 2e-6, "ns_per_revolution": 7500.0},
    {"method": "arkode", "tolerance": 1e-06, "error": None, "ns_per_revolution": None}]}
found, own = whirl_runs.rows_of_bench(json.dumps(bench), "P1")
assert found[0] == Row("P1", "whirl taylor", "1e-06", 2e-6, 7.5) and own == 4e-17
assert found[1].program == "SUNDIALS arkode" and rows.least_error(found[1:]) is None
precision = """P1, five
  dop853         1e-06  1.4e-06  104858
  odeint-dopri5  1e-08  1.4e-05   49703
P3, permanent
  odeint-dopri5  1e-08  3.3e-09   64800
"""
assert whirl_runs.rows_of_work_precision(precision) == [Row("P1", "odeint dopri5", "1e-08", 1.4e-5, 49.703)]

# a case as other programs are given it
one = np.array([[1.0, 0.0], [0.0, 1.0]])
case = cases.Case("P1", 2.5 * one, 0.1 * one, np.array([0.0, -0.1]), np.array([0.2, 0.0]), np.array([0.0, 0.2]), one,
                  300.0 * one, 0.1, 16.0, np.array([0.5, 0.0, 0.0, 0.5]), np.array([0.25, 0.0, 0.0, 0.5]))
assert case.error(case.start) == 0.25 and math.isnan(case.error([nan, 0, 0, 0]))
ode = xppaut_runs.file_of(case, "83dp", 1e-8, 20).splitlines()
assert "dx=0+1*p0" in ode and "k1=0-2.5*p1" in ode and "init v1=0.5" in ode and ode[-1] == "done"
assert "v0'=0+0+0.20000000000000001*ct-300*fx+k0+c0" in ode
end = "6.28 0 0 0 0 9 9 9 9\n125.6637 0.25 0 0 0.5 1e-9 -3e-8 0 0\n131.9 0 0 0 0 7 7 7 7\n"
assert xppaut_runs.error_in(end, 2) == 3e-8 and math.isnan(xppaut_runs.error_in("1 2 3\n", 2))
assert octave_runs.matrix(one) == "[1 0;0 1]" and octave_runs.matrix(0.5) == "[0.5]"
assert octave_runs.matrix(case.load) == "[0;-0.10000000000000001]"

# the figure
svg = figure.drawn([("first", both), ("second & third", [])])
xml.etree.ElementTree.fromstring(svg.encode())
assert {"whirl taylor", "Siconos", "first", "second &amp; third"} <= set(re.findall(r">([^<>]+)</text>", svg))
put = figure.spread([5.0, 6.0, 300.0, 4.0, 399.0], 0.0, 400.0)
order = sorted(put.values())
assert all(b - a >= figure.STEP for a, b in zip(order, order[1:])) and order[0] >= 0.0 and order[-1] <= 400.0
assert put[3] < put[0] < put[1] < put[2] < put[4]

# programs that are not there are told, the others are measured
asked = types.SimpleNamespace(xppaut="/nowhere/xppaut", octave="/nowhere/octave", siconos="/nowhere",
                              programs=list(others.FAMILIES))
python, sys.executable = sys.executable, "false"
there, told = said(lambda: others.present(asked))
sys.executable = python
assert not there["xppaut"] and not there["octave"] and not there["siconos"] and there["whirl"]
for name in ("xppaut", "octave", "siconos"):
    assert f"{name}: not found, its rows are left out" in told, told
asked.whirl = None
others.case_of = lambda problem, whirl: (case, 0.0)
others.whirl_and_libraries = lambda *_: of((1e-4, 10.0))
found, told = said(lambda: others.measured(cases.PROBLEMS[0], asked, there | {"scipy": False}))
assert found == of((1e-4, 10.0)) and "P1 | whirl taylor | 1e-0 | 1.00e-04 | 10 us\n" in told
