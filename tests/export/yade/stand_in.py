"""As much of YADE as an exported impact asks for: one sphere, a force on it, and the leapfrog scheme.

    python3 stand_in.py impact.py V
"""

import math
import sys
from types import SimpleNamespace


class Bodies(list):
    def append(self, body):
        super().append(body)
        return len(self) - 1


class Omega:
    """What the simulation is: bodies, engines that are called in turn, a time step."""

    def __init__(self):
        self.bodies, self.engines, self.dt, self.going = Bodies(), [], 0.0, True
        self.forces = SimpleNamespace(total=[0.0, 0.0, 0.0], addF=self.add)

    def add(self, body, force):
        self.forces.total = [a + b for a, b in zip(self.forces.total, force)]

    def pause(self):
        self.going = False

    def run(self, steps, wait):
        self.going = True
        while self.going and steps > 0:
            for engine in self.engines:
                engine()
            steps -= 1


O = Omega()


def sphere(center, radius, material):
    mass = material.density * 4.0 / 3.0 * math.pi * radius**3
    return SimpleNamespace(state=SimpleNamespace(pos=list(center), vel=[0.0, 0.0, 0.0], mass=mass))


def reset():
    O.forces.total = [0.0, 0.0, 0.0]


def move():
    state = O.bodies[0].state
    state.vel = [v + f / state.mass * O.dt for v, f in zip(state.vel, O.forces.total)]
    state.pos = [x + v * O.dt for x, v in zip(state.pos, state.vel)]


script = {
    "O": O,
    "utils": SimpleNamespace(sphere=sphere),
    "FrictMat": lambda density: SimpleNamespace(density=density),
    "ForceResetter": lambda: reset,
    "NewtonIntegrator": lambda damping, gravity: move,
    "PyRunner": lambda command, iterPeriod, initRun: lambda: eval(command, script),
}
sys.argv = sys.argv[1:]
exec(compile(open(sys.argv[0]).read(), sys.argv[0], "exec"), script)
