"""The cases as a user of NumPy and SciPy writes them."""
import math

import numpy as np

from .cases import END, REVOLUTIONS
from .rows import Row
from .timing import timed

TOLERANCES = (1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13)


def right_hand_side(case, in_touch=None):
    """y' = f(t, y); in_touch: whether the contact acts, left out where its depth says that."""
    n = case.size
    stiffness, damping, gap, by_force = case.stiffness, case.damping, case.gap, case.by_force

    def f(t, y):
        p, v = y[:n], y[n:]
        a = case.load + case.cosine * math.cos(t) + case.sine * math.sin(t) - stiffness @ p - damping @ v
        dx, dy = gap @ p
        r = math.hypot(dx, dy)
        if r > 1.0 if in_touch is None else in_touch:
            nx, ny = dx / r, dy / r
            vx, vy = gap @ v
            mu = math.copysign(case.mu, case.rim - ny * vx + nx * vy)
            a -= by_force @ np.array([(r - 1.0) * (nx - mu * ny), (r - 1.0) * (ny + mu * nx)])
        return np.concatenate((v, a))

    return f


def lsoda(case, tolerance):
    from scipy.integrate import solve_ivp
    f = right_hand_side(case)
    return solve_ivp(f, (0.0, END), case.start, method="LSODA", rtol=tolerance, atol=tolerance).y[:, -1]


def dop853(case, tolerance):
    """Begins anew wherever the contact opens or closes."""
    from scipy.integrate import solve_ivp

    def depth(t, y):
        return math.hypot(*(case.gap @ y[:case.size])) - 1.0

    depth.terminal = True
    pieces = {in_touch: right_hand_side(case, in_touch) for in_touch in (False, True)}
    t, y = 0.0, case.start
    in_touch = depth(t, y) > 0.0
    while t < END:
        depth.direction = -1 if in_touch else 1
        piece = solve_ivp(pieces[in_touch], (t, END), y, method="DOP853", rtol=tolerance, atol=tolerance, events=depth)
        if not piece.success:
            return np.full_like(y, math.nan)
        t, y = piece.t[-1], piece.y[:, -1]
        in_touch = in_touch != (piece.status == 1)
    return y


def run(case):
    rows = []
    for program, solve in (("SciPy DOP853", dop853), ("SciPy LSODA", lsoda)):
        for tolerance in TOLERANCES:
            end, seconds = timed(lambda: solve(case, tolerance))
            rows.append(Row(case.name, program, f"{tolerance:g}", case.error(end), 1e6 * seconds / REVOLUTIONS))
    return rows
