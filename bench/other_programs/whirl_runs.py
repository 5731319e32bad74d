"""The cases by whirl, by SUNDIALS and by Boost.odeint, as whirl's own programs measure them."""
import json
import math
import re
import subprocess

from .cases import MODELS
from .rows import Row, parsed

METHODS = {"taylor": "whirl taylor", "collocation": "whirl collocation", "dop853": "whirl dop853",
           "cvode-adams": "SUNDIALS cvode-adams", "arkode": "SUNDIALS arkode"}
TOLERANCES = ("1e-4", "1e-6", "1e-8", "1e-10", "1e-12", "1e-13")
ODEINT = "odeint dopri5"


def rows_of_bench(text, case_name):
    """Rows of what `whirl bench --json` wrote, and the error of its reference."""
    read = json.loads(text)
    rows = [Row(case_name, METHODS[run["method"]], f"{run['tolerance']:g}", number(run["error"]),
                number(run["ns_per_revolution"]) / 1e3) for run in read["runs"]]
    return rows, read["reference"]["error"]


def number(value):
    return math.nan if value is None else float(value)


def bench(problem, programs):
    """Runs `whirl bench` on a case."""
    words = [programs / "whirl", "bench", MODELS / problem.model, "--discard", str(problem.settled), "--methods",
             ",".join(METHODS), "--tolerances", ",".join(TOLERANCES), "--quiet", "--json", "-"]
    return rows_of_bench(subprocess.run(words, check=True, capture_output=True, text=True).stdout, problem.name)


def rows_of_work_precision(text):
    """Rows of Boost.odeint on P1 in what `whirl_work_precision` printed."""
    first = text.split("P3,")[0]
    found = re.findall(r"odeint-dopri5 +(\S+) +(\S+) +(\S+)", first)
    return [Row("P1", ODEINT, f"{float(tolerance):g}", float(error), float(ns) / 1e3)
            for tolerance, error, ns in found if error != "-"]


def odeint_on_p1(programs):
    done = subprocess.run([programs / "whirl_work_precision"], check=True, capture_output=True, text=True)
    return rows_of_work_precision(done.stdout)


def odeint_on_matrices(case, programs, folder):
    """Boost.odeint on any case, by a program that reads its numbers."""
    parts = (case.stiffness, case.damping, case.load, case.cosine, case.sine, case.gap, case.by_force, case.mu,
             case.rim, case.start, case.end)
    numbers = [f"{x:.17g}" for part in parts for x in (part.ravel() if hasattr(part, "ravel") else [part])]
    path = folder / "case.txt"
    path.write_text("\n".join([str(case.size), *numbers, ""]))
    done = subprocess.run([programs / "whirl_odeint", path], check=True, capture_output=True, text=True)
    return [row._replace(case=case.name, program=ODEINT) for row in parsed(done.stdout)]
