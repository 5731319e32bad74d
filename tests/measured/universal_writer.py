"""Universal files, written from the public description of their datasets alone.

Nothing here comes from whirl's own reader or writer: a mistake that both of those share shows when the
reader meets these files. Datasets: 58 (function at nodal degree of freedom, as text), 58b (the same with
binary values), 15 (nodes), 151 (header), 164 (units).
Source: University of Cincinnati, Structural Dynamics Research Laboratory, universal file formats for modal
analysis testing, datasets 15, 58, 58b, 151, 164.
"""

import struct
from dataclasses import dataclass, field


@dataclass
class Function:
    """One dataset 58: ordinates over an abscissa."""

    name: str
    values: list  # real, or complex numbers
    unit: str = "NONE"
    label: str = "NONE"
    kind: int = 1  # of function: 1 time response, 4 frequency response
    quantity: int = 8  # of ordinates: 8 displacement, 1 general, 12 acceleration
    start: float = 0.0  # of even abscissas [s]
    step: float = 1.0
    abscissas: list = field(default_factory=list)  # of uneven ones; empty: even
    abscissa_quantity: int = 17  # 17 time, 18 frequency
    abscissa_unit: str = "s"
    is_double: bool = True
    is_complex: bool = False
    response: tuple = ("NONE", 1, 1)  # entity, node, direction
    reference: tuple = ("NONE", 0, 0)
    lines: tuple = ("NONE", "23-NOV-26 12:00:00", "NONE", "NONE")  # ID lines 2 to 5


@dataclass
class Style:
    """How a program writes: every choice is one that the description leaves open, or that is met."""

    newline: str = "\n"
    is_padded: bool = True  # text lines to 80 characters
    is_fortran: bool = False  # 0.12346E+01 rather than 1.23457e+00
    byte_order: str = "little"
    is_abscissa_double: bool = False  # binary, uneven, double: E13.5 of the text says single, many write double


def real(value, width, digits, style):
    """A number in a field of `width` characters with `digits` after the point."""
    text = f"{value:.{digits}e}"
    if style.is_fortran:
        mantissa, exponent = f"{abs(value):.{digits - 1}e}".split("e")
        power = int(exponent) + 1 if value != 0.0 else 0
        sign = "-" if value < 0.0 else ""
        text = f"{sign}0.{mantissa.replace('.', '')}E{power:+03d}"
    if len(text) > width:
        raise ValueError(f"{value} does not fit into {width} characters")
    return text.rjust(width)


def as_carried(value, digits, style):
    """What is left of a number that was written with `digits` after the point."""
    return float(real(value, digits + 8, digits, style))


def line(text, style):
    return ((text.ljust(80) if style.is_padded else text.rstrip()) + style.newline).encode("latin-1")


def dataset(number, lines, style):
    """A dataset of text between its two lines of -1."""
    body = [f"{-1:6d}", f"{number:6d}", *lines, f"{-1:6d}"]
    return b"".join(line(text, style) for text in body)


def header_151(style, model="two disks"):
    return dataset(151, [model, "measured", "another program", "23-NOV-26 12:00:00 " + f"{1:10d}{1:10d}{0:10d}",
                         "23-NOV-26 12:00:00 ", "another program", "23-NOV-26 12:00:00 "], style)


def units_164(style, code=1, name="Meter (newton)", length=1.0, force=1.0):
    """SI values are those of the file divided by these factors."""
    def number(value):
        return f"{value:25.17E}".replace("E", "D")
    return dataset(164, [f"{code:10d}{name:<20.20s}{2:10d}", number(length) + number(force) + number(1.0),
                         number(273.15)], style)


def nodes_15(style, places):
    return dataset(15, [f"{k:10d}{0:10d}{0:10d}{11:10d}" + "".join(f"{x:13.5E}" for x in place)
                        for k, place in enumerate(places, 1)], style)


def ordinate_type(function):
    return {(False, False): 2, (True, False): 4, (False, True): 5, (True, True): 6}[
        (function.is_double, function.is_complex)]


def columns_of(function):
    """Rows of what is stored of a sample: abscissa where uneven, real part, imaginary part where complex."""
    rows = []
    for k, value in enumerate(function.values):
        row = [function.abscissas[k]] if function.abscissas else []
        row += [value.real, value.imag] if function.is_complex else [value]
        rows.append(row)
    return rows


def head(function, style):
    """Records 1 to 11."""
    def axis(quantity, label, unit):
        return f"{quantity:10d}{0:5d}{0:5d}{0:5d} {label:<20.20s} {unit:<20.20s}"
    entity, node, direction = function.response
    other, other_node, other_direction = function.reference
    is_even = not function.abscissas
    form = f"{ordinate_type(function):10d}{len(function.values):10d}{int(is_even):10d}"
    for value in (function.start if is_even else 0.0, function.step if is_even else 0.0, 0.0):
        form += real(value, 13, 5, style)
    return [function.name, *function.lines,
            f"{function.kind:5d}{0:10d}{1:5d}{0:10d} {entity:<10.10s}{node:10d}{direction:4d}"
            f" {other:<10.10s}{other_node:10d}{other_direction:4d}",
            form,
            axis(function.abscissa_quantity, "Time", function.abscissa_unit),
            axis(function.quantity, function.label, function.unit),
            axis(0, "NONE", "NONE"), axis(0, "NONE", "NONE")]


def text_58(function, style):
    """Values as text: 6E13.5, 4E20.12, 2(E13.5,E20.12) or E13.5,2E20.12."""
    rows = columns_of(function)
    cells = []
    for row in rows:
        for k, value in enumerate(row):
            is_abscissa = k == 0 and bool(function.abscissas)
            narrow = is_abscissa or not function.is_double
            cells.append(real(value, 13, 5, style) if narrow else real(value, 20, 12, style))
    if not function.is_double:
        per_line = 6
    elif function.is_complex and function.abscissas:
        per_line = 3
    else:
        per_line = 4
    lines = ["".join(cells[k:k + per_line]) for k in range(0, len(cells), per_line)]
    return dataset(58, head(function, style) + lines, style)


def binary_58b(function, style):
    """Values as IEEE 754 numbers, straight after the eleven lines of text, and -1 straight after them."""
    order = "<" if style.byte_order == "little" else ">"
    wide = "d" if function.is_double else "f"
    form = order
    if function.abscissas:
        form += "d" if function.is_double and style.is_abscissa_double else "f"
    form += wide * (2 if function.is_complex else 1)
    values = b"".join(struct.pack(form, *row) for row in columns_of(function))
    first = f"{58:6d}b{1 if order == '<' else 2:6d}{2:6d}{11:12d}{len(values):12d}{0:6d}{0:6d}{0:12d}{0:12d}"
    lines = [f"{-1:6d}", first, *head(function, style)]
    return b"".join(line(text, style) for text in lines) + values + line(f"{-1:6d}", style)
