"""The cases as a user of XPPAUT writes them: a file of equations, run without its window.

XPPAUT writes what it computed in single precision. Differences from the end are variables of the file, which it
computes in double; of them it writes six digits. Its time is that of a long run less that of a short one, by the
revolutions between.
"""
import math
import resource
import statistics
import subprocess

from .cases import END, REVOLUTIONS
from .rows import Row

METHODS = ("83dp", "cvode", "qualrk")
TOLERANCES = (1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13)
MORE = 100  # revolutions of the long run beyond those of the short one
PIECES = 8  # of a revolution: CVODE takes 2000 steps at most from one to the next
RUNS = 3


def total(factors, names):
    """A sum of products; XPPAUT knows no sign at its beginning."""
    terms = [f"{factor:+.17g}*{name}" for factor, name in zip(factors, names) if factor != 0.0]
    return "0" + "".join(terms)


def equations(case):
    n = case.size
    p, v = [f"p{i}" for i in range(n)], [f"v{i}" for i in range(n)]
    lines = [f"{name}={total(row, of)}" for name, row, of in
             (("dx", case.gap[0], p), ("dy", case.gap[1], p), ("ux", case.gap[0], v), ("uy", case.gap[1], v))]
    lines += ["r=sqrt(dx^2+dy^2)",
              f"mu=if({case.rim:.17g}+(dx*uy-dy*ux)/r>=0)then({case.mu:.17g})else(-{case.mu:.17g})",
              "w=if(r>1)then(1-1/r)else(0)", "fx=w*(dx-mu*dy)", "fy=w*(dy+mu*dx)", "ct=cos(t)", "st=sin(t)"]
    lines += [f"k{i}={total(-case.stiffness[i], p)}" for i in range(n)]
    lines += [f"c{i}={total(-case.damping[i], v)}" for i in range(n)]
    lines += [f"p{i}'=v{i}" for i in range(n)]
    for i in range(n):
        loads = total((case.cosine[i], case.sine[i], *-case.by_force[i]), ("ct", "st", "fx", "fy"))
        lines.append(f"v{i}'={case.load[i]:.17g}+{loads}+k{i}+c{i}")
    lines += [f"init {name}={x:.17g}" for name, x in zip(p + v, case.start)]
    lines += [f"aux e{name}={name}-({x:.17g})" for name, x in zip(p + v, case.end)]
    return lines


def file_of(case, method, tolerance, revolutions):
    """A whole file; one point a revolution is written."""
    turn = 2.0 * math.pi
    options = (f"@ total={turn * revolutions:.17g},dt={turn / PIECES:.17g},nout={PIECES},meth={method},"
               f"toler={tolerance:g},atoler={tolerance:g},bound=1e9,maxstor=100000")
    return "\n".join([*equations(case), options, "done", ""])


def one_run(program, case, method, tolerance, revolutions, folder):
    """Error at REVOLUTIONS, NaN where it did not come so far, and processor time of the process."""
    (folder / "case.ode").write_text(file_of(case, method, tolerance, revolutions))
    out = folder / "out.dat"
    out.unlink(missing_ok=True)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([program, "-silent", "case.ode", "-outfile", "out.dat"], cwd=folder, capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return error_in(out.read_text() if out.exists() else "", case.size), seconds


def error_in(text, size):
    """Of the point of the end in what XPPAUT wrote: time, states, differences."""
    for line in text.splitlines():
        numbers = [float(word) for word in line.split()]
        if len(numbers) == 1 + 4 * size and abs(numbers[0] - END) < 1e-3:
            return max(map(abs, numbers[-2 * size:]))
    return math.nan


def run(case, program, folder):
    for method in METHODS:
        for tolerance in TOLERANCES:
            def times(revolutions):
                return [one_run(program, case, method, tolerance, revolutions, folder) for _ in range(RUNS)]
            short, long = times(REVOLUTIONS), times(REVOLUTIONS + MORE)
            seconds = (statistics.median(s for _, s in long) - statistics.median(s for _, s in short)) / MORE
            yield Row(case.name, f"XPPAUT {method}", f"{tolerance:g}", short[0][0], 1e6 * seconds)
