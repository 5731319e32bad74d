#!/usr/bin/env python3
"""What a user sees of bad records: the rows of the tables in docs/measured.md, tried.

A good record of the bouncing two-disk rotor is damaged in one way each; whirl must note it or refuse it,
with these words, and must note nothing where all is well.

    bad_data_test.py WHIRL SOURCE
"""

import random
import re
import subprocess
import sys
import tempfile
from pathlib import Path

WHIRL, SOURCE = Path(sys.argv[1]), Path(sys.argv[2])
MODEL = SOURCE / "models" / "two_disk_mac.toml"
NAMES = ["time [s]", "DE x [um]", "DE y [um]", "ring x [um]", "ring y [um]", "key [V]"]
T, DE_X, DE_Y, RING_X, RING_Y, KEY = range(6)
PROBES = "".join(f'[[probe]]\nname = "{name}"\nnode = {node}\nangle = "{angle} deg"\n'
                 for name, node, angle in (("DE x", 4, 0), ("DE y", 4, 90), ("ring x", 7, 0), ("ring y", 7, 90)))
WITH_KEY = PROBES + '[keyphasor]\nchannel = "key"\n'


class Bench:
    """A good record, and what is said of damaged ones."""

    def __init__(self, folder):
        self.folder, self.failures, self.count = folder, [], 0
        (folder / "p.toml").write_text(WITH_KEY)
        done = self.call("simulate", MODEL, "--revolutions", "80", "--discard", "20", "--measure", "p.toml",
                         "--noise", "1%", "--measured-out", "good.csv")
        assert done.returncode == 0, done.stderr
        lines = (folder / "good.csv").read_text().splitlines()
        self.good = [[float(cell) for cell in line.split(",")] for line in lines[3:]]
        for row in self.good:
            row[DE_X:KEY] = [1e6 * v for v in row[DE_X:KEY]]

    def call(self, *words):
        return subprocess.run([str(WHIRL), *map(str, words)], cwd=self.folder, capture_output=True, text=True,
                              timeout=60)

    def rows(self, change=None):
        rows = [row[:] for row in self.good]
        for row in rows:
            if change:
                change(row)
        return rows

    def set(self, column, value):
        """A record with one column computed anew from its rows."""
        def change(row):
            row[column] = value(row)
        return self.rows(change)

    def try_record(self, content, *expected, names=NAMES, probes=WITH_KEY, more=(), cell=repr, delimiter=","):
        """Expects a refusal (words after "error:") or exactly these notes, in their order."""
        self.count += 1
        if not isinstance(content, str):
            content = delimiter.join(names) + "\n" + "".join(
                delimiter.join("" if v is None else v if isinstance(v, str) else cell(v) for v in row) + "\n"
                for row in content)
        (self.folder / "r.csv").write_text(content)
        (self.folder / "p.toml").write_text(probes)
        done = self.call("identify", MODEL, "--measured", "r.csv", "--probes", "p.toml", "--modes", "4", *more)
        where = f"line {sys._getframe(1).f_lineno}"
        if expected and expected[0].startswith("error:"):
            if done.returncode != 2 or expected[0][6:].strip() not in done.stderr:
                self.failures.append(f"{where}: expected {expected[0]!r}, status {done.returncode}: {done.stderr}")
            return ""
        notes = re.findall(r"note: (.*)", done.stdout)
        if done.returncode != 0 or len(notes) != len(expected) or not all(
                part in note for part, note in zip(expected, notes)):
            self.failures.append(f"{where}: expected notes {expected}, found {notes} {done.stderr}")
        return done.stdout


