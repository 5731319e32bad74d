#!/usr/bin/python3
"""Error and time of whirl beside other programs, on two cases.

    bench/others.py [--build FOLDER] [--svg FILE] [--octave PATH] [--siconos FOLDER] [--xppaut PATH]
    bench/others.py --cases "P1,two disks" --programs whirl,scipy,xppaut,octave,siconos    some of them only

The cases are P1, the rotor and stator with five impacts a revolution, and the rotor of models/two_disk_mac.toml. whirl
makes matrices, start and end; every program integrates the same equations from the same start over 20 revolutions. A
program is looked for where its option says, else where the system has it; one that is not there is told and left out.
Nothing is fetched. Errors are the largest difference of all states from whirl's end, displacements by the clearance,
velocities by that times Omega. Times are of a processor. Lines are

    CASE | PROGRAM | SETTING | ERROR | TIME us
    summary | PROGRAM | least error | time for 1e-6 | and both of the next case
"""
import argparse
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

os.environ["OPENBLAS_NUM_THREADS"] = os.environ["OMP_NUM_THREADS"] = "1"  # before numpy: one core for everybody
import numpy  # noqa: E402, F401

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "bench"))
from other_programs import figure, octave_runs, rows, whirl_runs, xppaut_runs  # noqa: E402
from other_programs.cases import PROBLEMS, case_of  # noqa: E402
from other_programs.timing import rows_of_process  # noqa: E402

FAMILIES = ("whirl", "scipy", "xppaut", "octave", "siconos")  # whirl with SUNDIALS and Boost.odeint
AGREEMENT = 1e-9  # what the end by SciPy may differ from whirl's, else the equations are not the same ones


# --- programs that may be absent

def left_out(name, how):
    print(f"{name}: not found, its rows are left out ({how})", flush=True)


def executable(package, name, path):
    """Where a program is, or None, which is told."""
    found = shutil.which(path or name)
    if not found:
        left_out(package, f"Debian: {package}; or --{package} PATH")
    return found


def environment_of(folder):
    """Of a Python that finds a package in a folder."""
    return {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, [folder, os.environ.get("PYTHONPATH")]))}


def has_siconos(folder):
    words = [sys.executable, "-c", "import siconos.kernel"]
    if subprocess.run(words, env=environment_of(folder), capture_output=True).returncode == 0:
        return True
    left_out("siconos", "Debian: python3-siconos; or --siconos FOLDER, the one with its Python package")
    return False


def has_scipy():
    try:
        import scipy.integrate  # noqa: F401
    except ImportError:
        left_out("scipy", "Debian: python3-scipy")
        return False
    return True


def present(asked):
    """Of the families that are asked for, what is there: True, or a path."""
    looks = {"whirl": lambda: True, "scipy": has_scipy, "xppaut": lambda: executable("xppaut", "xppaut", asked.xppaut),
             "octave": lambda: executable("octave", "octave-cli", asked.octave),
             "siconos": lambda: has_siconos(asked.siconos)}
    return {name: looks[name]() for name in asked.programs}


# --- runs

def whirl_and_libraries(problem, case, asked, folder):
    """whirl, SUNDIALS and Boost.odeint, by the programs of the build."""
    programs = asked.build / "bin"
    found, own_error = whirl_runs.bench(problem, programs)
    print(f"{problem.name}: `whirl bench` has a reference of its own, whose error is about {own_error:.0e}")
    if problem.name == "P1" and (programs / "whirl_work_precision").exists():
        found += whirl_runs.odeint_on_p1(programs)
    elif (programs / "whirl_odeint").exists():
        found += whirl_runs.odeint_on_matrices(case, programs, folder)
    else:
        left_out("odeint", f"whirl_work_precision and whirl_odeint in {programs}")
    return found


def siconos(case, asked, folder):
    path = folder / "case.npz"
    case.save(path)
    words = [sys.executable, ROOT / "bench/other_programs/siconos_runs.py", path]
    return rows_of_process(words, folder, environment_of(asked.siconos))


def scipy(case):
    from other_programs import scipy_runs
    found = scipy_runs.run(case)
    difference = rows.least_error([row for row in found if row.program == "SciPy DOP853"])
    print(f"{case.name}: SciPy's DOP853 ends {difference or math.nan:.0e} from whirl's collocation at 1e-14")
    if difference is None or difference > AGREEMENT:
        sys.exit(f"{case.name}: SciPy goes elsewhere: the equations given to other programs are not those of the model")
    return found


def measured(problem, asked, there):
    """All rows of a case."""
    case, own_error = case_of(problem, asked.whirl)
    print(f"{problem.name}: whirl's own methods end {own_error:.0e} from one another", flush=True)
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        runs = {"whirl": lambda: whirl_and_libraries(problem, case, asked, folder),
                "scipy": lambda: scipy(case),
                "xppaut": lambda: xppaut_runs.run(case, there["xppaut"], folder),
                "octave": lambda: octave_runs.run(case, there["octave"], folder),
                "siconos": lambda: siconos(case, asked, folder)}
        found = []
        for name in filter(there.get, FAMILIES):
            for row in runs[name]():
                found.append(row)
                print(row.line(), flush=True)
    return found


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=pathlib.Path, default=os.environ.get("WHIRL_BUILD", ROOT / "build/release"))
    parser.add_argument("--cases", default=",".join(problem.name for problem in PROBLEMS))
    parser.add_argument("--programs", default=",".join(FAMILIES))
    parser.add_argument("--svg", type=pathlib.Path)
    parser.add_argument("--octave", help="program of Octave, without windows")
    parser.add_argument("--siconos", help="folder with the Python package siconos")
    parser.add_argument("--xppaut", help="program of XPPAUT")
    asked = parser.parse_args()
    asked.build = pathlib.Path(asked.build).resolve()
    asked.cases, asked.programs = asked.cases.split(","), asked.programs.split(",")
    unknown = set(asked.cases) - {problem.name for problem in PROBLEMS} | set(asked.programs) - set(FAMILIES)
    if unknown:
        parser.error(f"unknown: {', '.join(sorted(unknown))}")
    return asked


def whirl_package(build):
    sys.path.insert(0, str(build / "python"))
    try:
        import whirl
    except ImportError as error:
        sys.exit(f"the Python package of whirl is not in {build}/python: {error}")
    return whirl


def main():
    asked = arguments()
    asked.whirl = whirl_package(asked.build)
    there = present(asked)
    problems = [problem for problem in PROBLEMS if problem.name in asked.cases]
    found = [row for problem in problems for row in measured(problem, asked, there)]
    print("\n".join(rows.summary(found, [problem.name for problem in problems])))
    if asked.svg:
        asked.svg.write_text(figure.drawn([(problem.title, [row for row in found if row.case == problem.name])
                                           for problem in problems]), encoding="utf-8")


if __name__ == "__main__":
    main()
