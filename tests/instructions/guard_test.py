#!/usr/bin/env python3
"""tools/instructions fails where a command takes more instructions than accepted, and names it.

    guard_test.py BUILD ROOT    status 77 without valgrind
"""
import pathlib
import subprocess
import sys
import tempfile

build, root = sys.argv[1:]
# its count is the same to a thousandth
COMMAND = ("whirl continue models/jeffcott_stator.toml --over operation.speed=134:137:0.5rad/s --at '136 rad/s' "
           "--isa baseline --threads 1")


def guard(table, *words):
    done = subprocess.run([root + "/tools/instructions", "--build", build, "--table", table, *words],
                          capture_output=True, text=True)
    if done.returncode == 77:
        sys.exit(77)
    return done


with tempfile.TemporaryDirectory() as folder:
    table = pathlib.Path(folder) / "table.tsv"
    table.write_text("# a comment\nbranch\t1.0\t" + COMMAND + "\n")
    grown = guard(table)
    assert grown.returncode == 1 and "failed: branch" in grown.stderr, grown

    accepted = guard(table, "--accept")
    assert accepted.returncode == 0 and table.read_text().startswith("# a comment\nbranch\t"), accepted
    counted = float(table.read_text().splitlines()[1].split("\t")[1])
    assert counted > 1.0
    assert guard(table).returncode == 0

    table.write_text(f"branch\t{counted / 1.04:.1f}\t{COMMAND}\n")
    assert guard(table).returncode == 1
    table.write_text(f"branch\t{counted / 1.02:.1f}\t{COMMAND}\n")
    assert guard(table).returncode == 0

    # of joined commands the last one is counted, which takes a small part of what the first one does
    table.write_text("prepared\t0.0\t" + COMMAND + " --out branch.h5 && whirl status branch.h5\n")
    assert guard(table, "--accept").returncode == 0
    prepared = float(table.read_text().split("\t")[1])
    assert 0.0 < prepared < 0.5 * counted, (prepared, counted)

    table.write_text("wrong\t1.0\twhirl nothing-of-this-name\n")
    assert guard(table).returncode == 1
    assert guard(table, "unknown").returncode == 2
