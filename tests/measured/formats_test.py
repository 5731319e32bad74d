#!/usr/bin/env python3
"""One motion in the files of many programs and rigs, as their users see it.

A point runs on an ellipse of 50 and 40 um at 3000 rpm, forward. Written by this test in every format and
habit, and read by `whirl identify`, it has a radius of 45 um in every one, or is refused with both readings:
never another number.

    formats_test.py WHIRL SOURCE
"""

import io
import math
import struct
import subprocess
import sys
import tempfile
import zipfile
import zlib
from pathlib import Path

WHIRL = Path(sys.argv[1]).absolute()
SAMPLES, RATE = 1000, 1000
ROTOR = '''format = 1
title = "rotor on two springs"
[operation]
speed = "3000 rpm"
[[body]]
name = "rotor"
mass = 5
spins = true
[[bearing]]
body = "rotor"
stiffness = 1.05e5
damping = 20
'''
X = [50 * math.cos(2 * math.pi * 50 * j / RATE) for j in range(SAMPLES)]  # [um]
Y = [40 * math.sin(2 * math.pi * 50 * j / RATE) for j in range(SAMPLES)]


def probes(first="X", second="Y", more="", top=""):
    return top + "".join(f'[[probe]]\nname = "{name}"\nbody = "rotor"\nangle = "{angle} deg"\nunit = "um"\n'
                         f'channel = {channel if isinstance(channel, int) else chr(34) + channel + chr(34)}\n{more}\n'
                         for name, angle, channel in (("X", 0, first), ("Y", 90, second)))


def identify(folder, name, content, *words, setup=None):
    """Status, and what is said."""
    (folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())
    (folder / "rotor.toml").write_text(ROTOR)
    (folder / "p.toml").write_text(setup or probes())
    done = subprocess.run([str(WHIRL), "identify", "rotor.toml", "--measured", name, "--probes", "p.toml", "--modes", "2",
                           *words], cwd=folder, capture_output=True, text=True, timeout=60)
    return done.returncode, done.stdout + done.stderr


def expect_right(folder, name, content, *words, setup=None, note=None):
    status, said = identify(folder, name, content, *words, setup=setup)
    line = next((row for row in said.splitlines() if row.strip().startswith("+3000")), "")
    assert status == 0 and " 45 um" in line, f"{name}: {status} {said}"
    assert note is None or note in said, f"{name}: no note {note!r} in {said}"


def expect_refused(folder, name, content, *parts, words=(), setup=None):
    status, said = identify(folder, name, content, *words, setup=setup)
    assert status == 2, f"{name}: {status} {said}"
    for part in parts:
        assert part in said, f"{name}: no {part!r} in {said}"


def table(head, row):
    return head + "".join(row(j) + "\n" for j in range(SAMPLES))


def german(value, digits=4):
    return f"{value:.{digits}f}".replace(".", ",")


def test_tables(folder):
    def expect(head, row, **more):
        expect_right(folder, "a.csv", table(head, row).encode(more.pop("encoding", "utf-8")), **more)
    head = "Zeit [s];X [um];Y [um]\n"
    expect(head, lambda j: f"{german(j / RATE)};{german(X[j])};{german(Y[j])}")
    expect("Zeit (s);X (µm);Y (µm)\n", lambda j: f"{german(j / RATE)};{german(X[j])};{german(Y[j])}",
           encoding="cp1252")
    expect("Zeit [ms];X [um];Y [um]\n", lambda j: f"{j};{X[j]:.0f};{Y[j]:.0f}" if j < 2 else f"{j};{german(X[j])};{german(Y[j])}")
    expect("", lambda j: f"{j / RATE:.4f}\t{X[j]:.4f}\t{Y[j]:.4f}", setup=probes(1, 2), note="taken as times in seconds")
    thousands = table("Zeit [s];X [nm];Y [nm]\n", lambda j: ";".join(
        [german(j / RATE, 3)] + [f"{1000 * v:,.0f}".replace(",", ".") for v in (X[j], Y[j])]))
    expect_refused(folder, "b.csv", thousands, "write 50000 or 50,0")
    expect("Date,Time,X [um],Y [um]\n", lambda j: f"2024-05-01,23:59:{59.2 + j / RATE:06.3f},{X[j]:.4f},{Y[j]:.4f}"
           if j < 800 else f"2024-05-02,00:00:{(j - 800) / RATE:06.3f},{X[j]:.4f},{Y[j]:.4f}", note="past midnight")
    expect("Sampling rate [kHz]: 1\nX [um],Y [um]\n", lambda j: f"{X[j]:.4f},{Y[j]:.4f}")
    expect("Delta_X 0.001\nX [um],Y [um]\n", lambda j: f"{X[j]:.4f},{Y[j]:.4f}", note="taken as seconds")
    expect_refused(folder, "b.csv", table("Sample rate: 1\nX [um],Y [um]\n", lambda j: f"{X[j]:.4f},{Y[j]:.4f}"),
                   "or 1000 in kHz")
    expect(head, lambda j: f"{german(j / RATE)};{'Over Range' if j in (7, 70) else german(X[j])};{german(Y[j])}",
           note='2 cells say "Over Range"')
    statistics = table(head, lambda j: f"{german(j / RATE)};{german(X[j])};{german(Y[j])}")
    expect_right(folder, "a.csv", statistics + "Min;;-50;-40\nStd. Dev.;;35,4;28,3\n")


