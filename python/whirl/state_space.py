"""State spaces of the linear rotor, for control and for scipy.signal."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from .arrays import need
from .errors import ModelError, NumericalError, Problem

QUANTITIES = ("displacement", "velocity", "acceleration")
DIRECTIONS = ("x", "y", "theta_x", "theta_y")


class StateSpace(NamedTuple):
    """x' = A x + B u, y = C x + D u of the linear rotor at a speed, of real numbers and dense.

    x = (a, a'), where a are the amplitudes of undamped modes: q = shapes a, with q of `Model.matrices`. In these
    coordinates A is well conditioned, where that of (q, q') loses seven of sixteen digits for fine meshes.
    """

    A: np.ndarray
    """(2 n, 2 n) for n modes"""
    B: np.ndarray
    """(2 n, inputs)"""
    C: np.ndarray
    """(outputs, 2 n)"""
    D: np.ndarray
    """(outputs, inputs); 0 but of accelerations"""
    states: list[str]
    """What each x is: 'mode 1', ..., 'mode 1 velocity', ..."""
    inputs: list[str]
    """What each u is: '7 ring x' is a force [N], '7 ring theta_x' a moment [N m]."""
    outputs: list[str]
    """What each y is: '7 ring x' [m], '7 ring x velocity' [m/s], '7 ring theta_x acceleration' [rad/s^2]."""
    shapes: np.ndarray
    """(coordinates, n), of a modal mass of 1 kg; lowest frequency first."""
    speed: float
    """[rad/s]"""

    def to_scipy(self) -> Any:
        """The same as scipy.signal.StateSpace. Needs scipy."""
        return need("scipy.signal").StateSpace(self.A, self.B, self.C, self.D)

    def response(self, frequencies: Any) -> np.ndarray:
        """Complex amplitudes of the outputs by inputs of size one: (outputs, inputs, frequencies) [rad/s].

        C (i w - A)^-1 B + D, solved at each frequency. Undamped resonances raise numpy.linalg.LinAlgError.
        """
        w = np.atleast_1d(np.asarray(frequencies, dtype=float))
        one = np.eye(len(self.A))
        return np.stack([self.C @ np.linalg.solve(1j * v * one - self.A, self.B) + self.D for v in w], axis=-1)


def _ends(model: Any, option: str, ends: Any, speed: Any) -> tuple[list[str], set[str]]:
    """Labels of a list of `whirl frf --from`, as the library finds them, and names of bodies."""
    text = ",".join(ends) if isinstance(ends, (list, tuple)) and all(isinstance(e, str) for e in ends) else ends
    if text is not None and not isinstance(text, str):
        raise TypeError(f"state_space() {option}: expected a text such as '7:x,ring:y' or a list of such, "
                        f"found {type(ends).__name__}")
    try:
        found = model.frf(from_=text or None, frequencies="1:2:1 rad/s", speed=speed, progress=False)
    except ModelError as error:
        raise ModelError([Problem(*(part.replace("--from", option) if isinstance(part, str) else part for part in p))
                          for p in error.problems]) from None
    labels = [str(label) for label in found.frf.to]  # of each of the forces, which are the same
    bodies = found.points.body_name if "body_name" in found.points else []
    return labels[:math.isqrt(len(labels))], {str(name) for name in bodies}


def _probes(model: Any, speed: Any) -> dict[str, float]:
    """Their angles [rad]."""
    try:
        model["probe"]
    except ModelError:
        return {}
    return {p["name"]: math.radians(p["angle_deg"]) for p in model.static(speed=speed, progress=False).probes}


class _Rows:
    """What ends are of the coordinates q: rows L with u = L q; forces act along their transposes."""

    def __init__(self, model: Any, speed: Any, dofs: list[str], bodies: set[str]) -> None:
        self._model, self._speed, self._bodies, self._n = model, speed, bodies, len(dofs)
        self._place = {name: i for i, names in enumerate(dofs) for name in names.split(" = ")}
        self._probes = _probes(model, speed)

    def of(self, option: str, label: str) -> np.ndarray:
        if label in self._probes:
            at = _ends(self._model, option, f"{label}:x", self._speed)[0][0].rpartition(" ")[0]
            angle = self._probes[label]
            return self._along(at, {"x": math.cos(angle), "y": math.sin(angle)})
        place, _, direction = label.rpartition(" ")
        if direction not in DIRECTIONS:
            raise ModelError([Problem(option, 0, 0, label, f"expected {', '.join(DIRECTIONS)} or a probe: a sense of "
                                      "whirl is no real signal")])
        return self._along(place, {direction: 1.0})

    def _along(self, place: str, parts: dict[str, float]) -> np.ndarray:
        at = place if place in self._bodies else f"node {place.split()[0]}"
        row = np.zeros(self._n)
        for direction, part in parts.items():
            i = self._place.get(f"{at} {direction}")
            if i is not None:  # else it is held there
                row[i] = part
        return row


def _shapes(M: np.ndarray, K: np.ndarray, dofs: list[str]) -> np.ndarray:
    """Modes without damping of a symmetric K: shapes of a modal mass of one, lowest frequency first.

    Of M v = mu (K + shift M) v, whose largest mu, of the lowest modes, are exact to the last digits; the shift
    lets free rotors have their rigid motions.
    """
    linalg = need("scipy.linalg")
    try:
        linalg.cholesky(M)
    except np.linalg.LinAlgError:
        still = [name for name, m in zip(dofs, M.diagonal()) if not m > 0]
        raise NumericalError("the mass matrix cannot be inverted, a state space needs a mass of every coordinate"
                             + (f"; without: {', '.join(still)}" if still else "")) from None
    scale = np.trace(K) / np.trace(M)
    for shift in np.maximum(scale, 1.0) * 10.0 ** np.arange(-12, 3):
        try:
            mu, shapes = linalg.eigh(M, K + shift * M)
        except np.linalg.LinAlgError:
            continue  # negative stiffness that is larger
        shapes = (shapes / np.sqrt(mu))[:, ::-1]
        # of the highest modes and of rigid motions mu, and thus the modal mass, is less exact
        return np.linalg.solve(np.linalg.cholesky(shapes.T @ M @ shapes), shapes.T).T
    raise NumericalError("the stiffness matrix is negative beyond all bounds")


def state_space(model: Any, inputs: Any, outputs: Any, quantity: Any, modes: Any, speed: Any) -> StateSpace:
    quantities = list(quantity) if isinstance(quantity, (list, tuple)) else [quantity]
    if not quantities or any(one not in QUANTITIES for one in quantities):
        raise ModelError([Problem("quantity", 0, 0, "", f"found {quantity!r}, expected {', '.join(QUANTITIES)} or "
                                  "several of them")])
    of = model.matrices(speed=speed)
    if modes is not None and not (isinstance(modes, (int, np.integer)) and 1 <= modes <= len(of.dofs)):
        raise ModelError([Problem("modes", 0, 0, "", f"found {modes!r}, expected 1 to {len(of.dofs)}")])
    from_, bodies = _ends(model, "inputs", inputs, speed)
    to = from_ if outputs is None else _ends(model, "outputs", outputs, speed)[0]
    rows = _Rows(model, speed, of.dofs, bodies)
    K = of.K.toarray()
    P = _shapes(of.M.toarray(), (K + K.T) / 2, of.dofs)[:, :modes]
    n = P.shape[1]
    forces = P.T @ np.transpose([rows.of("inputs", label) for label in from_])
    motions = np.array([rows.of("outputs", label) for label in to]) @ P
    damping, stiffness = -P.T @ (of.C + of.speed * of.G).toarray() @ P, -P.T @ K @ P
    zero = np.zeros
    C = {"displacement": np.hstack([motions, zero(motions.shape)]), "velocity": np.hstack([zero(motions.shape), motions]),
         "acceleration": np.hstack([motions @ stiffness, motions @ damping])}
    D = {"acceleration": motions @ forces}
    return StateSpace(
        np.block([[zero((n, n)), np.eye(n)], [stiffness, damping]]),
        np.vstack([zero(forces.shape), forces]),
        np.vstack([C[q] for q in quantities]),
        np.vstack([D.get(q, zero((len(to), len(from_)))) for q in quantities]),
        [f"mode {i + 1}{what}" for what in ("", " velocity") for i in range(n)], from_,
        [name if q == "displacement" else f"{name} {q}" for q in quantities for name in to], P, of.speed)
