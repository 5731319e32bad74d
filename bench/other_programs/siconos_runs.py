"""The cases as a user of Siconos writes them: an elastic contact as a complementarity, time stepping. Run as a program:

    siconos_runs.py CASE.npz

Prints rows. The law of the contact is  0 <= y = 1 - r + lambda,  0 <= lambda,  y lambda = 0:  its force lambda is the
depth r - 1 where that is above zero.
"""
import math
import pathlib
import sys

import numpy as np
import siconos.kernel as sk

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from other_programs.cases import REVOLUTIONS, Case  # noqa: E402
from other_programs.rows import TARGET, Row  # noqa: E402
from other_programs.timing import timed  # noqa: E402

STEPS = (100, 400, 1600, 6400, 16000)  # of a revolution, until the target is reached; more would take minutes
THETA = GAMMA = 0.5  # of second order; the default gamma of 1 leaves it at first order


class Rotor(sk.FirstOrderNonLinearDS):
    """Everything but the contact."""

    def __init__(self, case):
        super().__init__(case.start.copy())
        n = case.size
        self.case = case
        self.matrix = np.block([[np.zeros((n, n)), np.eye(n)], [-case.stiffness, -case.damping]])
        self.setFPtr(np.zeros(2 * n))
        self.setJacobianfxPtr(np.zeros((2 * n, 2 * n)))

    def computef(self, time, state=None):
        case = self.case
        f = self.matrix @ np.array(self.x() if state is None else state)
        f[case.size:] += case.load + case.cosine * math.cos(time) + case.sine * math.sin(time)
        self.f()[:] = f

    def computeJacobianfx(self, time, state=None):
        self.jacobianfx()[:] = self.matrix


class Ring(sk.FirstOrderNonLinearR):
    """The contact: y = h(x, lambda), input g(x, lambda)."""

    def __init__(self, case):
        super().__init__()
        self.case = case

    def normal(self, x):
        dx, dy = self.case.gap @ x[:self.case.size]
        r = math.hypot(dx, dy)
        return r, np.array([dx / r, dy / r])

    def turned(self, x, n):
        """What makes the direction of the force of the normal."""
        vx, vy = self.case.gap @ x[self.case.size:2 * self.case.size]
        mu = math.copysign(self.case.mu, self.case.rim - n[1] * vx + n[0] * vy)
        return np.array([[1.0, -mu], [mu, 1.0]])

    def computeh(self, time, x, force, z, y):
        y[0] = 1.0 - self.normal(x)[0] + force[0]

    def computeg(self, time, x, force, z, r):
        n = self.normal(x)[1]
        r[:self.case.size] = 0.0
        r[self.case.size:] = -force[0] * (self.case.by_force @ (self.turned(x, n) @ n))

    def computeJachx(self, time, x, force, z, C):
        C[0, :self.case.size] = -self.normal(x)[1] @ self.case.gap

    def computeJachlambda(self, time, x, force, z, D):
        D[0, 0] = 1.0

    def computeJacglambda(self, time, x, force, z, B):
        n = self.normal(x)[1]
        B[self.case.size:, 0] = -(self.case.by_force @ (self.turned(x, n) @ n))

    def computeJacgx(self, time, x, force, z, K):
        r, n = self.normal(x)
        across = (np.eye(2) - np.outer(n, n)) @ self.case.gap / r
        K[self.case.size:, :self.case.size] = -force[0] * (self.case.by_force @ self.turned(x, n) @ across)


def solve(case, steps):
    h = 2.0 * math.pi / steps
    rotor, ring = Rotor(case), Ring(case)
    model = sk.NonSmoothDynamicalSystem(0.0, 2.0 * math.pi * REVOLUTIONS + h)
    model.insertDynamicalSystem(rotor)
    model.link(sk.Interaction(sk.ComplementarityConditionNSL(1), ring), rotor)
    stepping = sk.TimeStepping(model, sk.TimeDiscretisation(0.0, h), sk.EulerMoreauOSI(THETA, GAMMA), sk.LCP())
    stepping.setNewtonTolerance(1e-11)
    stepping.setNewtonMaxIteration(20)
    stepping.initialize()
    begin_in_touch(case, rotor, ring)
    for _ in range(steps * REVOLUTIONS):
        stepping.computeOneStep()
        stepping.nextStep()
    return np.array(rotor.x())


def begin_in_touch(case, rotor, ring):
    """The force of the contact at the start, which Siconos takes to be zero."""
    force = np.zeros(2 * case.size)
    depth = ring.normal(case.start)[0] - 1.0
    if depth > 0.0:
        ring.computeg(0.0, case.start, [depth], None, force)
    rotor.rMemory().getSiconosVectorMutable(0)[:] = force


def main():
    case = Case.load_file(sys.argv[1])
    for steps in STEPS:
        end, seconds = timed(lambda: solve(case, steps))
        row = Row(case.name, "Siconos", f"{steps} steps", case.error(end), 1e6 * seconds / REVOLUTIONS)
        print(row.line(), flush=True)
        if row.error < TARGET:
            return


if __name__ == "__main__":
    main()