def test_oscilloscopes(folder):
    gain = probes("CH1", "CH2", 'gain = "8 mV/um"')
    volts = lambda j: f"{8e-3 * X[j]:.6e},{8e-3 * Y[j]:.6e}"
    for head, row in (
            ("X,CH1,CH2,Start,Increment,\nSequence,Volt,Volt,-5.0e-01,1.0e-03\n", lambda j: f"{j},{volts(j)},,"),
            ("Time(s),CH1(V),CH2(V)\n", lambda j: f"{j / RATE:.6e},{volts(j)}"),
            ("Model,MSO2024\nHorizontal Units,S,\nSample Interval,1e-03,\nRecord Length,1000,\nVertical Units,V,V\n"
             "Labels,,\nTIME,CH1,CH2\n", lambda j: f"{j / RATE:.6e},{volts(j)}")):
        expect_right(folder, "scope.csv", table(head, row), setup=gain)
    settings = ["Record Length,1.0e+03", "Sample Interval,1.0e-03", "Source,CH1", "Vertical Units,V", "Horizontal Units,s"]
    beside = table("", lambda j: (settings[j] if j < len(settings) else ",") + f",,{j / RATE:.5f},{8e-3 * X[j]:.6f},")
    alone = probes("CH1", "CH1", 'gain = "8 mV/um"').split("\n\n")[0]
    status, said = identify(folder, "F0001CH1.CSV", beside, setup=alone + "\n")
    assert status == 0 and "50 um" in said, said


def lvm(x_columns, decimal, begin, end, x0):
    number = lambda value: f"{value:.6f}".replace(".", decimal)
    text = ("LabVIEW Measurement\t\nWriter_Version\t2\nReader_Version\t2\nSeparator\tTab\n"
            f"Decimal_Separator\t{decimal}\nMulti_Headings\tYes\nX_Columns\t{x_columns}\nTime_Pref\tRelative\n"
            "***End_of_Header***\t\n\t\n") if begin == 0 else ""
    text += (f"Channels\t2\t\nSamples\t{end - begin}\t{end - begin}\t\nDate\t2024/05/01\t2024/05/01\t\n"
             f"Time\t12:00:00{decimal}5\t12:00:00{decimal}5\t\nY_Unit_Label\tum\tum\t\nX_Dimension\tTime\tTime\t\n"
             f"X0\t{number(x0)}\t{number(x0)}\t\nDelta_X\t{number(1 / RATE)}\t{number(1 / RATE)}\t\n"
             "***End_of_Header***\t\t\t\nX_Value\tX\tY\tComment\n")
    for j in range(begin, end):
        time = number(x0 + (j - begin) / RATE) if x_columns == "One" else ""
        text += f"{time}\t{number(X[j])}\t{number(Y[j])}\n"
    return text + "\n"


def test_lvm(folder):
    for x_columns, decimal in (("One", "."), ("No", ",")):
        expect_right(folder, "a.lvm", lvm(x_columns, decimal, 0, 600, 0) + lvm(x_columns, decimal, 600, SAMPLES, 0.6))
        expect_refused(folder, "a.lvm", lvm(x_columns, decimal, 0, 600, 0) + lvm(x_columns, decimal, 600, SAMPLES, 0.7),
                       "segment 2 begins at 0.7, expected 0.6")


def tdms_object(path, count, **properties):
    text = lambda value: struct.pack("<I", len(value)) + value.encode()
    index = struct.pack("<IIIQ", 20, 2, 1, count) if count else struct.pack("<I", 0xFFFFFFFF)
    values = b"".join(text(name) + (struct.pack("<I", 0x20) + text(value) if isinstance(value, str)
                                    else struct.pack("<Id", 10, value)) for name, value in properties.items())
    return text(path) + index + struct.pack("<I", len(properties)) + values


