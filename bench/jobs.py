"""Jobs of bench/jobs.toml: what they are, how they run, and what their numbers are as texts. For tools/benchmarks.

    tables, also = read_jobs(path)
    rows = measure(tables["linear"], Runner(build, folder), 5)    # cells of every row; JobFailed says what gave no number
"""
import collections
import json
import math
import os
import pathlib
import re
import shlex
import statistics
import string
import subprocess
import tempfile
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent
LIMIT = "limit set"  # heading of its column
UNITS = {"": 1.0, "%": 0.01, "us": 1e-6, "ms": 1e-3, "s": 1.0, "min": 60.0, "MB": 1e6, "GB": 1e9}


class JobFailed(Exception):
    """A job that gives no number; says which one and why."""


# --- numbers

def rounded(x, digits=None):
    """A number to two digits, to three where the first one is 1, or to so many digits."""
    if x == 0.0:
        return "0"
    digits = digits or (3 if f"{abs(x):e}".startswith("1") else 2)
    x = float(f"{x:.{digits - 1}e}")
    return f"{x:.{max(0, digits - 1 - math.floor(math.log10(abs(x))))}f}"


class Values:
    """What a job gives by one name: a number, or several of as many matches."""

    def __init__(self, values):
        self.values = values

    least = property(lambda self: Values([min(self.values)]))
    most = property(lambda self: Values([max(self.values)]))
    sum = property(lambda self: Values([sum(self.values)]))

    def __format__(self, unit):
        if len(self.values) != 1:
            raise JobFailed(f"gives {len(self.values)} numbers where one is expected")
        x = self.values[0]
        if unit == "n":
            return f"{x:.0f}"
        if unit == "e":
            return re.sub(r"e-0*", "e-", f"{x:.0e}") if x else "0"
        if unit == "g":
            return f"{x:g}"
        if unit.isdigit():
            return rounded(x, int(unit))
        return rounded(x / UNITS[unit])


# --- jobs

Table = collections.namedtuple("Table", "name columns rows settings")
Row = collections.namedtuple("Row", "labels limit settings")


def filled(value, texts):
    """A text, or a list of texts, in which $name is the text of this name."""
    if isinstance(value, list):
        return [filled(one, texts) for one in value]
    return string.Template(value).safe_substitute(texts) if isinstance(value, str) else value


def read_jobs(path):
    """The tables of bench/jobs.toml, and what else is counted."""
    read = tomllib.loads(path.read_text())
    tables = {}
    for table in read["table"]:
        rows = []
        for row in table.pop("row", []):
            settings = {**table, **row}
            settings = {key: filled(value, row) for key, value in settings.items()}
            label = settings["label"]
            limit = settings.get("limit", "") if LIMIT in table["columns"] else None
            rows.append(Row(label if isinstance(label, list) else [label], limit, settings))
        tables[table["name"]] = Table(table["name"], table.get("columns", []), rows, table)
    return tables, read.get("also", [])


def fixed_cells(row):
    """Cells of a row that are not measured."""
    return row.labels + ([] if row.limit is None else [row.limit])


def of_column(settings, key, i):
    """What a row says for its measured column i: one for all columns, or a list."""
    value = settings.get(key, "")
    return value[i] if isinstance(value, list) else value


# --- runs

Outcome = collections.namedtuple("Outcome", "text seconds bytes sizes")


class Runner:
    """Runs commands in a folder of their own and keeps what they gave: tables share commands."""

    def __init__(self, build, place):
        self.build, self.place = build, place
        self.outcomes = collections.defaultdict(list)
        for name in ("models", "bench", "tests", "docs"):
            (place / name).symlink_to(ROOT / name)

    def run(self, command, sized=""):
        """Runs a command once more; the size of a file that it makes is kept with it."""
        words = shlex.split(command)
        words[0] = str(ROOT / words[0] if "/" in words[0] else self.build / "bin" / words[0])  # a script, or a program
        environment = {"PATH": os.environ["PATH"], "HOME": str(self.place), "TMPDIR": str(self.place), "TERM": "dumb",
                       "LC_ALL": "C.UTF-8", "WHIRL_BUILD": str(self.build)}
        with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as errors:
            try:
                process = subprocess.Popen(words, cwd=self.place, env=environment, stdout=out, stderr=errors)
            except OSError as error:
                raise JobFailed(f"{command}: {error}") from error
            _, status, used = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            out.seek(0)
            errors.seek(0)
            if process.returncode:
                raise JobFailed(f"{command}: status {process.returncode}: {errors.read()[-2000:]}")
            sizes = [(self.place / sized).stat().st_size] if sized and (self.place / sized).exists() else []
            self.outcomes[command].append(
                Outcome(out.read(), used.ru_utime + used.ru_stime, 1024.0 * used.ru_maxrss, sizes))


