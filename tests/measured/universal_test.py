#!/usr/bin/env python3
"""whirl reads universal files that it has not written.

Every way to write a record that the format knows: as text and binary, in both byte orders, of single and
double precision, over even and uneven times, several datasets with others between them. Values, names and
units are those that were written, to the last digit that the file carries; and the table of a motion is
that of the same record as CSV.

    universal_test.py WHIRL SOURCE
"""

import csv
import itertools
import json
import math
import struct
import subprocess
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

import universal_writer as writer

WHIRL, SOURCE = Path(sys.argv[1]), Path(sys.argv[2])
JEFFCOTT = SOURCE / "models" / "jeffcott.toml"
TWO_DISKS = SOURCE / "models" / "two_disk_mac.toml"
STEP = 2.5e-4  # [s]: a number that 13 characters hold, and its multiples
SAMPLES = 50
ROUNDING = 4e-16  # of a number that is divided by another one
SAME = 1e-9  # of numbers of two records whose samples are equal to twelve digits


def whirl(folder, *words):
    done = subprocess.run([str(WHIRL), *map(str, words)], cwd=folder, capture_output=True, text=True, timeout=60)
    return done.returncode, done.stdout, done.stderr


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def probes(channels, gain=""):
    """Probes along x, at a place of its own each, so that a station's x is what its probe reads."""
    text = ""
    for k, channel in enumerate(channels):
        text += (f'[[probe]]\nname = "p{k}"\nat = "{50 * (k + 1)} mm"\nangle = 0\n'
                 f'channel = "{channel}"\n{gain}')
    return text


def signal(k):
    return [7.25 * (k + 1) * math.sin(0.37 * j + k) - 1.0 / 3.0 * k for j in range(SAMPLES)]


def readings(folder, path, channels, gain=""):
    """What whirl reads of a file: times [s], and displacements of channels [m]."""
    (folder / "p.toml").write_text(probes(channels, gain))
    result = folder / "r.h5"
    result.unlink(missing_ok=True)
    status, _, err = whirl(folder, "identify", JEFFCOTT, "--measured", path, "--probes", "p.toml", "--out", result)
    assert status == 0, f"{path.name}: {err}"
    for old in folder.glob("t_*"):
        old.unlink()
    status, _, err = whirl(folder, "export", result, "--format", "csv", "--out", "t")
    assert status == 0, err
    rows = table(folder / "t_record_time.csv")
    times = [float(row["time [s]"]) for row in rows]
    keys = [key for key in rows[0] if key.split(" ")[0].endswith("x") or " x" in key]
    return times, [[float(row[key]) for row in rows] for key in keys]


def carried(function, style, is_binary):
    """Values as a file has them."""
    if is_binary:
        wide = "d" if function.is_double else "f"
        return [struct.unpack(wide, struct.pack(wide, value))[0] for value in function.values]
    return [writer.as_carried(value, 12 if function.is_double else 5, style) for value in function.values]


def between(style):
    """Datasets that are no record: a frequency response, real and complex numbers over frequency."""
    response = writer.Function("FRF", [complex(1.0, 2.0), complex(-3.0, 0.5), complex(0.0, -1.0)], kind=4,
                               is_complex=True, abscissa_quantity=18, abscissa_unit="Hz", step=0.5)
    uneven = replace(response, abscissas=[1.0, 2.5, 7.0])
    return (writer.text_58(response, style) + writer.binary_58b(uneven, style) +
            writer.binary_58b(replace(response, is_double=False), style) + writer.text_58(uneven, style))


def displacements(folder, functions, style, write=writer.text_58, before=b""):
    """What whirl reads of these functions, each from the channel of its number."""
    path = folder / "a.uff"
    path.write_bytes(before + b"".join(write(function, style) for function in functions))
    return readings(folder, path, range(1, len(functions) + 1))[1]


def refusal(folder, content, channel="1"):
    """What is said of a file that cannot be taken."""
    (folder / "bad.uff").write_bytes(content)
    (folder / "p.toml").write_text(probes([channel]))
    status, _, err = whirl(folder, "identify", JEFFCOTT, "--measured", "bad.uff", "--probes", "p.toml")
    assert status == 2, (status, err)
    return err


def styles():
    """Every form of values, in files whose lines differ."""
    for is_double, is_even, number in itertools.product((False, True), (True, False), range(2)):
        lines = {"newline": ("\n", "\r\n")[number], "is_padded": (number == 0) == is_even}
        yield writer.text_58, is_double, is_even, writer.Style(**lines, is_fortran=number == 1)
        for is_wide in (False, True) if is_double and not is_even else (False,):
            yield writer.binary_58b, is_double, is_even, writer.Style(
                **lines, byte_order=("little", "big")[number], is_abscissa_double=is_wide)