def tdms_segment(contents, objects, raw, size=None):
    head = struct.pack("<I", len(objects)) + b"".join(objects) if objects else b""
    return b"TDSm" + struct.pack("<IIQQ", contents, 4713, size or len(head) + len(raw), len(head)) + head + raw


def test_tdms(folder):
    scale = {"NI_Scaling_Status": "unscaled", "NI_Number_Of_Scales": 1.0, "NI_Scale[0]_Scale_Type": "Linear",
             "NI_Scale[0]_Linear_Slope": 0.002, "NI_Scale[0]_Linear_Y_Intercept": 0.5}
    raw = lambda values: struct.pack(f"<{len(values)}h", *(round((v - 0.5) / 0.002) for v in values))
    def head(first, second):
        more = {"wf_increment": 1 / RATE, "unit_string": "um", **scale}
        return [tdms_object(f"/'rig'/'{name}'", 100, **more) for name in (first, second)]
    chunks = b"".join(raw(X[k:k + 100]) + raw(Y[k:k + 100]) for k in range(0, SAMPLES, 100))
    expect_right(folder, "a.tdms", tdms_segment(14, head("X", "Y"), chunks))
    expect_right(folder, "a.tdms", tdms_segment(14, head("X", "Y"), chunks[:400]) + tdms_segment(8, [], chunks[400:]),
                 setup=probes("rig/X", "rig/Y"))
    killed = tdms_segment(14, head("X", "Y"), chunks + chunks[:50], 2**64 - 1)
    expect_right(folder, "a.tdms", killed, note="is not whole, as of a run that was killed")
    expect_refused(folder, "a.tdms", tdms_segment(14 | 128, head("X", "Y"), chunks), "as DAQmx logs them")


def matlab_element(kind, data):
    return struct.pack("<II", kind, len(data)) + data + bytes(-len(data) % 8)


def matlab_matrix(name, values, rows=None, compressed=False):
    """A vector of numbers, or a struct of such (a dict), or cells (a list of matrices)."""
    kind = 2 if isinstance(values, dict) else 6
    size = (1, 1) if isinstance(values, dict) else (rows or len(values), 1)
    body = (matlab_element(6, struct.pack("<II", kind, 0)) + matlab_element(5, struct.pack("<ii", *size))
            + matlab_element(1, name.encode()))
    if isinstance(values, dict):
        body += struct.pack("<HHi", 5, 4, 32) + matlab_element(1, b"".join(n.encode().ljust(32, b"\0") for n in values))
        body += b"".join(matlab_matrix("", v) for v in values.values())
    else:
        body += matlab_element(9, struct.pack(f"<{len(values)}d", *values))
    element = matlab_element(14, body)
    if not compressed:
        return element
    packed = zlib.compress(element)
    return struct.pack("<II", 15, len(packed)) + packed


def matlab_file(*variables):
    return b"MATLAB 5.0 MAT-file".ljust(124) + struct.pack("<H", 0x0100) + b"IM" + b"".join(variables)


def test_matlab(folder):
    rate, times = [float(RATE)], [j / RATE for j in range(SAMPLES)]
    note = "not as long as the 1000 samples of the record, and left out: calibration (5)"
    expect_right(folder, "a.mat", matlab_file(matlab_matrix("fs", rate), matlab_matrix("X", X, compressed=True),
                                              matlab_matrix("calibration", [1, 2, 3, 4, 5]), matlab_matrix("Y", Y)),
                 note=note)
    expect_right(folder, "a.mat", matlab_file(matlab_matrix("run", {"X": X, "Y": Y, "t": times})))
    slow = {name: X[:20] for name in ("T1", "T2", "T3")}
    expect_right(folder, "a.mat", matlab_file(matlab_matrix("fast", {"X": X, "Y": Y, "fs": rate}),
                                              matlab_matrix("slow", {**slow, "fs": [10.0]})),
                 setup=probes("fast.X", "Y"), note="left out: T1 (20), T2 (20), T3 (20)")
    expect_right(folder, "a.mat", matlab_file(matlab_matrix("X", {"Time": times, "Data": X}),
                                              matlab_matrix("Y", {"Time": times, "Data": Y})))


def wav(gain_volts, full_scale):
    """32 bits of a recorder with a full scale [V]."""
    data = b"".join(struct.pack("<ii", *(round(2**31 * gain_volts * v / full_scale) for v in (X[j], Y[j])))
                    for j in range(SAMPLES))
    return (b"RIFF" + struct.pack("<I", 36 + len(data)) + b"WAVEfmt " + struct.pack("<IHHIIHH", 16, 1, 2, RATE, 8 * RATE, 8, 32)
            + b"data" + struct.pack("<I", len(data)) + data)


