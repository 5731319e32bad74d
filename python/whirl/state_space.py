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
    Coordinates without mass follow the others at once, and forces on them by more: at once where nothing damps
    them, else by amplitudes c of dampers, which are further states: x = (a, a', c).
    """

    A: np.ndarray
    """(2 n + m, 2 n + m) for n modes and m dampers of coordinates without mass"""
    B: np.ndarray
    """(2 n + m, inputs)"""
    C: np.ndarray
    """(outputs, 2 n + m)"""
    D: np.ndarray
    """(outputs, inputs); 0 but of accelerations, and where something has no mass"""
    states: list[str]
    """What each x is: 'mode 1', ..., 'mode 1 velocity', ..., 'damper 1', ..."""
    inputs: list[str]
    """What each u is: '7 ring x' is a force [N], '7 ring theta_x' a moment [N m]."""
    outputs: list[str]
    """What each y is: '7 ring x' [m], '7 ring x velocity' [m/s], '7 ring theta_x acceleration' [rad/s^2]."""
    shapes: np.ndarray
    """(coordinates, n), of a modal mass of 1 kg; lowest frequency first. Of coordinates without mass as they
    follow the others."""
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
        raise ModelError([p._replace(file=p.file.replace("--from", option), message=p.message.replace("--from", option))
                          for p in error.problems]) from None
    labels = [str(label) for label in found.frf.to]  # of each of the forces, which are the same
    bodies = found.points.body_name if "body_name" in found.points else []
    return labels[:math.isqrt(len(labels))], {str(name) for name in bodies}


def _probes(model: Any, speed: Any) -> dict[str, dict[str, float]]:
    """How much of each direction they read, as in docs/model-file.md."""
    try:
        model["probe"]
    except ModelError:
        return {}
    parts = {}
    for p in model.static(speed=speed, progress=False).probes:
        angle, radius = math.radians(p["angle_deg"]), p.get("face_radius_m")
        c, s = math.cos(angle), math.sin(angle)
        parts[p["name"]] = {"theta_x": radius * s, "theta_y": -radius * c} if radius else {"x": c, "y": s}
    return parts


class _Rows:
    """What ends are of the coordinates q: rows L with u = L q; forces act along their transposes."""

    def __init__(self, model: Any, speed: Any, dofs: list[str], bodies: set[str]) -> None:
        self._model, self._speed, self._bodies, self._n = model, speed, bodies, len(dofs)
        self._place = {name: i for i, names in enumerate(dofs) for name in names.split(" = ")}
        self._probes = _probes(model, speed)

    def of(self, option: str, label: str) -> np.ndarray:
        if label in self._probes:
            at = _ends(self._model, option, f"{label}:x", self._speed)[0][0].rpartition(" ")[0]
            return self._along(at, self._probes[label])
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


def _shapes(M: np.ndarray, K: np.ndarray) -> np.ndarray:
    """Modes without damping of a symmetric K: shapes of a modal mass of one, lowest frequency first.

    Of M v = mu (K + shift M) v, whose largest mu, of the lowest modes, are exact to the last digits; the shift
    lets free rotors have their rigid motions.
    """
    linalg = need("scipy.linalg")
    try:
        linalg.cholesky(M)
    except np.linalg.LinAlgError:
        raise NumericalError("the mass matrix cannot be inverted") from None
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


def _solved(K: np.ndarray, right: np.ndarray, dofs: list[str]) -> np.ndarray:
    """K^-1 right of coordinates without mass."""
    try:
        if K.size == 0 or np.linalg.cond(K) < 1e14:
            return np.linalg.solve(K, right)
    except np.linalg.LinAlgError:
        pass
    raise NumericalError(f"something has neither mass nor stiffness, among {', '.join(dofs)}")


def _without_rounding(value: np.ndarray, scale: np.ndarray) -> np.ndarray:
    """Zero where terms of a size cancel."""
    return np.where(np.abs(value) <= 1e-12 * scale, 0.0, value)


class _Rotor:
    """q = T a + w, where w is of the coordinates s without mass only, which follow the others by T:

      T' M T a'' + T' D (T a' + w') + T' K (T a + w) = T' f,   T' M T = 1
      D_ss w' + K_ss w = f_s - D_s T a',                       K_s T = 0

    Of K_ss^-1 D_ss = L V', with a column of orthonormal V for every damper, c = V' w are states:

      w = g - L c',   V' L c' = V' g - c,   g = K_ss^-1 (f_s - D_s T a')

    `forces` are columns, one per input.
    """

    def __init__(self, of: Any, forces: np.ndarray, modes: Any) -> None:
        M, D, K = of.M.toarray(), (of.C + of.speed * of.G).toarray(), of.K.toarray()
        has_mass = M.diagonal() > 0.0
        if not has_mass.any():
            raise NumericalError("nothing that moves has a mass")
        m, s = np.flatnonzero(has_mass), np.flatnonzero(~has_mass)
        named = ", ".join(of.dofs[i] for i in s)
        Kss, Kms = K[np.ix_(s, s)], K[np.ix_(m, s)]
        if s.size and np.linalg.cond(Kss) > 1e14:
            raise NumericalError(f"some of these have neither mass nor stiffness: {named}")
        follow = -np.linalg.solve(Kss, K[np.ix_(s, m)])
        condensed = K[np.ix_(m, m)] + Kms @ follow
        P = _shapes(M[np.ix_(m, m)], (condensed + condensed.T) / 2)[:, :modes]
        T = np.zeros((len(M), P.shape[1]))
        T[m], T[s] = P, follow @ P

        U, S, Vt = np.linalg.svd(np.linalg.solve(Kss, D[np.ix_(s, s)])) if s.size else 3 * (np.zeros((0, 0)),)
        rank = int(np.sum(S > 1e-12 * np.max(S, initial=0.0)))
        L, V = U[:, :rank] * S[:rank], Vt[:rank].T
        if np.any(_without_rounding(D[:, s] - D[:, s] @ V @ V.T, np.abs(D).max())) or (
                rank and np.linalg.cond(V.T @ L) > 1e12):
            raise NumericalError(f"these have no mass, and dampers of which no state follows: {named}")
        # c', w and a'' by what they come of: a, a' (v), c and the inputs (f)
        g_v = -np.linalg.solve(Kss, _without_rounding(D[s] @ T, np.abs(D[s]) @ np.abs(T)))
        g_f = np.linalg.solve(Kss, forces[s])
        c_c = -np.linalg.inv(V.T @ L)
        c_v, c_f = -c_c @ V.T @ g_v, -c_c @ V.T @ g_f
        w_v, w_f = (_without_rounding(g - L @ c, np.abs(g) + np.abs(L) @ np.abs(c)) for g, c in ((g_v, c_v), (g_f, c_f)))
        w_c = -L @ c_c
        by_c = T.T @ D[:, s] @ V
        by_w = _without_rounding(T.T @ K[:, s], np.abs(T.T) @ np.abs(K[:, s]))
        n, zero = P.shape[1], np.zeros
        self.A = np.block([[zero((n, n)), np.eye(n), zero((n, rank))],
                           [-T.T @ K @ T, -T.T @ D @ T - by_c @ c_v - by_w @ w_v, -by_c @ c_c - by_w @ w_c],
                           [zero((rank, n)), c_v, c_c]])
        self.B = np.vstack([zero((n, forces.shape[1])), T.T @ forces - by_c @ c_f - by_w @ w_f, c_f])
        self.shapes = T
        self.states = [f"mode {i + 1}{what}" for what in ("", " velocity") for i in range(n)] + [
            f"damper {i + 1}" for i in range(rank)]
        self._still, self._of_still = s, (w_v, w_c, w_f)

    def motions(self, rows: np.ndarray, labels: list[str], quantity: str) -> tuple[np.ndarray, np.ndarray]:
        """C and D of a quantity of rows of coordinates."""
        w_v, w_c, w_f = (rows[:, self._still] @ w for w in self._of_still)
        C, D = np.hstack([rows @ self.shapes, w_v, w_c]), w_f
        for _ in range(QUANTITIES.index(quantity)):
            jumps = [label for label, row in zip(labels, D) if np.any(row)]
            if jumps:
                raise NumericalError(f"{', '.join(jumps)}: without a mass there, an input makes it jump, and its "
                                     f"{quantity} is none; take another quantity, or give it a mass")
            C, D = C @ self.A, C @ self.B
        return C, D


def state_space(model: Any, inputs: Any, outputs: Any, quantity: Any, modes: Any, speed: Any) -> StateSpace:
    quantities = list(quantity) if isinstance(quantity, (list, tuple)) else [quantity]
    if not quantities or any(one not in QUANTITIES for one in quantities):
        raise ModelError([Problem("quantity", 0, 0, "", f"found {quantity!r}, expected {', '.join(QUANTITIES)} or "
                                  "several of them")])
    of = model.matrices(speed=speed)
    most = int(np.sum(of.M.diagonal() > 0.0))
    if modes is not None and not (isinstance(modes, (int, np.integer)) and 1 <= modes <= most):
        raise ModelError([Problem("modes", 0, 0, "", f"found {modes!r}, expected 1 to {most}")])
    from_, bodies = _ends(model, "inputs", inputs, speed)
    to = from_ if outputs is None else _ends(model, "outputs", outputs, speed)[0]
    rows = _Rows(model, speed, of.dofs, bodies)
    rotor = _Rotor(of, np.transpose([rows.of("inputs", label) for label in from_]), modes)
    motions = np.array([rows.of("outputs", label) for label in to])
    C, D = zip(*(rotor.motions(motions, to, q) for q in quantities))
    return StateSpace(rotor.A, rotor.B, np.vstack(C), np.vstack(D), rotor.states, from_,
                      [name if q == "displacement" else f"{name} {q}" for q in quantities for name in to],
                      rotor.shapes, of.speed)
