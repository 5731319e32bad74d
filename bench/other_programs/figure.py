"""Time of a revolution over error of all programs, a panel per case, drawn as whirl draws `bench --svg`.

A family of programs has a colour, its members have signs of their own.
"""
import html
import math

from .rows import TARGET, by_program, good

WIDTH, PANEL, GAP = 800, 390, 122  # of the picture, height of a panel, what is between two
LEFT, TOP, RIGHT = 82, 60, 226
STEP = 17                         # between labels
FAMILIES = {"whirl": ("#0072b2", "#005f94"), "SUNDIALS": ("#e69f00", "#946600"), "odeint": ("#000000", "#000000"),
            "SciPy": ("#009e73", "#007d5b"), "XPPAUT": ("#cc79a7", "#a84c80"), "Octave": ("#d55e00", "#b34f00"),
            "Siconos": ("#882255", "#882255")}  # of lines, of texts
BOLD = {"font_size": 13, "font_weight": "bold"}
OTHER = ("#888888", "#606060")


def element(name, text=None, **attributes):
    words = "".join(f' {key.replace("_", "-")}="{value}"' for key, value in attributes.items())
    return f"<{name}{words}/>" if text is None else f"<{name}{words}>{text}</{name}>"


def line(a, b, stroke, **attributes):
    ends = dict(zip(("x1", "y1", "x2", "y2"), (f"{x:.2f}" for x in (*a, *b))))
    return element("line", **ends, stroke=stroke, **attributes)


def polyline(points, **attributes):
    joined = " ".join(f"{x:.2f},{y:.2f}" for x, y in points)
    round_ = {"stroke_linejoin": "round", "stroke_linecap": "round"}
    return element("polyline", points=joined, fill="none", **round_, **attributes)


def words(x, y, text, **attributes):
    return element("text", text, x=f"{x:.2f}", y=f"{y:.2f}", **{"font_size": 12, "fill": "#222222"} | attributes)


def power(exponent):
    sign = "\N{MINUS SIGN}" if exponent < 0 else ""
    return f'10<tspan dy="-5.4" font-size="8.4">{sign}{abs(exponent)}</tspan>'


def mark(shape, x, y, fill):
    if shape == 0:
        return element("circle", cx=f"{x:.2f}", cy=f"{y:.2f}", r=4, fill=fill)
    corners = {1: ((0, -5), (5, 0), (0, 5), (-5, 0)), 2: ((0, -5), (4.4, 3), (-4.4, 3))}[shape]
    return element("polygon", points=" ".join(f"{x + a:.2f},{y + b:.2f}" for a, b in corners), fill=fill)


def spread(places, low, high):
    """Places of labels near those that are wanted, no two closer than STEP, between low and high as far as they fit."""
    order = sorted(range(len(places)), key=lambda i: places[i])
    put = []
    for i in order:
        put.append(max(places[i], put[-1] + STEP if put else low))
    limit = high
    for k in reversed(range(len(put))):
        put[k] = min(put[k], limit)
        limit = put[k] - STEP
    return {i: y for i, y in zip(order, put)}


def decades(values):
    """Whole powers of ten around values."""
    return math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))


class Panel:
    def __init__(self, top, rows, errors, times):
        self.top, self.errors, self.times = top, errors, times
        self.programs = {name: own for name, own in by_program(good(rows)).items() if own}
        self.right = WIDTH - RIGHT

    def place(self, error, us):
        across = (math.log10(error) - self.errors[0]) / (self.errors[1] - self.errors[0])
        up = (math.log10(us) - self.times[0]) / (self.times[1] - self.times[0])
        return LEFT + across * (self.right - LEFT), self.top + (1.0 - up) * PANEL

    def axes(self):
        bottom = self.top + PANEL
        out = []
        for exponent in range(self.errors[0], self.errors[1] + 1):
            x = self.place(10.0**exponent, 1.0)[0]
            is_named = exponent % 2 == 0
            if is_named:
                out += [line((x, self.top), (x, bottom), "#e4e4e4"),
                        words(x, bottom + 21, power(exponent), text_anchor="middle")]
            out.append(line((x, bottom), (x, bottom + (6 if is_named else 3)), "#222222"))
        for exponent in range(self.times[0], self.times[1] + 1):
            y = self.place(1.0, 10.0**exponent)[1]
            out += [line((LEFT, y), (self.right, y), "#e4e4e4"), line((LEFT - 6, y), (LEFT, y), "#222222"),
                    words(LEFT - 10, y + 4.5, power(exponent), text_anchor="end")]
        out += [line((LEFT, bottom), (self.right, bottom), "#222222"),
                line((LEFT, self.top), (LEFT, bottom), "#222222"),
                words((LEFT + self.right) / 2, bottom + 44, "error after 20 revolutions [clearances]", font_size=13,
                      text_anchor="middle")]
        middle = self.top + PANEL / 2
        return out + [words(19, middle, "time per revolution [us]", font_size=13, text_anchor="middle",
                            transform=f"rotate(-90 19 {middle:.2f})")]

    def target(self):
        x = self.place(TARGET, 1.0)[0]
        return [line((x, self.top), (x, self.top + PANEL), "#707070", stroke_width=1.1, stroke_dasharray="6 4")]

    def curves(self):
        lines, marks, ends = [], [], []
        members = {}
        for name, rows in self.programs.items():
            family = name.split()[0]
            shape = members.setdefault(family, 0)
            members[family] += 1
            colour, dark = FAMILIES.get(family, OTHER)
            points = [self.place(max(row.error, 10.0**self.errors[0]), row.us) for row in rows]
            lines.append(polyline(points, stroke=colour, stroke_width=2))
            marks += [mark(shape % 3, x, y, colour) for x, y in points]
            ends.append((name, max(points), shape % 3, colour, dark))
        return lines + self.labels(ends) + marks

    def labels(self, ends):
        """Names and signs to the right, with a thin line from the loose end of each curve."""
        put = spread([end[1] for _, end, *_ in ends], self.top + 6, self.top + PANEL - 2)
        out = []
        for i, (name, (x, y), shape, colour, dark) in enumerate(ends):
            leader = [(x, y), (self.right + 10, put[i]), (self.right + 22, put[i])]
            out += [polyline(leader, stroke=colour, stroke_width=0.8, stroke_dasharray="1 3"),
                    mark(shape, self.right + 31, put[i], colour),
                    words(self.right + 42, put[i] + 4.5, html.escape(name), fill=dark, **BOLD)]
        return out


def drawn(panels):
    """The picture of [(title, rows)]; all panels have the same axes."""
    every = [row for _, rows in panels for row in good(rows)]
    errors = decades([row.error for row in every if row.error > 0.0] + [TARGET])
    times = decades([row.us for row in every] or [1.0, 10.0])
    height = TOP + len(panels) * (PANEL + GAP) - 62
    out = ['<?xml version="1.0" encoding="UTF-8"?>', "<!-- written by bench/others.py -->",
           f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height}" viewBox="0 0 {WIDTH} {height}" '
           "font-family=\"Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif\">",
           "<title>Error and time of whirl beside other programs</title>",
           element("rect", width=WIDTH, height=height, fill="#ffffff")]
    for i, (title, rows) in enumerate(panels):
        top = TOP + i * (PANEL + GAP)
        panel = Panel(top, rows, errors, times)
        out += [words(LEFT, top - 32, html.escape(title), font_size=15, font_weight="bold"),
                words(LEFT, top - 14, "one core; the dashed line is an error of 1e-6", fill="#606060")]
        out += [*panel.axes(), *panel.target(), *panel.curves()]
    return "\n".join([*out, "</svg>"]) + "\n"