def try_samples(b):
    n, choose = len(b.good), random.Random(1)
    missing = "channels %s: 7 of" % ", ".join('"%s"' % name.split(" [")[0] for name in NAMES[1:])
    rows = b.rows()
    for j in choose.sample(range(n), 20):
        rows[j][DE_X] = None
    b.try_record(rows, 'channel "DE x": 20 of')
    rows = b.rows()
    for j in range(300, 310):
        rows[j][DE_Y] = "NaN"
    b.try_record(rows, 'channel "DE y": 10 of')
    gap = next(j for j in range(700, n) if b.good[j][KEY] > 0.5 >= b.good[j - 1][KEY]) + 20  # between two pulses
    b.try_record(b.good[:gap] + b.good[gap + 7:], missing)
    b.try_record(b.good[:700] + b.good[1000:], "error: 300 of")
    b.try_record(b.good[:700] + b.good[699:], "error: sample 701 is at")
    b.try_record(b.good[:700] + b.good[800:700:-1] + b.good[801:], "error: expected times that ascend")
    b.try_record(b.set(T, lambda r: round(r[T], 3)), "error: with all their digits")
    b.try_record(b.set(DE_X, lambda r: max(-1500.0, min(1500.0, r[DE_X]))), 'channel "DE x" is clipped')
    b.try_record(b.set(DE_X, lambda r: min(1500.0, r[DE_X])), 'channel "DE x" is clipped')
    b.try_record(b.set(RING_X, lambda r: 0.0), 'channel "ring x" is constant')
    b.try_record(b.set(RING_X, lambda r: choose.gauss(0, 1)), 'probe "ring y" reads')
    b.try_record(b.set(RING_Y, lambda r: r[RING_X]), 'probes "ring x" and "ring y" read the same samples')
    rows = b.rows()
    for j in (100, 1000, 2000):
        rows[j][DE_X] += 3e4
    b.try_record(rows, 'channel "DE x" has 3 spikes of one sample, the first at')
    b.try_record(b.set(DE_X, lambda r: 500.0 * round(r[DE_X] / 500.0)))  # coarse, but no worse
    # what is not noticed, as the manual says
    b.try_record(b.set(DE_X, lambda r: min(1500.0, r[DE_X]) + choose.gauss(0, 3)))
    for j in (101, 1001, 2001):
        rows[j][DE_X] += 3e4
    b.try_record(rows)


def try_probes(b):
    def swap(i, j):
        def change(row):
            row[i], row[j] = row[j], row[i]
        return b.rows(change)
    backward = "1X turns backward at DE x + DE y: and forward elsewhere"
    b.try_record(swap(DE_X, DE_Y), backward)
    b.try_record(b.rows(), backward, probes=WITH_KEY.replace("90 deg", "-90 deg", 1))
    b.try_record(b.rows(), backward, probes=WITH_KEY.replace("node = 4", "node = 4\ngain = -1", 1))
    both = WITH_KEY.replace("90 deg", "-90 deg")
    b.try_record(b.rows(), "1X turns backward at DE x + DE y, ring x + ring y: probes are swapped", probes=both)
    b.try_record(b.rows(), 'probe "DE x" reads 0.195 m', 'probe "DE x" reads 25', names=[NAMES[T], "DE x [mil]", *NAMES[2:]])
    b.try_record(b.rows(), "at DE x + DE y probes see one direction only",
                 probes=WITH_KEY.replace("90 deg", "180 deg", 1))
    b.try_record(b.rows(), *[f'probe "{name}" reads 0.' for name in ("DE x", "DE y", "ring x", "ring y")],
                 names=[name.replace("um", "mil") for name in NAMES])
    # what no record shows by itself, as the manual says: MACs are lower
    b.try_record(swap(DE_X, RING_X))
    b.try_record(b.rows(), probes=WITH_KEY.replace("node = 4", "node = 4\ngain = -1"))
    b.try_record(b.rows(), "no unit in the record for DE x, DE y: taken as um",
                 names=[NAMES[T], "DE x", "DE y", *NAMES[3:]])
    for unit, said in (("furlong", "expected a length"), ("m/s^2", "expected a length"), ("V", "give the probe a gain")):
        b.try_record(b.rows(), f"error: {said}", names=[NAMES[T], f"DE x [{unit}]", *NAMES[2:]])
    b.try_record(b.rows(), 'error: the record has no channel "DE x"; it has DEx [m], DE y [m]',
                 names=[NAMES[T], "DEx [um]", *NAMES[2:]])
    b.try_record(b.rows(), 'error: 2 channels of the record are called "DE x": give its number',
                 names=[NAMES[T], NAMES[DE_X], NAMES[DE_X], *NAMES[3:]])


