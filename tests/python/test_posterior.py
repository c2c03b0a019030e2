"""The posterior against emcee (Foreman-Mackey et al. 2013, PASP 125, 306) with a density of its own:
impacts by Runge-Kutta, likelihood and priors as docs/posterior.md writes them down, and of recoil's
results only what that page says is held fixed."""

import csv
import json
import resource

import emcee
import numpy as np
import pytest
from conftest import SOURCE
from numpy.polynomial import chebyshev
from scipy.special import log_ndtr
from scipy.stats import gaussian_kde, norm, rankdata, truncnorm


def energy_left(alpha, beta, gamma, step=0.01):
    """e^2 of many impacts: twice the energy, in m V^2, when the sphere leaves or, captured, turns
    for the second time. With q = (n / n_c)^(1/2), u the velocity and dt = 2 q ds."""
    e2 = np.empty_like(beta)
    out = np.zeros(len(beta), bool)
    q, u = np.zeros_like(beta), np.ones_like(beta)
    open_ = np.arange(len(beta))

    def rates(q, u, clock, a, b, c):
        f = 2 * q * q * (b * (1 - c * u) - q * q * (1 + a * u))
        if clock == "s":
            return u, f
        return (u / f, 1.0) if clock == "u" else (1.0, f / u)

    def gone(q, u, h, clock, *groups):
        k1 = rates(q, u, clock, *groups)
        k2 = rates(q + h / 2 * k1[0], u + h / 2 * k1[1], clock, *groups)
        k3 = rates(q + h / 2 * k2[0], u + h / 2 * k2[1], clock, *groups)
        k4 = rates(q + h * k3[0], u + h * k3[1], clock, *groups)
        return tuple(x + h / 6 * (a + 2 * b + 2 * c + d)
                     for x, a, b, c, d in zip((q, u), k1, k2, k3, k4, strict=True))

    while len(open_):
        groups = (alpha[open_], beta[open_], np.where(out[open_], gamma[open_], 0.0))
        at = q[open_], u[open_]
        to_q, to_u = gone(*at, step, "s", *groups)
        leaves = out[open_] & (to_q <= 0)
        turns = ~leaves & np.where(out[open_], to_u >= 0, to_u <= 0)
        for event, clock in ((leaves, "q"), (turns, "u")):  # onto it: what vanishes is the clock
            if not event.any():
                continue
            some = tuple(x[event] for x in at)
            own = tuple(x[event] for x in groups)
            for left in (4, 3, 2, 1):
                some = gone(*some, -some[0 if clock == "q" else 1] / left, clock, *own)
            to_q[event], to_u[event] = some
        q[open_], u[open_] = to_q, to_u
        ended = leaves | (turns & out[open_])
        done = open_[ended]
        e2[done] = u[done]**2 + 0.8 * q[done]**5 - 4 / 3 * beta[done] * q[done]**3
        out[open_[turns]] = True
        open_ = open_[~ended]
    return e2


