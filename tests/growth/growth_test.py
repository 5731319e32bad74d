#!/usr/bin/env python3
"""No input costs much more than its size: readers of texts and linear verbs get inputs of
size n, 2n and 4n, and the instructions that these take (callgrind: within 0.4 % the same in every run, whatever else
the machine does) grow as n log n does. Each runs within one limit of memory, too.

usage: growth_test.py WHIRL SOURCE [CASE...]; status 77 without valgrind
"""
import copy
import json
import math
import os
import re
import resource
import shutil
import subprocess
import sys
import tempfile

whirl, source, wanted = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), sys.argv[3:]
MOST = 1.25  # times the growth of n log n: what is there at any size is taken off, rounding of sizes is left
SCATTER = 0.004  # of a count: threads wait for one another and children are waited for, not always as long
MEMORY = 1 << 30  # bytes of addresses, of the largest size

HEAD = """format = 1
gravity = "9.81 m/s^2"
[operation]
speed = "3000 rpm"
[material.steel]
density = "7850 kg/m^3"
youngs_modulus = "210 GPa"
poisson_ratio = 0.3
"""
SHAFT = '[[shaft]]\nlength = "1 m"\nouter_diameter = "50 mm"\nmaterial = "steel"\n'
BEARINGS = "".join(
    f'[[bearing]]\nname = "b{at}"\nat = "{at} m"\nstiffness = "10 MN/m"\ndamping = "1 kN.s/m"\n' for at in (0, 1))
DISK = '[[disk]]\nat = "0.5 m"\nmass = "1 kg"\npolar_inertia = "1e-2 kg.m^2"\ndiametral_inertia = "5e-3 kg.m^2"\n'
UNBALANCE = '[[unbalance]]\nat = "0.5 m"\nmoment = "10 g.mm"\n'
ROTOR = HEAD + SHAFT + BEARINGS


def many(text):
    """A rotor with n times a text; # is the number."""
    return lambda n: ROTOR + "".join(text.replace("#", str(i)) for i in range(n))


def ross(n):
    rotor = json.load(open(os.path.join(source, "models/layered_ross.json"), encoding="utf-8"))
    rotor = copy.deepcopy(rotor)
    for i in range(n):
        rotor[f"DiskElement_{i}"] = {"n": 3, "m": 1.0, "Id": 0.1, "Ip": 0.1, "tag": "same"}
    return json.dumps(rotor)


def record(columns, rows):
    return "".join(",".join(str(math.sin(i + 2 * c)) for c in range(columns)) + "\n" for i in range(rows))


def recorded(file):
    """The readings of a probe over n revolutions, as whirl writes records of that kind."""
    def make(n):
        subprocess.run([whirl, "simulate", "rotor.toml", "--revolutions", str(n), "--discard", "0", "--measure",
                        "probe.toml", "--measured-out", file, "--force", "--quiet"], check=True)
    return make


PROBES = '[[probe]]\nname = "x"\nat = "0.5 m"\nchannel = 1\nunit = "um"\nangle = "0 deg"\n'
IDENTIFY = ["identify", "rotor.toml", "--probes", "probes.toml", "--rate", "1000", "--measured"]
MODELS = {
    "disks": many(DISK.replace("[[disk]]\n", '[[disk]]\nname = "d#"\n')),
    "bearings": many('[[bearing]]\nname = "c#"\nat = "0.5 m"\nstiffness = "1 N/m"\n'),
    "bodies": many('[[body]]\nname = "o#"\nmass = "1 kg"\n[[link]]\nfrom = "o#"\nto = "ground"\nstiffness = "1 N/m"\n'),
    "contacts": many('[[contact]]\nname = "r#"\nat = "0.5 m"\nstiffness = "1 MN/m"\nclearance = "1 mm"\n'
                     'friction = 0.1\nradius = "25 mm"\n'),
    "unbalances": many(UNBALANCE),
    "probes": many('[[probe]]\nname = "p#"\nat = "0.5 m"\nangle = "1 deg"\n'),
    "wrong keys": many('[[disk]]\nnmae# = "d#"\nat = "0.5 m"\n'),
    "segments": lambda n: HEAD + "".join(
        f'[[shaft]]\nlength = "{1 / n} m"\nouter_diameter = "50 mm"\nmaterial = "steel"\nelements = 1\n'
        for _ in range(n)) + BEARINGS,
    "long name": lambda n: ROTOR + DISK.replace("[[disk]]\n", f'[[disk]]\nname = "{"x" * 200 * n}"\n'),
    "long unit": lambda n: ROTOR.replace('"1 m"', f'"1 {"m*" * 50 * n}m"'),
}
# name: n, the file that is made, its text at a size, the command line
CASES = {name: (300, "m.toml", text, ["check", "m.toml"]) for name, text in MODELS.items()}
CASES["disks of one tag"] = (400, "r.json", ross, ["import", "r.json", "--out", "r.toml", "--force"])
CASES["columns"] = (1000, "c.csv", lambda n: record(n, 20), [*IDENTIFY, "c.csv"])
CASES["samples"] = (4000, "s.csv", lambda n: record(2, n), [*IDENTIFY, "s.csv"])
for n, kind in ((800, "h5"), (800, "mat"), (800, "wav"), (200, "uff")):
    CASES[f"samples, .{kind}"] = (n, f"r.{kind}", recorded(f"r.{kind}"),
                                  ["identify", "rotor.toml", "--probes", "probe.toml", "--measured", f"r.{kind}"])