def try_speed(b):
    pulses = [j for j in range(1, len(b.good)) if b.good[j - 1][KEY] <= 0.5 < b.good[j][KEY]]

    def flat(numbers, level, offset, width):
        rows = b.rows()
        for p in numbers:
            for j in range(p + offset, min(len(rows), p + offset + width)):
                rows[j][KEY] = level
        return rows
    no_key = "no key-phasor and no --speed: the record is taken to be at the model's 4430 rpm"
    b.try_record(b.rows(), no_key, probes=PROBES)
    b.try_record(b.rows(), probes=PROBES, more=("--speed", "4430rpm"))
    b.try_record(b.rows(), "nothing in the record turns with 4000 rpm", probes=PROBES, more=("--speed", "4000rpm"))
    b.try_record(b.rows(), "--speed says 4000 rpm, the key-phasor 4430 rpm", more=("--speed", "4000rpm"))
    b.try_record(b.rows(), "error: needs a key-phasor", probes=PROBES, more=("--orders", "1"))
    b.try_record(b.rows(), "error: it has DE x [m]", probes=WITH_KEY.replace('"key"', '"Key"'))
    b.try_record(b.set(KEY, lambda r: 0.0), 'error: key-phasor "key": found 0 pulses')
    for numbers in ([pulses[20]], pulses[5::10]):
        one = len(numbers) == 1
        out = b.try_record(flat(numbers, 0.0, -6, 14),
                           f'key-phasor "key": {len(numbers)} pulse{" is" if one else "s are"} missing')
        assert "speed: 4430 rpm" in out, out
    out = b.try_record(flat([pulses[20]], 1.0, 30, 3), 'key-phasor "key": 1 pulse is too many')
    assert "speed: 4430 rpm" in out, out
    b.try_record(flat(pulses[20:24], 0.0, -6, 14), "the time between pulses jumps", "the speed changes by")
    b.try_record(flat(pulses, 1.0, 32, 3), "the key-phasor says 8860 rpm, the model 4430 rpm",
                 "the speed changes by")
    b.try_record(b.good[::40], no_key, "1.6 samples per revolution", probes=PROBES)
    b.try_record(b.good[::28], no_key, "rpm is near half the samples per second", probes=PROBES)
    b.try_record(b.rows(lambda r: r.__setitem__(T, 1e3 * r[T])), "the key-phasor says 4.43 rpm, the model 4430 rpm",
                 names=["time", *NAMES[1:]])
    bare = [row[1:] for row in b.good]
    b.try_record(bare, "the key-phasor says 937.5 rpm", names=NAMES[1:], more=("--rate", "1000"))
    b.try_record(b.rows(), "error: --rate says 1000", more=("--rate", "1000"))
    b.try_record(bare, "error: --rate says it, too", names=NAMES[1:])


def try_files(b):
    def comma(value):
        return repr(value).replace(".", ",")
    b.try_record(b.rows(), cell=comma, delimiter=";")
    b.try_record(b.rows(), "error: r.csv:1:1: names 6 columns, and the lines of numbers have 12", cell=comma)
    rows = b.rows()
    rows[-5][DE_Y] = "OVLD"
    b.try_record(rows, f'error: r.csv:{len(rows) - 3}:')
    b.try_record(b.set(T, lambda r: f"12:00:{r[T]:09.6f}"), "times of the day count from the first sample, at 12:00:0")
    whole = ",".join(NAMES) + "\n" + "".join(",".join(map(repr, row)) + "\n" for row in b.good)
    b.try_record(whole[:-60], "error: columns, expected 6 as in line 2")
    b.try_record(whole + whole, 'error: time: found "time [s]", expected a number')
    b.try_record("", "error: r.csv: is empty")
    b.try_record(",".join(NAMES) + "\n", "error: has no two lines of numbers")
    b.try_record(b.good[:1], "error: expected two times or more")
    b.try_record(b.good[:10], "error: the record has 10 samples, expected 16 or more", probes=PROBES)
    b.try_record(b.good[:32], 'error: key-phasor "key": found')


def main():
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(Path(folder))
        out = bench.try_record(bench.rows())
        assert re.search(r"1\.00.* mode 1 .*", out), out
        for part in (try_samples, try_probes, try_speed, try_files):
            part(bench)
        print(f"{bench.count} records")
        sys.exit("\n".join(bench.failures) if bench.failures else 0)


if __name__ == "__main__":
    main()