class Experiment:
    """The points of a shipped dataset, and what recoil's fit holds fixed in its posterior."""

    def __init__(self, fit):
        contact, = fit["model"]["contacts"]
        with open(SOURCE / "datasets" / contact["dataset"] / "points.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        column = lambda name: np.array([float(row[name]) for row in rows])
        self.velocity, self.e = column("incident_velocity"), column("restitution")
        self.sd = np.array([point["sd_used"] for point in fit["residuals"]])
        self.events = column("events")
        self.captured = column("captured") if "captured" in rows[0] else 0 * self.events
        self.input_sd = np.array([point["sd_of_e2_from_inputs"] for point in fit["residuals"]])
        radius = 0.5e-6 * column("diameter")
        mass = 4 / 3 * np.pi * radius**3 * contact["particle_density_kg_per_m3"]
        self.A = np.sqrt(radius) * contact["stiffness_K_Pa"] / mass
        f0 = contact["f0_N_per_m"] * (radius / (0.5e-6 * contact["reference_diameter_um"]))**(1 / 3)
        self.B = 2 * np.pi * np.sqrt(radius) * f0 / mass

    def squares(self, damping, velocity=None):
        """e^2 [sets of (C_H, C_A)][points]."""
        V = self.velocity if velocity is None else velocity
        shape = len(damping), len(V)
        beta = np.broadcast_to(self.B * self.A**-0.6 * V**-0.8, shape)
        alpha, gamma = (np.outer(column, V) for column in np.transpose(damping))
        return energy_left(alpha.ravel(), beta.ravel(), gamma.ravel()).reshape(shape)


class Grid:
    """e^2 of every point over a box of (C_H, C_A), as products of Chebyshev polynomials."""

    def __init__(self, experiment, lower, upper, degree=18):
        self.middle, self.half = (upper + lower) / 2, (upper - lower) / 2
        nodes = chebyshev.chebpts1(degree + 1)
        mesh = np.array([(a, b) for a in nodes for b in nodes])
        values = experiment.squares(self.middle + self.half * mesh)
        fit = np.linalg.inv(chebyshev.chebvander(nodes, degree))
        cube = values.reshape(degree + 1, degree + 1, -1)
        self.coefficients = np.einsum("ai,bj,ijn->abn", fit, fit, cube).reshape(-1, cube.shape[2])
        self.degree = degree

    def __call__(self, thetas):
        """e^2 [thetas][points]"""
        x, y = np.swapaxes(chebyshev.chebvander((thetas - self.middle) / self.half, self.degree), 0, 1)
        return (x[:, :, None] * y[:, None, :]).reshape(len(x), -1) @ self.coefficients


def deviance_of_means(experiment, m):
    """r^2 of each mean of rebounds."""
    e, variance = experiment.e, experiment.sd**2
    psi = np.sqrt((m + np.hypot(m, variance)) / 2)
    width = variance * ((e + psi)**2 + 2 * variance) + experiment.input_sd**2
    return (e**2 - variance - m)**2 / width


class Survivors:
    """Impacts that differ: e^2 is normal from impact to impact, what is below zero is captured."""

    def __init__(self, experiment, best, spread):
        h = np.sqrt(3) * spread
        less, at, more = (experiment.squares([best], experiment.velocity * np.exp(k * h))[0]
                          for k in (-1, 0, 1))
        slope, bend = (more - less) / (2 * h), (more - 2 * at + less) / h**2
        self.shift = spread**2 / 2 * bend
        self.scatter = np.sqrt(spread**2 * slope**2 + spread**4 / 2 * bend**2)
        u = (at + self.shift) / self.scatter
        self.used = (u < 30) | (experiment.captured > 0)
        rebounds = experiment.events - experiment.captured
        step = 1e-4
        growth = (self.mean(u + step) - self.mean(u - step)) / (2 * step) / np.sqrt(self.scatter)
        own = np.sqrt(self.scatter * (self.truncated(u, 1) - self.mean(u)**2) / rebounds)
        self.mean_sd = np.hypot(np.maximum(experiment.sd, own), growth * experiment.input_sd)
        total = np.hypot(self.scatter, experiment.input_sd)
        own_share = self.scatter**2 / total**2
        self.total = total
        self.share = (1 + (experiment.events - 1) * own_share) / experiment.events
        self.experiment = experiment

    nodes, weights = np.polynomial.legendre.leggauss(60)

    @classmethod
    def truncated(cls, u, power):
        """E (u + z)^power over the normal z > -u, by t = (u + z)^(1/2)."""
        low, high = (np.sqrt(np.maximum(end, 0))[..., None] for end in (u - 9, np.maximum(u, 0) + 9))
        t = low + (cls.nodes + 1) / 2 * (high - low)
        density = np.exp(-(t**2 - u[..., None])**2 / 2 - log_ndtr(u)[..., None]) / np.sqrt(2 * np.pi)
        return (cls.weights * (high - low) * t * t**(2 * power) * density).sum(axis=-1)

    @classmethod
    def mean(cls, u):
        return cls.truncated(u, 0.5)

    def deviance(self, m):
        x = m + self.shift
        at = self.experiment
        means = (at.e - np.sqrt(self.scatter) * self.mean(x / self.scatter)) / self.mean_sd
        counts = (at.captured * log_ndtr(-x / self.total)
                  + (at.events - at.captured) * log_ndtr(x / self.total))
        return np.where(self.used, means**2 - 2 * self.share * counts, deviance_of_means(at, m))


def quantile_error(draws, p, effective):
    at = np.quantile(draws, p)
    return np.sqrt(p * (1 - p) / effective) / gaussian_kde(draws[::50])(at)[0]


@pytest.mark.parametrize("name, noise", [("li1999-sst65-silicon", "captures"),
                                         ("dahneke1975-quartz", "stated"),
                                         ("dahneke1975-quartz", "estimated")])
def test_posterior_is_that_of_emcee(place, command, name, noise):
    text = (SOURCE / "fits" / f"{name}.toml").read_text().replace("../datasets", "datasets")
    text += "posterior = true\nmaterials = false\n"
    text = text.replace("[model]\n", "[model]\nmixed_sizes = false\n")
    if noise == "estimated":
        text += '[noise]\nvariance = "constant"\n'
    (place / "fit.toml").write_text(text)
    done = command("fit", "fit.toml", "--replicates", "0", "--out", "out")
    assert done.status == 0, done.err
    fit = json.loads((place / "out" / "fit.json").read_text())
    names = ["C_H", "C_A"]
    best, error = (np.array([fit["parameters"][n][key] for n in names])
                   for key in ("value", "std_error"))
    bounds = np.array([fit["options"]["parameters"][n]["bounds"] for n in names])
    experiment = Experiment(fit)

    # The model is that of the fit.
    predicted = np.array([point["predicted"] for point in fit["residuals"]])
    assert np.allclose(experiment.squares([best])[0], predicted**2, atol=1e-7)

    lower = np.maximum(bounds[:, 0], best - 8 * error)
    upper = np.minimum(bounds[:, 1], best + 8 * error)
    grid = Grid(experiment, lower, upper)
    random = np.random.default_rng(1)
    trials = random.uniform(lower, upper, (20, 2))
    assert np.allclose(grid(trials), experiment.squares(trials), atol=5e-5)

    spread = fit["noise"]["event_spread"]
    survivors = Survivors(experiment, best, spread) if spread else None
    assert (spread is not None) == (noise == "captures")
    assert noise == "estimated" or fit["goodness"]["noise_scale"] == 1

    def log_posterior(thetas):
        inside = ((thetas > lower) & (thetas < upper)).all(axis=1)
        m = grid(np.clip(thetas, lower, upper))
        each = survivors.deviance(m) if survivors else deviance_of_means(experiment, m)
        total = each.sum(axis=1)
        density = -m.shape[1] / 2 * np.log(total) if noise == "estimated" else -total / 2
        return np.where(inside, density, -np.inf)

    walkers = 40
    start = random.uniform(np.maximum(lower, best - error), best + error, (walkers, 2))
    np.random.seed(1)
    sampler = emcee.EnsembleSampler(walkers, 2, log_posterior, vectorize=True)
    steps = 4000
    sampler.run_mcmc(start, steps)
    warm_up = steps // 10
    draws = sampler.get_chain(discard=warm_up, flat=True)
    effective = len(draws) / sampler.get_autocorr_time(discard=warm_up)
    # Ends of the box that are no bounds cut nothing off.
    inner = (draws > lower + 0.01 * (upper - lower)) | (lower == bounds[:, 0])
    assert (inner & (draws < upper - 0.01 * (upper - lower))).all()

    rows = list(csv.DictReader(open(place / "out" / "posterior.csv", newline="")))
    ours = np.array([[float(row[n]) for n in names] for row in rows])
    assert len(ours) >= 1000
    for k, n in enumerate(names):
        posterior = fit["posterior"]["parameters"][n]
        theirs, both = draws[:, k], 1 / (1 / effective[k] + 1 / posterior["effective_draws"])
        assert both > 500
        sd = theirs.std()
        spread_error = sd * np.sqrt((np.mean((theirs - theirs.mean())**4) / sd**4 - 1) / 4 / both)
        assert abs(posterior["mean"] - theirs.mean()) < 4 * sd / np.sqrt(both)
        assert abs(posterior["sd"] - sd) < 4 * spread_error
        ends = fit["parameters"][n]["intervals"]["posterior"]
        for end, p in zip(ends, (0.025, 0.975), strict=True):
            assert abs(end - np.quantile(theirs, p)) < 4 * quantile_error(theirs, p, both)
            assert abs(np.quantile(ours[:, k], p) - np.quantile(theirs, p)) < \
                4 * quantile_error(theirs, p, min(both, 1000))
    # The joint draws hang together as theirs do: arctanh of a correlation has the error 1/sqrt(N).
    ours_together, theirs_together = (np.arctanh(np.corrcoef(d.T)[0, 1]) for d in (ours, draws))
    assert abs(ours_together - theirs_together) < 4 / np.sqrt(1000)


def folded_r_hat(chains):
    """R-hat as Vehtari et al. (2021) write it: chains [chain, draw] in halves, ranks r of all S draws
    as normal scores Phi^-1((r - 3/8) / (S + 1/4)), of the draws and of |draw - median|."""
    halves = chains.reshape(2 * len(chains), -1)

    def r_hat(x):
        z = norm.ppf((rankdata(x).reshape(x.shape) - 0.375) / (x.size + 0.25))
        n = x.shape[1]
        within = z.var(axis=1, ddof=1).mean()
        return np.sqrt((within * (n - 1) / n + z.mean(axis=1).var(ddof=1)) / within)

    return max(r_hat(halves), r_hat(np.abs(halves - np.median(halves))))


@pytest.mark.parametrize("materials", ["true", '"adjust"'])
@pytest.mark.parametrize("name", sorted(p.stem for p in (SOURCE / "fits").glob("*.toml")))
def test_every_shipped_fit_settles_in_ten_seconds(place, command, name, materials):
    text = (SOURCE / "fits" / f"{name}.toml").read_text().replace("../datasets", "datasets")
    assert "[uncertainty]" in text
    text = text.replace("[uncertainty]", f"[uncertainty]\nposterior = true\nmaterials = {materials}")
    (place / "fit.toml").write_text(text)
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    done = command("fit", "fit.toml", "--replicates", "0", "--out", "out")
    assert done.status == 0, done.err
    assert resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before < 10
    fit = json.loads((place / "out" / "fit.json").read_text())
    posterior = fit["posterior"]
    assert posterior["missing"] is None
    rows = list(csv.DictReader(open(place / "out" / "posterior.csv", newline="")))
    shape = posterior["chains"], posterior["draws"] // posterior["chains"]
    assert [(int(row["chain"]), int(row["draw"])) for row in rows] == [
        (c + 1, i + 1) for c in range(shape[0]) for i in range(shape[1])]
    for parameter, found in posterior["parameters"].items():
        assert found["r_hat"] < 1.01
        assert min(found["effective_draws"], found["effective_tail_draws"]) >= 400
        draws = np.array([float(row[parameter]) for row in rows])
        # The two draws beside the median are equally far from it: nine digits decide which is first.
        assert found["r_hat"] == pytest.approx(folded_r_hat(draws.reshape(shape)), abs=5e-5)
        assert found["mean"] == pytest.approx(draws.mean(), rel=1e-6)
    with open(place / "out" / "log_likelihood.csv", newline="") as file:
        header, *points = csv.reader(file)
    assert header == ["chain", "draw", *(str(i + 1) for i in range(len(fit["residuals"])))]
    assert [point[:2] for point in points] == [[row["chain"], row["draw"]] for row in rows]
    assert np.allclose(np.array(points, dtype=float)[:, 2:].sum(axis=1),
                       [float(row["log_likelihood"]) for row in rows], atol=1e-4)
    # ln likelihood of all points together: of the sum of their terms, elpd lies below the best.
    loo = posterior["loo"]
    assert len(loo["pareto_k"]) == len(fit["residuals"])
    best = max(float(row["log_likelihood"]) for row in rows)
    assert loo["elpd"] == pytest.approx(sum(loo["elpd_of_points"]))
    assert 0 < loo["p_loo"] and loo["elpd"] < best


# The signatures of from_dict, as arviz_base 1.x (io_dict.py) and ArviZ 0.22 (data/io_dict.py) have
# them, without their bodies.
def from_dict_1(data, *, name=None, sample_dims=None, save_warmup=None, index_origin=None, coords=None,
                dims=None, pred_dims=None, pred_coords=None, check_conventions=True, attrs=None):
    return data


def from_dict_0(posterior=None, *, posterior_predictive=None, predictions=None, sample_stats=None,
                log_likelihood=None, prior=None, prior_predictive=None, sample_stats_prior=None,
                observed_data=None, constant_data=None, predictions_constant_data=None, coords=None,
                dims=None, attrs=None):
    return {"posterior": posterior, "sample_stats": sample_stats, "log_likelihood": log_likelihood,
            "observed_data": observed_data}


def test_draws_are_what_arviz_reads(here):
    import recoil

    result = recoil.fit("mine", uncertainty={"posterior": True}, replicates=0)
    draws = result.draws()
    chains, length = draws["posterior"]["C_A"].shape
    assert chains * length == result.facts.posterior.draws
    assert draws["posterior"]["C_A"].mean() == pytest.approx(
        result.facts.posterior.parameters.C_A.mean)
    groups = {"posterior", "sample_stats", "log_likelihood", "observed_data"}
    assert groups == set(from_dict_1(draws)) == set(from_dict_0(**draws)) == set(draws)
    assert all(isinstance(name, str) and values.shape[:2] == (chains, length)
               for group in groups - {"observed_data"} for name, values in draws[group].items())
    pointwise = draws["log_likelihood"]["restitution"]
    assert pointwise.shape == (chains, length, len(draws["observed_data"]["restitution"]))
    stats = draws["sample_stats"]
    assert np.allclose(pointwise.sum(axis=2), stats["log_likelihood"])
    assert np.allclose(stats["lp"], stats["log_likelihood"] + stats["log_prior"])
    # Importance sampling without smoothing: good to a few hundredths where k is small.
    loo = result.facts.posterior.loo
    for k, (elpd, shape) in enumerate(zip(loo.elpd_of_points, loo.pareto_k, strict=True)):
        if shape is not None and shape < 0.3:
            raw = -np.log(np.mean(np.exp(-pointwise[:, :, k])))
            assert elpd == pytest.approx(raw, abs=0.05)
    with pytest.raises(recoil.InputError, match="not sampled"):
        recoil.fit("mine", replicates=0).draws()