def test_every_way_to_write(folder):
    names = ["drive end x", "1Y:um", "middle"]
    count = 0
    for write, is_double, is_even, style in styles():
        functions = [writer.Function(
            name, signal(k), unit="um", label="Displacement", step=STEP, start=0.5, is_double=is_double,
            abscissas=[] if is_even else [0.5 + STEP * j for j in range(SAMPLES)])
            for k, name in enumerate(names)]
        parts = [writer.header_151(style), writer.units_164(style), writer.nodes_15(style, [(0.0, 0.0, 0.1)])]
        for function in functions:
            parts += [write(function, style), between(style)]
        path = folder / "a.uff"
        path.write_bytes(b"".join(parts))
        times, found = readings(folder, path, names)
        what = (write.__name__, style, is_double, is_even)
        is_binary = write is writer.binary_58b
        assert len(found) == len(functions), what
        # six digits of times that are text, seven of single precision: 2e-6 of the largest of them
        assert all(abs(t - 0.5 - STEP * j) < 1e-6 for j, t in enumerate(times)), what
        for function, values in zip(functions, found):
            expected = carried(function, style, is_binary)
            assert len(values) == SAMPLES, what
            for value, right in zip(values, expected):
                assert abs(value - 1e-6 * right) <= ROUNDING * abs(value), (what, value, right)
        count += 1
    print(f"  {count} files")


def test_units(folder):
    """Of its ordinate; where that has none and is a displacement, those of dataset 164."""
    style = writer.Style()
    for unit, metres in (("um", 1e-6), ("mm", 1e-3), ("mil", 25.4e-6), ("m", 1.0)):
        function = writer.Function("x", signal(0), unit=unit, step=STEP)
        for value, right in zip(displacements(folder, [function], style)[0], signal(0)):
            assert abs(value - metres * right) <= 1e-12 * abs(metres * 7.25), (unit, value, right)
    for code, name, factor in ((5, "mm (milli newton)", 1000.0), (7, "Inch (pound f)", 1.0 / 0.0254)):
        before = writer.units_164(style, code, name, factor)
        function = writer.Function("x", signal(0), step=STEP)
        for value, right in zip(displacements(folder, [function], style, before=before)[0], signal(0)):
            assert abs(value - right / factor) <= 1e-12 * 7.25 / factor, (name, value, right)
    volts = writer.Function("x", signal(0), unit="mV", quantity=1, step=STEP)
    (folder / "v.uff").write_bytes(writer.text_58(volts, style))
    found = readings(folder, folder / "v.uff", ["x"], 'gain = "-8 mV/um"\n')[1][0]
    for value, right in zip(found, signal(0)):
        assert abs(value + 1e-6 * right / 8.0) <= 1e-12 * 1e-6, (value, right)


def test_times_in_milliseconds(folder):
    style = writer.Style()
    path = folder / "a.uff"
    path.write_bytes(writer.text_58(writer.Function("x", signal(0), unit="um", start=500.0, step=0.25,
                                                    abscissa_unit="ms"), style))
    times = readings(folder, path, ["x"])[0]
    assert all(abs(t - 0.5 - STEP * j) < 1e-12 for j, t in enumerate(times)), times[:3]


def test_names(folder):
    """First lines; where several are alike the responses, or the labels, and where these are, too, numbers."""
    def said(functions, channel):
        return refusal(folder, b"".join(writer.text_58(f, writer.Style()) for f in functions), channel)

    def function(name, response, label="NONE"):
        return writer.Function(name, signal(0), unit="um", label=label, step=STEP, response=response)
    alike = [function("Time Waveform", ("DE", 12, 1)), function("Time Waveform", ("NONE", 12, -2)),
             function("key", ("NONE", 0, 0))]
    assert "it has DE 12 +x [m], 12 -y [m], key [m]" in said(alike, "none"), said(alike, "none")
    unknown = [function("NONE", ("NONE", 3, 3)), function("", ("NONE", 4, -3))]
    assert "it has 3 +z [m], 4 -z [m]" in said(unknown, "none"), said(unknown, "none")
    labels = [function("unit 3", ("NONE", 0, 0), "DE x"), function("unit 3", ("NONE", 0, 0), "DE y")]
    assert "it has DE x [m], DE y [m]" in said(labels, "none"), said(labels, "none")
    same = [function("Time", ("NONE", 0, 0))] * 2
    assert '2 channels of the record are called "Time": give its number from 1' in said(same, "Time"), said(same, "Time")


