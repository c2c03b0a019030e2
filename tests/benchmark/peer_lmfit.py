"""The fit of recoil's benchmark as a careful user of lmfit and scipy would write it.

    python3 peer_lmfit.py FOLDER [--first]

FOLDER holds points.csv (diameter in um, velocities in m/s) and constants.json (SI units), which
recoil_benchmark writes; peer_lmfit.json is left there. --first runs the first setting once and no
other. Nothing here comes from recoil: the model is
written down anew from equation 5 of Li, Dunn & Brach (1999), J. Aerosol Sci. 30, 439-449,

    m n'' = -sqrt(r) K n^(3/2) (1 + C_H n') + 2 pi sqrt(r n) f0 (1 + C_A s),

with s = -n' while the sphere moves outward and 0 before, and f0 proportional to r^(1/3).

What makes it careful: lengths and velocities are scaled to order one, plain floats instead of
arrays of two run in the right-hand side, the integration ends at events instead of on a grid, e^2
is continued below capture so that the residuals have a slope there, and the differences that
leastsq takes are much longer than the integrator's errors. Less careful settings are run as well,
to see what they cost.
"""

import csv
import json
import os
import statistics
import sys
import time
from math import hypot, isfinite, pi, sqrt

for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ.setdefault(threads, "1")  # one fit, one thread

import lmfit  # noqa: E402
import numpy as np  # noqa: E402
import scipy  # noqa: E402
from scipy.integrate import solve_ivp  # noqa: E402

# name, method, rtol, epsfcn of leastsq (None: its default, the machine's epsilon). The first is the
# peer: the fastest of those tried (LSODA, DOP853 and RK45 at tolerances of 1e-7 to 1e-11) that is
# safely within 1 % of a standard error. The others show what more and less care does.
SETTINGS = [
    ("careful", "LSODA", 1e-8, 1e-6),
    ("tighter", "DOP853", 1e-9, 1e-8),
    ("leastsq's own differences", "DOP853", 1e-8, None),
    ("looser", "RK45", 1e-6, 1e-8),
    ("all defaults", "RK45", 1e-3, None),
]
REPEATS = 3
SECONDS_FOR_REPEATS = 120.0


class Point:
    """One measured point, with the constants of its sphere."""

    def __init__(self, row, constants):
        self.velocity = float(row["incident_velocity"])
        self.restitution = float(row["restitution"])
        self.sd = float(row["restitution_sd"])
        radius = 0.5e-6 * float(row["diameter"])
        mass = constants["density"] * 4.0 / 3.0 * pi * radius**3
        spring = sqrt(radius) * constants["stiffness"] / mass
        length = (self.velocity**2 / spring) ** 0.4
        size = (2.0 * radius / constants["reference_diameter"]) ** (1.0 / 3.0)
        # the adhesive acceleration per f0, in units of velocity^2 / length
        self.adhesion = 2.0 * pi * sqrt(radius * length) * size / mass * length / self.velocity**2


def released(_, y, *__):
    return y[0]


def turned_back(_, y, *__):
    return y[1]


released.terminal, released.direction = True, -1.0
turned_back.terminal, turned_back.direction = True, 1.0


def motion(_, y, alpha, beta, gamma):
    depth, speed = y
    if depth <= 0.0:
        return (speed, 0.0)
    root = sqrt(depth)
    outward = -speed if speed < 0.0 else 0.0
    return (
        speed,
        -root * depth * (1.0 + alpha * speed) + beta * root * (1.0 + gamma * outward),
    )


def restitution_squared(point, C_H, C_A, f0, method, rtol):
    """Mechanical energy at the end over the incident kinetic energy: e^2 after a rebound, and below
    zero when the sphere turns back while it still sticks."""
    beta = point.adhesion * f0
    solution = solve_ivp(
        motion,
        (0.0, 1e4),
        (0.0, 1.0),
        method=method,
        rtol=rtol,
        atol=1e-2 * rtol,
        events=(released, turned_back),
        args=(C_H * point.velocity, beta, C_A * point.velocity),
    )
    depth, speed = solution.y[:, -1]
    depth = max(depth, 0.0)
    return speed**2 + 0.8 * depth**2.5 - 4.0 / 3.0 * beta * depth**1.5