def test_sound(folder):
    gain = 'gain = "-200 mV/mil"'
    volts = -0.2 / 25.4  # per um
    sound = wav(volts, 20.0)
    expect_refused(folder, "a.wav", sound, 'probe "X"', 'channel "1"', 'full_scale = "10 V"', setup=probes(1, 2, gain))
    expect_right(folder, "a.wav", sound, setup=probes(1, 2, gain + '\nfull_scale = "20 V"'))
    expect_right(folder, "a.wav", sound, setup=probes(1, 2, gain, 'full_scale = "20 V"\n'))
    expect_right(folder, "a.wav", sound, setup=probes(1, 2, f'gain = "{volts / 20:.9g} 1/um"'))


def dataset_58(name, values, unit):
    return (f"    -1\n    58\n{name}\nNONE\n30-Apr-20 19:12:52\nNONE\nNONE\n"
            "    1         0    0         0 NONE              12   2 NONE               0   0\n"
            f"         4{len(values):10}         1  0.00000E+00  1.00000E-03  0.00000E+00\n"
            "        17    0    0    0 Time                 s                   \n"
            f"         8    0    0    0 x                    {unit:20}\n"
            + 2 * "         0    0    0    0 NONE                 NONE                \n"
            + "".join("".join(f"{v:20.11E}" for v in values[k:k + 4]) + "\n" for k in range(0, len(values), 4))
            + "    -1\n")


def test_universal(folder):
    expect_right(folder, "a.uff", dataset_58("X", X, "NONE") + dataset_58("Y", Y, "NONE"), note="no unit of the displacements")
    expect_right(folder, "a.uff", dataset_58("X", X, "um") + dataset_58("Y", Y, "um"))


def workbook(sheets):
    """The bytes of an .xlsx file with sheets {name: rows}."""
    def cell(value, column, row):
        place = f"{chr(ord('A') + column)}{row}"
        if isinstance(value, str):
            return f'<c r="{place}" t="inlineStr"><is><t>{value}</t></is></c>'
        return f'<c r="{place}"><v>{value!r}</v></c>'
    kinds = "application/vnd.openxmlformats-officedocument.spreadsheetml"
    links = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        archive.writestr("[Content_Types].xml", '<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">'
                         f'<Default Extension="xml" ContentType="{kinds}.sheet.main+xml"/></Types>')
        archive.writestr("_rels/.rels", '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
                         f'<Relationship Id="r" Type="{links}/officeDocument" Target="xl/workbook.xml"/></Relationships>')
        archive.writestr("xl/workbook.xml", f'<workbook xmlns:r="{links}"><sheets>' + "".join(
            f'<sheet name="{name}" sheetId="{i}" r:id="r{i}"/>' for i, name in enumerate(sheets, 1)) + "</sheets></workbook>")
        archive.writestr("xl/_rels/workbook.xml.rels", "<Relationships>" + "".join(
            f'<Relationship Id="r{i}" Type="{links}/worksheet" Target="worksheets/sheet{i}.xml"/>'
            for i in range(1, len(sheets) + 1)) + "</Relationships>")
        for i, rows in enumerate(sheets.values(), 1):
            archive.writestr(f"xl/worksheets/sheet{i}.xml", "<worksheet><sheetData>" + "".join(
                f'<row r="{r}">' + "".join(cell(v, c, r) for c, v in enumerate(row)) + "</row>"
                for r, row in enumerate(rows, 1)) + "</sheetData></worksheet>")
    return packed.getvalue()


def test_workbooks(folder):
    rows = [["Rig 3, run 2"], [], ["Time [s]", "X [um]", "Y [um]"]] + [[j / RATE, X[j], Y[j]] for j in range(SAMPLES)]
    notes = [["Who", "measured"], ["A", "B"]]
    expect_right(folder, "a.xlsx", workbook({"Notes": notes, "Run": rows}))
    expect_right(folder, "a.xlsx", workbook({"Run": rows + [["Max", max(X), max(Y)]]}))
    expect_refused(folder, "a.xlsx", workbook({"Run 1": rows, "Run 2": rows}), '"Run 1", "Run 2"', "a.xlsx#Run 1")
    expect_refused(folder, "a.xlsx", workbook({"Notes": notes}), "no sheet has two lines of numbers")
    expect_refused(folder, "a.xlsx", b"PK\x03\x04 torn", "workbook")


def test_endings(folder):
    expect_refused(folder, "a.docx", "", ".csv .txt", ".lvm, .tdms")


def main():
    tests = [test for name, test in globals().items() if name.startswith("test_")]
    for test in tests:
        with tempfile.TemporaryDirectory() as folder:
            test(Path(folder))
        print(test.__name__)


if __name__ == "__main__":
    main()