def test_what_is_no_record(folder):
    """Complex values, correlations and frequency responses, and channels that are not of one time."""
    style = writer.Style()

    def text(**kind):
        return writer.text_58(replace(writer.Function("x", signal(0), unit="um", step=STEP), **kind), style)
    complex_values = [complex(v, 1.0) for v in signal(0)]
    assert "complex values" in refusal(folder, text(values=complex_values, is_complex=True))
    assert "has no dataset 58 of a response over time" in refusal(folder, text(kind=7))
    assert "it has dataset 1 (58, no record over time)" in refusal(folder, text(kind=4, abscissa_quantity=18))
    mean = text(name="mean", values=[1.5], abscissas=[0.0])  # one value, as monitoring systems write it, too
    assert "it has dataset 1 (58, no record over time)" in refusal(folder, mean)
    assert "it has x [m]" in refusal(folder, mean + text(), "none")
    assert "begins at 0.1 s, those before at 0 s" in refusal(folder, text() + text(start=0.1))
    assert "samples per second, those before have 4000" in refusal(folder, text() + text(step=2 * STEP))
    assert "has 25 samples, expected 50 as of x" in refusal(folder, text() + text(name="y", values=signal(0)[:25]))


def test_same_modes_as_of_the_table(folder):
    """A motion of the rotor with contact: the MAC table of the universal file is that of the CSV."""
    names = ["4x", "4y", "7x", "7y", "key"]
    setup = "".join(f'[[probe]]\nname = "{name}"\nnode = {name[0]}\nangle = "{90 * (name[1] == "y")} deg"\n'
                    for name in names[:4]) + '[keyphasor]\nchannel = "key"\n'
    (folder / "probes.toml").write_text(setup)
    status, _, err = whirl(folder, "simulate", TWO_DISKS, "--revolutions", "40", "--discard", "10", "--measure",
                           "probes.toml", "--noise", "1%", "--measured-out", "simulated.csv")
    assert status == 0, err
    lines = [line for line in (folder / "simulated.csv").read_text().splitlines() if line[0] != "#"]
    columns = [[float(cell) for cell in column] for column in list(zip(*(line.split(",") for line in lines[1:])))[1:]]
    step = float(f"{float(lines[2].split(',')[0]) - float(lines[1].split(',')[0]):.5e}")
    with open(folder / "a.csv", "w", encoding="utf-8") as file:
        file.write("time [s]," + ",".join(f"{name} [um]" for name in names[:4]) + ",key [V]\n")
        for j, row in enumerate(zip(*columns)):
            file.write(",".join([repr(j * step), *(f"{1e6 * v:.12e}" for v in row[:4]), f"{row[4]:.12e}"]) + "\n")
    style = writer.Style()
    functions = [writer.Function(name, [1e6 * v for v in column], unit="um", step=step)
                 for name, column in zip(names[:4], columns)]
    functions.append(writer.Function("key", columns[4], unit="V", quantity=1, step=step))
    (folder / "a.uff").write_bytes(writer.header_151(style) + b"".join(writer.text_58(f, style) for f in functions))
    (folder / "b.ufb").write_bytes(b"".join(writer.binary_58b(f, replace(style, byte_order="big"))
                                            for f in functions))
    found = {}
    for record in ("a.csv", "a.uff", "b.ufb"):
        status, out, err = whirl(folder, "identify", TWO_DISKS, "--measured", record, "--probes", "probes.toml",
                                 "--json", "-")
        assert status == 0, err
        found[record] = json.loads(out)
    table = found["a.csv"]["peaks"]
    assert len(table) > 2
    for record in ("a.uff", "b.ufb"):
        assert len(found[record]["peaks"]) == len(table), record
        for peak, right in zip(found[record]["peaks"], table):
            assert peak["mode"] == right["mode"]
            for key in ("frequency_rpm", "amplitude_m", "shift"):
                assert abs(peak[key] - right[key]) <= SAME * abs(right[key]), (record, key, peak[key], right[key])
            for value, expected in zip(peak["mac"], right["mac"]):
                assert abs(value - expected) <= SAME, (record, value, expected)


def main():
    tests = [value for name, value in globals().items() if name.startswith("test_")]
    for test in tests:
        with tempfile.TemporaryDirectory() as folder:
            print(test.__name__, flush=True)
            test(Path(folder))


if __name__ == "__main__":
    main()
