"""The two cases as any program can take them: equations of first order without dimensions, start and end of the motion.

    p'' = load + cosine cos t + sine sin t - stiffness p - damping p' - by_force F
    d = gap p, r = |d|, n = d / r, slip = rim + n x d'
    F = (r - 1) (n + mu sign(slip) (-n_y, n_x)) where r > 1, else 0

Displacements are by the clearance c, times by 1 / Omega. A coordinate of a mode is by what moves some point of the
rotor by c.
"""
import dataclasses
import math
import pathlib
import tempfile

import numpy as np

REVOLUTIONS = 20
END = 2.0 * math.pi * REVOLUTIONS
MODELS = pathlib.Path(__file__).resolve().parent.parent.parent / "models"


@dataclasses.dataclass
class Problem:
    """A case as a person names it: what the equations need beyond the matrices, in SI, as the model file has it."""
    name: str
    title: str
    model: str
    settled: int       # revolutions before the start
    unbalance: tuple   # where, mass times offset
    contact: tuple     # where, against what
    clearance: float
    stiffness: float
    friction: float
    radius: float
    gravity: float


DISK = 7800.0 * math.pi / 4.0 * (0.3**2 - 0.02**2) * 0.01  # mass of a disk of the two-disk rotor [kg]
PROBLEMS = (
    Problem("P1", "P1: rotor and stator, five impacts a revolution", "jeffcott_stator.toml", 400,
            ("rotor", 50.0 * 1e-3), ("rotor", "stator"), 6e-3, 150e6, 0.1, 0.1, 9.81),
    Problem("two disks", "Two-disk rotor bouncing in a ring", "two_disk_mac.toml", 500, ("node 4", DISK * 0.5e-3),
            ("node 7", ""), 5e-3, 4e6, 0.0, 0.01, 0.0),
)


@dataclasses.dataclass
class Case:
    name: str
    stiffness: np.ndarray
    damping: np.ndarray   # with the gyroscopic matrix
    load: np.ndarray
    cosine: np.ndarray
    sine: np.ndarray
    gap: np.ndarray       # 2 by coordinates
    by_force: np.ndarray  # coordinates by 2
    mu: float
    rim: float
    start: np.ndarray     # p, p'
    end: np.ndarray       # after REVOLUTIONS, by whirl

    @property
    def size(self):
        return len(self.load)

    def error(self, state):
        """Of an end: the largest difference of all states."""
        difference = np.abs(np.asarray(state) - self.end)
        return float(difference.max()) if np.isfinite(difference).all() else math.nan

    def save(self, path):
        np.savez(path, **dataclasses.asdict(self))

    @staticmethod
    def load_file(path):
        with np.load(path) as file:
            read = {field.name: file[field.name] for field in dataclasses.fields(Case)}
        return Case(**{key: value if value.ndim else value.item() for key, value in read.items()})


def case_of(problem, whirl):
    """A case and the estimated error of its end: the difference of two methods."""
    model = whirl.read(MODELS / problem.model)
    runs = Runs(model, problem.settled)
    full = model.matrices()
    reduced = Reduced(full, np.array(runs.start.trajectory.basis), problem)
    case = Case(problem.name, *reduced.equations(full), problem.friction, problem.radius / problem.clearance,
                reduced.state(runs.start), reduced.state(runs.end("collocation", 1e-14)))
    return case, case.error(reduced.state(runs.end("taylor", 1e-15)))


class Runs:
    """The settled motion and where it goes from there."""

    def __init__(self, model, settled):
        self.model = model
        self.start = model.simulate(discard=settled - 1, revolutions=1, samples=16, method="taylor", tolerance=1e-14)

    def end(self, method, tolerance):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "start.h5"
            self.start.save(path)
            return self.model.simulate(from_=path, discard=0, revolutions=REVOLUTIONS, samples=16, method=method,
                                       tolerance=tolerance)


class Reduced:
    """Matrices and states of the coordinates that whirl integrates, made free of dimensions."""

    def __init__(self, full, basis, problem):
        self.problem, self.basis, self.speed = problem, basis, full.speed
        self.dofs = list(full.dofs)
        lateral = [i for i, name in enumerate(self.dofs) if name.endswith((" x", " y"))]
        self.scale = problem.clearance / np.abs(basis[lateral]).max(axis=0)
        self.inverse = np.linalg.inv(basis.T @ full.M.toarray() @ basis)

    def rows(self, place):
        return np.array([self.basis[self.dofs.index(f"{place} {axis}")] for axis in "xy"])

    def matrix(self, full):
        return (self.inverse @ (self.basis.T @ full @ self.basis)) * self.scale / self.scale[:, None]

    def acceleration(self, force):
        scale = self.scale if force.ndim == 1 else self.scale[:, None]
        return self.inverse @ force / scale / self.speed**2

    def equations(self, full):
        problem, speed = self.problem, self.speed
        M, C, G, K = (matrix.toarray() for matrix in (full.M, full.C, full.G, full.K))
        rotor, stator = problem.contact
        gap = self.rows(rotor) - (self.rows(stator) if stator else 0.0)
        at, moment = problem.unbalance
        cosine, sine = moment * speed**2 * self.rows(at)
        upward = np.array([float(name.endswith(" y")) for name in self.dofs])
        weight = -problem.gravity * self.basis.T @ (M @ upward)
        return (self.matrix(K) / speed**2, self.matrix(C + speed * G) / speed, self.acceleration(weight),
                self.acceleration(cosine), self.acceleration(sine), gap * self.scale / problem.clearance,
                self.acceleration(problem.stiffness * problem.clearance * gap.T))

    def state(self, run):
        def coordinates(values):
            return np.linalg.lstsq(self.basis, np.array(values), rcond=None)[0] / self.scale
        end = run.trajectory
        return np.concatenate([coordinates(end.end_displacement), coordinates(end.end_velocity) / self.speed])