def command_of_benchmarks(names):
    """One process for all benchmarks of a table, so that they share what they prepare."""
    alone = "|".join(re.escape(name) for name in names)
    return f"whirl_bench --benchmark_format=json --benchmark_filter='^({alone})$'"


def sources(table):
    """Commands of a table without repetitions, with the file of which the size is asked for, and its benchmarks."""
    commands, names = {}, []
    for row in table.rows:
        for i in range(len(table.columns) - len(fixed_cells(row))):
            name, command = of_column(row.settings, "bench", i), of_column(row.settings, "run", i)
            if name and name not in names:
                names.append(name)
            elif command:
                commands[command] = row.settings.get("size_of", "")
    return commands, names


def values_of_benchmark(outcome, name):
    """Time of a benchmark in seconds, and its counters."""
    for job in json.loads(outcome.text)["benchmarks"]:
        if job["name"] == name and not job.get("error_occurred"):
            values = {key: [value] for key, value in job.items() if isinstance(value, (int, float))}
            return values | {"time": [job["cpu_time"] * {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}[job["time_unit"]]]}
    raise JobFailed(f"{name}: whirl_bench gives no time of it")


def values_of_program(outcome, settings, find):
    """Time, memory, size of a file, and named groups of an expression in what a program printed."""
    values = {"time": [outcome.seconds], "memory": [outcome.bytes], "size": outcome.sizes}
    if "per" in settings:
        values["each"] = [outcome.seconds / settings["per"]]
    for match in re.finditer(find, outcome.text, re.M) if find else ():
        for name, text in match.groupdict().items():
            values.setdefault(name, []).append(float(text))
    if "share" in settings:
        part, whole = settings["share"]
        values["share"] = [a / b for a, b in zip(values.get(part, []), values.get(whole, []))]
    return values


def medians(runs):
    """Of the values of several runs."""
    together = {}
    for name in runs[0]:
        if len({len(run.get(name, [])) for run in runs}) != 1:
            raise JobFailed(f"does not give as many numbers {name} in every run")
        together[name] = Values([statistics.median(of_runs) for of_runs in zip(*(run[name] for run in runs))])
    return together


def printed(outcome, find, i):
    """A cell as a program prints it."""
    match = re.search(find, outcome.text, re.M)
    if not match or not match.groups():
        raise JobFailed(f"does not print {find}")
    return match[min(i, len(match.groups()) - 1) + 1]


def is_too_slow(values, limit):
    """Whether a time is above a limit such as 40 ms."""
    number, _, unit = limit.partition(" ")
    return "time" in values and values["time"].values[0] > float(number) * UNITS[unit]


def measured_cell(settings, i, outcomes, limit):
    """The cell of a measured column, from outcomes of every run by command."""
    name, command = of_column(settings, "bench", i), of_column(settings, "run", i)
    find, show = of_column(settings, "find", i), of_column(settings, "show", i)
    if not name and not command:
        return ""
    try:
        if name:
            values = medians([values_of_benchmark(run, name) for run in outcomes[name]])
        elif show:
            values = medians([values_of_program(run, settings, find) for run in outcomes[command]])
        else:
            return printed(outcomes[command][0], find, 0 if isinstance(settings["find"], list) else i)
        shown = show.format(**values)
    except (JobFailed, KeyError, ValueError) as error:
        raise JobFailed(f"{name or command}: {error}") from error
    return f"**{shown}**" if limit and i == 0 and is_too_slow(values, limit) else shown


def measure(table, runner, runs):
    """Runs the jobs of a table, in turns, and returns its rows as lists of cells."""
    commands, names = sources(table)
    together = command_of_benchmarks(names)
    if names:
        commands[together] = ""
    for command in table.settings.get("before", []):
        runner.run(command)
    for i in range(runs):
        for command, sized in commands.items():
            if len(runner.outcomes[command]) <= i:
                print(f"{table.name}: run {i + 1} of {runs}: {command[:90]}", flush=True)
                runner.run(command, sized)
    outcomes = {command: runner.outcomes[command][:runs] for command in commands}
    outcomes |= {name: outcomes[together] for name in names}
    rows = []
    for row in table.rows:
        fixed = fixed_cells(row)
        rows.append(fixed + [measured_cell(row.settings, i, outcomes, row.limit)
                             for i in range(len(table.columns) - len(fixed))])
    return rows
