"""Error and time of a program at its settings, the time for an error that follows from them, and lines of both."""
import math
import re
from typing import NamedTuple

TARGET = 1e-6  # the error for which times are compared
NUMBER = r"[-+.\deE]+|nan|inf"
ROW = re.compile(rf"^(?P<case>[^|\n]+) \| (?P<program>[^|\n]+) \| (?P<setting>[^|\n]+) \| (?P<error>{NUMBER})"
                 rf" \| (?P<us>{NUMBER}) us$", re.M)


class Row(NamedTuple):
    """A program at one of its settings."""
    case: str
    program: str
    setting: str  # tolerance, or steps of a revolution
    error: float  # NaN: it failed
    us: float     # of a revolution

    def line(self):
        return f"{self.case} | {self.program} | {self.setting} | {self.error:.2e} | {self.us:.5g} us"


def parsed(text):
    """The rows in what a program printed; other lines are passed over."""
    return [Row(m["case"], m["program"], m["setting"], float(m["error"]), float(m["us"])) for m in ROW.finditer(text)]


def by_program(rows):
    """Lists of rows by program, in the order in which they came."""
    programs = {}
    for row in rows:
        programs.setdefault(row.program, []).append(row)
    return programs


def good(rows):
    return [row for row in rows if math.isfinite(row.error) and math.isfinite(row.us) and row.us > 0.0]


def least_error(rows):
    """None where every setting failed."""
    return min((row.error for row in good(rows)), default=None)


def time_for(rows, target=TARGET):
    """Time of a revolution [us] for an error, and whether that is only an upper bound; None where it is not reached.

    Rows go from loose to tight. The time is interpolated, both logarithmic, between the last setting above the target
    and the next one: an error that is small by chance at a loose setting does not count. Where no setting is above,
    the loosest one is a bound.
    """
    rows = good(rows)
    above = [i for i, row in enumerate(rows) if row.error > target]
    if not rows or (above and above[-1] == len(rows) - 1):
        return None
    if not above:
        return rows[0].us, True
    a, b = rows[above[-1]], rows[above[-1] + 1]
    if b.error <= 0.0:
        return b.us, True
    share = math.log(a.error / target) / math.log(a.error / b.error)
    return math.exp((1.0 - share) * math.log(a.us) + share * math.log(b.us)), False


def rounded(x):
    """Two digits, three where the first one is 1."""
    digits = 3 if f"{x:e}".startswith("1") else 2
    x = float(f"{x:.{digits - 1}e}")
    return f"{x:.{max(0, digits - 1 - math.floor(math.log10(x)))}f}"


def time_text(us):
    for unit, size in (("us", 1.0), ("ms", 1e3)):
        if float(rounded(us / size)) < 1000.0:
            return f"{rounded(us / size)} {unit}"
    return f"{rounded(us / 1e6)} s"


def error_text(error):
    return re.sub(r"e-0*", "e-", f"{error:.0e}") if error else "0"


def cells(rows):
    """Of a program on a case: its least error, and its time for the target."""
    if not rows:
        return ["-", "-"]
    least, time = least_error(rows), time_for(rows)
    reached = "not reached" if time is None else ("at most " if time[1] else "") + time_text(time[0])
    return ["failed" if least is None else error_text(least), reached]


def summary(rows, cases):
    """A line per program: name, then least error and time for the target on every case."""
    lines = []
    for program, own in by_program(rows).items():
        parts = [cell for case in cases for cell in cells([row for row in own if row.case == case])]
        lines.append(" | ".join(["summary", program, *parts]))
    return lines