def residuals(parameters, points, method, rtol):
    """e^2 against e^2, which runs smoothly through capture, over its standard deviation
    sd sqrt((e + e_model)^2 + 2 sd^2); far from capture that is (e - e_model) / sd."""
    C_H, C_A, f0 = (parameters[name].value for name in ("C_H", "C_A", "f0"))
    result = np.empty(len(points))
    for i, point in enumerate(points):
        model = restitution_squared(point, C_H, C_A, f0, method, rtol)
        variance = point.sd**2
        root = sqrt(max(0.0, 0.5 * (model + hypot(model, variance))))
        width = point.sd * sqrt((point.restitution + root) ** 2 + 2.0 * variance)
        result[i] = (point.restitution**2 - variance - model) / width
    return result


def parameters_of(values):
    parameters = lmfit.Parameters()
    for name, value in values.items():
        parameters.add(name, value=value, min=0.0)
    return parameters


def finite(number):
    """Itself, or None: lmfit has no standard error when its differences came out singular."""
    return number if number is not None and isfinite(number) else None


def integration_errors(setting, points, estimate):
    """What the setting's integrator does to the residuals at the estimate, and to the differences
    that leastsq takes of them, beside a much tighter one: the largest error of a residual, and the
    largest relative error of a column of the Jacobian."""
    _, method, rtol, epsfcn = setting

    def column(name, step, *integrator):
        moved = dict(estimate)
        moved[name] *= 1.0 + step
        here, there = (residuals(parameters_of(p), points, *integrator) for p in (estimate, moved))
        return (there - here) / step, here

    worst_residual, worst_column = 0.0, 0.0
    for name in estimate:
        mine, here = column(name, sqrt(epsfcn or np.finfo(float).eps), method, rtol)
        true, truly = column(name, 1e-4, "LSODA", 1e-11)
        worst_residual = max(worst_residual, np.max(np.abs(here - truly)))
        worst_column = max(worst_column, np.linalg.norm(mine - true) / np.linalg.norm(true))
    return {"residual_error": worst_residual, "difference_error": worst_column}


def run(setting, points, start):
    name, method, rtol, epsfcn = setting
    parameters = parameters_of(start)
    options = {} if epsfcn is None else {"epsfcn": epsfcn}
    begin, cpu_begin = time.perf_counter(), time.process_time()
    fit = lmfit.minimize(
        residuals,
        parameters,
        method="leastsq",
        args=(points, method, rtol),
        scale_covar=False,
        **options,
    )
    seconds, cpu_seconds = time.perf_counter() - begin, time.process_time() - cpu_begin
    return {
        "name": name,
        "method": method,
        "rtol": rtol,
        "epsfcn": epsfcn,
        "seconds": seconds,
        "cpu_seconds": cpu_seconds,
        "evaluations": fit.nfev,
        "success": bool(fit.success),
        "chi2": fit.chisqr,
        "estimate": {k: fit.params[k].value for k in start},
        "std_error": {k: finite(fit.params[k].stderr) for k in start},
    }


def main(folder, only_first=False):
    with open(os.path.join(folder, "constants.json")) as file:
        constants = json.load(file)
    with open(os.path.join(folder, "points.csv"), newline="") as file:
        points = [Point(row, constants) for row in csv.DictReader(file)]
    start = constants["start"]

    fits = [run(SETTINGS[0], points, start)]
    seconds = [fits[0]["seconds"]]
    while not only_first and len(seconds) < REPEATS and sum(seconds) + seconds[0] < SECONDS_FOR_REPEATS:
        seconds.append(run(SETTINGS[0], points, start)["seconds"])
    fits[0]["seconds"] = statistics.median(seconds)
    fits[0]["repeats"] = len(seconds)
    if not only_first:
        fits += [run(setting, points, start) for setting in SETTINGS[1:]]
        for setting, fit in zip(SETTINGS, fits):
            fit.update(integration_errors(setting, points, fit["estimate"]))

    result = {
        "versions": {
            "python": sys.version.split()[0],
            "lmfit": lmfit.__version__,
            "scipy": scipy.__version__,
            "numpy": np.__version__,
        },
        "fits": fits,
    }
    with open(os.path.join(folder, "peer_lmfit.json"), "w") as file:
        json.dump(result, file, indent=2)


if __name__ == "__main__":
    main(sys.argv[1], "--first" in sys.argv[2:])