for verb in (["static"], ["modes"], ["campbell", "--speeds", "0:6000:3000rpm"], ["frf", "--frequencies", "0:100:50Hz"],
             ["unbalance", "--speeds", "0:3000:1000rpm"]):
    text = lambda n: HEAD + SHAFT + f"elements = {n}\n" + BEARINGS + DISK.replace("]]\n", ']]\nname = "d"\n') + UNBALANCE
    CASES["elements, " + verb[0]] = (100, "e.toml", text, [verb[0], "e.toml", *verb[1:]])
for n, verb in ((8, ["critical"]), (6, ["lateral", "--maximum-speed", "4000rpm"])):  # dear ones, in small sizes
    CASES["elements, " + verb[0]] = (n, "e.toml", text, [verb[0], "e.toml", *verb[1:]])


def limited():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


def instructions(line):
    counted = subprocess.run(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", whirl, *line],
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
    return int(re.search(r"Collected : (\d+)", counted.stdout).group(1))


def wrong_with(name):
    """What is wrong with a case; empty: nothing."""
    n, file, text, line = CASES[name]
    counts = []
    for size in (n, 2 * n, 4 * n):
        written = text(size)  # None: it has made the file
        if written is not None:
            with open(file, "w", encoding="utf-8") as made:
                made.write(written)
        counts.append(instructions(line))
    within = subprocess.run([whirl, *line], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, preexec_fn=limited)
    scatter = SCATTER * counts[2]
    grown = (counts[2] - counts[1]) / max(1, counts[1] - counts[0])
    least = (counts[2] - counts[1] - scatter) / max(1, counts[1] - counts[0] + scatter)  # that the scatter allows
    log = math.log2
    right = (4 * log(4 * n) - 2 * log(2 * n)) / (2 * log(2 * n) - log(n))
    print(f"{name}: {' '.join(f'{c:.4g}' for c in counts)} instructions, growth {grown:.3f}, of n log n {right:.3f}",
          flush=True)
    if least > MOST * right:
        return f"{name}: grows by {grown:.3f}, n log n by {right:.3f}"
    if within.returncode not in (0, 2) or b"not enough memory" in within.stderr:
        return f"{name}: status {within.returncode} within {MEMORY >> 20} MB: {within.stderr[-200:]!r}"
    return ""


if not shutil.which("valgrind"):
    print("there is no valgrind")
    sys.exit(77)
with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    with open("rotor.toml", "w", encoding="utf-8") as made:
        made.write(ROTOR + DISK.replace("]]\n", ']]\nname = "d"\n'))
    with open("probes.toml", "w", encoding="utf-8") as made:
        made.write(PROBES)
    with open("probe.toml", "w", encoding="utf-8") as made:
        made.write(PROBES.replace("channel = 1\n", ""))
    wrong = [text for name in (wanted or CASES) if (text := wrong_with(name))]
sys.exit("\n".join(wrong) or 0)
