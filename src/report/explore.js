// Adds controls to the pictures of e(V) that compute the curve for other parameters.
//
// A JSON script of class explore follows a picture. It holds the parameters and the points
// (fit_report_figures.cpp). The controls are in a folded element below the picture. window.recoil
// holds the functions for tests.
"use strict";

window.recoil = (() => {
  // ---------------------------------------------------------------- numerical tools

  const midpoints = [2, 4, 6, 8, 10, 12, 14];

  // One step of length `h` for dq/ds = u, du/ds = force(q, u): modified midpoint rule with 2 to 14
  // substeps, extrapolated to infinitely many (Gragg 1965; Bulirsch & Stoer 1966). `error` is the
  // change by the last extrapolation.
  function step(force, q, u, h) {
    const a0 = force(q, u);
    const rowsQ = [], rowsU = [];
    for (let j = 0; j < midpoints.length; ++j) {
      const n = midpoints[j], part = h / n;
      let q0 = q, u0 = u, q1 = q + part * u, u1 = u + part * a0;
      for (let i = 1; i < n; ++i) {
        const q2 = q0 + 2 * part * u1, u2 = u0 + 2 * part * force(q1, u1);
        q0 = q1; u0 = u1; q1 = q2; u1 = u2;
      }
      let newQ = 0.5 * (q0 + q1 + part * u1), newU = 0.5 * (u0 + u1 + part * force(q1, u1));
      for (let k = 0; k < j; ++k) {
        const ratio = n / midpoints[j - 1 - k], factor = 1 / (ratio * ratio - 1);
        const oldQ = rowsQ[k], oldU = rowsU[k];
        rowsQ[k] = newQ; rowsU[k] = newU;
        newQ += (newQ - oldQ) * factor;
        newU += (newU - oldU) * factor;
      }
      rowsQ[j] = newQ; rowsU[j] = newU;
    }
    const last = midpoints.length - 1;
    const error = Math.max(Math.abs(rowsQ[last] - rowsQ[last - 1]) / Math.max(1, Math.abs(q)),
                           Math.abs(rowsU[last] - rowsU[last - 1]) / Math.max(1, Math.abs(u)));
    return {q: rowsQ[last], u: rowsU[last], error};
  }

  // The root of `g` between a and b: regula falsi with the Illinois rule and bisection.
  function root(g, a, b) {
    let ga = g(a), gb = g(b);
    if (ga === 0) return a;
    if (gb === 0) return b;
    for (let i = 0; i < 200; ++i) {
      let c = b - gb * (b - a) / (gb - ga);
      if (i % 4 === 3 || !(c > Math.min(a, b) && c < Math.max(a, b))) c = 0.5 * (a + b);
      const gc = g(c);
      if (gc === 0) return c;
      if ((gc < 0) === (gb < 0)) { ga *= 0.5; } else { a = b; ga = gb; }
      b = c; gb = gc;
      if (Math.abs(b - a) <= 1e-15 * Math.abs(b) + 1e-300) break;
    }
    return b;
  }

  // ln Phi(x) of the standard normal distribution.
  function logNormal(x) {
    if (x < -4) {  // Mills ratio as a continued fraction
      let fraction = 0;
      for (let k = 60; k > 0; --k) fraction = k / (-x + fraction);
      return -0.5 * x * x - Math.log(-x + fraction) - 0.5 * Math.log(2 * Math.PI);
    }
    if (x > 4) return Math.log1p(-Math.exp(logNormal(-x)));
    let term = x, sum = x;
    for (let k = 1; k < 200 && Math.abs(term) > 1e-18 * Math.abs(sum); ++k) {
      term *= x * x / (2 * k + 1);
      sum += term;
    }
    return Math.log(0.5 + sum * Math.exp(-0.5 * x * x) / Math.sqrt(2 * Math.PI));
  }

  // E[sqrt(u + z) | u + z > 0], z standard normal: with t = sqrt(u + z) the integrand is even, and
  // the trapezoid rule exact.
  function meanOfSurvivors(u) {
    const middle = u > 1 ? Math.sqrt(u) : 0;
    const width = u > 1 ? 0.5 / middle : 1 / Math.sqrt(1 + Math.max(0, -u));
    const to = middle + 14 * width + 2 * Math.min(1, width), h = to / 4000;
    let above = 0;
    for (let i = 1; i <= 4000; ++i) {
      const t = i * h;
      above += 2 * t * t * Math.exp(-0.5 * (t * t - u) * (t * t - u) + (u < 0 ? 0.5 * u * u : 0));
    }
    above *= h / Math.sqrt(2 * Math.PI);
    return above / Math.exp(logNormal(u) + (u < 0 ? 0.5 * u * u : 0));
  }

  // ---------------------------------------------------------------- the laws of contact

  // Every law is dimensionless, lengths in n_c = (V^2 m / (sqrt(r) K))^(2/5), velocities in V, and
  // regular in its own coordinate q: dq/ds = u, du/ds = force(q, u). Contact begins at q = start with
  // u = 1 and ends at q = release, where the potential is 0. The equilibrium is at `resting`. `acts`
  // is 1 while C_A acts.

  // Li, Dunn & Brach (1999), eq. 5; penetration q^2.
  function ring(alpha, beta, gamma) {
    const law = {
      start: 0, release: 0, resting: Math.sqrt(beta), acts: 0,
      force: (q, u) => 2 * q * q * (beta * (1 - law.acts * gamma * u) - q * q * (1 + alpha * u)),
      potential: q => q * q * q * (0.4 * q * q - 2 / 3 * beta),
      creeps: (alpha + gamma) * Math.pow(beta, 1.25) >= 2
    };
    return law;
  }

  // Derjaguin, Muller & Toporov (1975); penetration q^2.
  function dmt(alpha, beta, gamma) {
    const pull = Math.pow(beta, 1.5) / 3;
    const law = {
      start: 0, release: 0, resting: Math.cbrt(pull), acts: 0,
      force: (q, u) => 2 * q * (pull * (1 - law.acts * gamma * u) - q * q * q * (1 + alpha * u)),
      potential: q => q * q * (0.4 * q * q * q - pull),
      creeps: false
    };
    return law;
  }

  // Johnson, Kendall & Roberts (1971); q^2 is the contact radius over that at separation.
  function jkr(alpha, beta, gamma) {
    const strength = 4 * Math.pow(6, -10 / 3) * Math.pow(beta, 2.5);
    const law = {
      start: Math.cbrt(4), release: 1, resting: Math.cbrt(6), acts: 0,
      force: (q, u) => {
        const cube = q * q * q;
        return -strength * (cube - 1) * cube *
               (cube * (1 + alpha * u) - 6 * (1 - law.acts * gamma * u));
      },
      potential: q => {
        const fourth = q * q * q * q;
        return strength * (fourth * fourth * q * q / 10 - fourth * q * q * q + 1.5 * fourth - 0.6);
      },
      creeps: (alpha + gamma) * Math.pow(beta, 1.25) >= 2 * Math.sqrt(0.9)
    };
    return law;
  }

  // The contact of Maugis (1992) in his units, at s = (m^2 - 1)^(-1/2), m = c / a; `gap`: the
  // stress acts across a gap (Kim, McMeeking & Johnson 1998), and c goes on in -s^2.
  function maugisContact(s, lambda, gap) {
    const inside = gap ? 0 : s, beyond = gap ? -s * s : 0;
    const secant = Math.sqrt(1 + inside * inside), inverse = 1 / secant;
    const angle = Math.atan2(1, inside), tangent = 1 / (inside + secant);
    const share = inside * inverse, inverse2 = inverse * inverse;
    const first = (angle * (1 - inside * inside) + inside) * inverse2;
    const half = 4 / 3 * (angle - tangent) * inverse * lambda * lambda;
    const discriminant = Math.sqrt(half * half + 2 * first * lambda);
    const edge = 2 / (half + discriminant);
    const slope = lambda * edge * angle * inverse2 * inverse2 *
                  (edge + 2 / 3 * secant * lambda) / discriminant;  // of c in s^2
    const outer = edge + beyond * slope;
    const inverse3 = inverse2 * inverse;
    const onset = edge * edge * inverse3 * inverse +
                  lambda * (2 / 3 * inverse3 * edge - 4 / 3 * inverse * slope);
    const rateInSquare = onset + 2 * share * share * edge * slope + beyond * slope * slope;
    const radius = outer * share, square = outer * outer;
    const elastic = radius * radius * radius;
    const adhesive = lambda * square * (inside * inverse2 + angle);
    const approach = edge * edge * share * share - 4 / 3 * inverse * lambda * edge +
                     beyond * (onset + 0.5 * beyond * slope * slope);
    const moment = 0.2 * Math.pow(radius, 5) -
                   0.25 * lambda * square * square *
                       (angle + share * inverse * (5 / 3 * share * share + inverse2));
    const energy = (approach * (elastic - adhesive) - square + moment) / 3;
    const rate = 2 * (gap ? -s : s) * rateInSquare;
    return {outer, edge, slope, rate, rateInSquare, elastic, adhesive, approach, energy};
  }

  const knownPaths = new Map();  // by lambda

  // The places where contact begins and ends, and the equilibrium.
  function maugisPath(lambda) {
    if (knownPaths.has(lambda)) return knownPaths.get(lambda);
    const touch = maugisContact(0, lambda, false), far = 2 * (1 + lambda);
    const parting = 8 * lambda / (3 * Math.PI), reach = 2 / (Math.PI * lambda);
    const across = outer => -Math.sqrt((touch.edge - outer) / touch.slope);
    const at = s => maugisContact(s, lambda, false);
    const release = parting <= touch.edge ? across(parting)
                                          : root(s => at(s).rateInSquare, 0, far);
    const start = 2 * parting <= touch.edge
                      ? across(2 * parting)
                      : root(s => at(s).approach + reach, Math.max(0, release), far);
    const resting = root(s => at(s).elastic - at(s).adhesive, Math.max(0, release), far);
    const path = {release, start, resting, scale: Math.sqrt(1 + 2 / 3 * lambda * lambda),
                  energy: maugisContact(release, lambda, release < 0).energy};
    if (knownPaths.size > 500) knownPaths.clear();
    knownPaths.set(lambda, path);
    return path;
  }

  function maugis(alpha, beta, gamma, lambda) {
    const strength = Math.pow(6, -5 / 3) * Math.pow(beta, 2.5);
    const path = maugisPath(lambda), scale = path.scale;
    const law = {
      start: path.start / scale, release: path.release / scale, resting: path.resting / scale,
      acts: 0, gap: path.start < 0, seam: path.release < 0, creeps: false,
      force: (q, u) => {
        const c = maugisContact(q * scale, lambda, law.gap);
        return -strength * scale * c.rate *
               (c.elastic * (1 + alpha * u) - c.adhesive * (1 - law.acts * gamma * u));
      },
      potential: q =>
          strength * (maugisContact(q * scale, lambda, q < 0).energy - path.energy)
    };
    return law;
  }

  // ---------------------------------------------------------------- one impact

  // e^2 of one impact; for a capture 2 E / (m V^2) < 0 at the outer turning point. NaN if the
  // integration does not finish.
  function integrate(law, bothPhases) {
    const floor = 2 * law.potential(law.resting);
    if (law.creeps) return floor;
    const tolerance = 1e-13, most = 20000;
    let q = law.start, u = 1, turned = false, length = 0.1;
    law.acts = bothPhases ? 1 : 0;
    for (let i = 0; i < most; ++i) {
      const to = step(law.force, q, u, length);
      if (!(to.error <= tolerance) && length > 1e-7) {
        length *= to.error > 0 ? Math.max(0.2, 0.8 * Math.pow(tolerance / to.error, 1 / 13)) : 0.2;
        continue;
      }
      // The first event within this step.
      let first = length, event = null;
      const consider = (name, g) => {
        const at = root(h => (h === 0 ? g(q, u) : g2(g, h)), 0, first);
        if (at <= first) { first = at; event = name; }
      };
      const g2 = (g, h) => { const there = step(law.force, q, u, h); return g(there.q, there.u); };
      if (law.seam && q * to.q < 0) consider("seam", here => here);
      if (turned ? to.u >= 0 && u < 0 : to.u <= 0 && u > 0) consider("turn", (_, speed) => speed);
      if (turned && to.q <= law.release && (event !== "seam")) {
        consider("release", here => here - law.release);
      }
      const there = event ? step(law.force, q, u, first) : to;
      q = there.q; u = there.u;
      if (event === "release") return u * u;
      if (event === "turn") {
        if (turned) return Math.min(0, 2 * law.potential(q));
        turned = true; u = 0; law.acts = 1;
      }
      if (event === "seam") { q = 0; law.gap = !law.gap; }
      if (turned && u * u + 2 * law.potential(q) < (1 - 1e-10) * floor) return floor;
      length *= Math.min(4, 0.9 * Math.pow(tolerance / Math.max(to.error, 1e-20), 1 / 13));
    }
    return turned && u * u + 2 * law.potential(q) < 0 ? floor : NaN;
  }

  // f0 [N/m] at `diameter` [m]: the parameter's own, or that of W by eqs 9 and 10 of the paper,
  // growing with r^(1/3).
  function adhesionForce(values, diameter) {
    const force = lawOf(values).byForce
        ? values.adhesion
        : Math.pow(6 * Math.PI * values.adhesion, 2 / 3) *
              Math.cbrt(values.stiffness * values.reference_diameter / 2) / (2 * Math.PI);
    return force * Math.cbrt(diameter / values.reference_diameter);
  }

  // The velocity [m/s] at which adhesion and inertia balance.
  function adhesionVelocity(values, diameter) {
    const radius = diameter / 2, mass = Math.PI / 6 * values.density * Math.pow(diameter, 3);
    return Math.pow(2 * Math.PI * adhesionForce(values, diameter), 1.25) * Math.pow(radius, 0.25) *
           Math.pow(values.stiffness, -0.75) * Math.pow(mass, -0.5);
  }

  // The laws of adhesion that this script computes. Another law throws.
  const laws = {
    ring: {byForce: true, jumps: false, vanishes: () => false, contact: ring},
    dmt: {byForce: false, jumps: false, vanishes: () => false, contact: dmt},
    jkr: {byForce: false, jumps: true, vanishes: beta => beta < 1e-14, contact: jkr},
    maugis: {byForce: false, jumps: true, contact: maugis,
             vanishes: (beta, lambda) => beta < 1e-8 || lambda < 1e-6}
  };
  function lawOf(values) {
    if (!(values.law in laws)) throw new Error("unknown law of adhesion: " + values.law);
    return laws[values.law];
  }

  // e^2 at V [m/s] and diameter [m]. `values`: law, phase, C_H and C_A [s/m], adhesion (f0 [N/m] or
  // W [J/m2]), stiffness [Pa], density [kg/m3], reference_diameter and separation [m].
  function restitutionSquared(velocity, diameter, values) {
    const beta = Math.pow(adhesionVelocity(values, diameter) / velocity, 0.8);
    const alpha = values.C_H * velocity, gamma = values.C_A * velocity;
    const both = values.phase === "both";
    const lambda = 4 * Math.pow(6, -2 / 3) * 16 / (9 * Math.sqrt(3)) *
                   adhesionForce(values, diameter) / (values.stiffness * values.separation);
    const law = lawOf(values);
    const contact = law.vanishes(beta, lambda) ? ring(alpha, 0, gamma)
                                               : law.contact(alpha, beta, gamma, lambda);
    return integrate(contact, both);
  }

  function restitution(velocity, diameter, values) {
    return Math.sqrt(Math.max(0, restitutionSquared(velocity, diameter, values)));
  }

  // The capture velocity [m/s]; 0 if no sphere is captured, NaN if all are.
  function captureVelocity(diameter, values) {
    const scale = adhesionVelocity(values, diameter);
    if (!(scale > 0) || (!lawOf(values).jumps && values.C_H === 0 && values.C_A === 0)) return 0;
    const captured = v => !(restitutionSquared(v, diameter, values) > 0);
    let low = 0.3 * scale, high = low;
    while (captured(high) && high < 1e6 * scale) high *= 2;
    if (captured(high)) return NaN;
    low = high / 2;
    while (!captured(low) && low > 1e-4 * scale) low /= 2;
    if (!captured(low)) return 0;
    while (high - low > 1e-9 * high) {
      const middle = Math.sqrt(low * high);
      if (middle <= low || middle >= high) break;
      if (captured(middle)) low = middle; else high = middle;
    }
    return high;
  }

  // ---------------------------------------------------------------- the misfit

  // The square of a point's weighted residual where the model has e^2 = m, as the fit weighs it.
  function square(point, m, student) {
    let r2;
    const s2 = point.sd * point.sd, input2 = point.input_sd * point.input_sd;
    if (point.scatter > 0 || point.censored) {
      const own = point.scatter > 0 ? point.scatter : Math.sqrt(2) * s2;
      const spread2 = point.scatter > 0 ? own * own + input2 : 2 * s2 * s2 + input2;
      const weight = point.scatter > 0
          ? (1 + (point.events - 1) * own * own / spread2) / point.events
          : 1 / point.events;
      const z = (m + point.shift) / Math.sqrt(spread2);
      const rebounds = point.events - point.captured;
      if (point.censored) {
        r2 = -2 * weight * point.events * logNormal(-z);
      } else {
        const root = Math.sqrt(point.scatter);
        const miss = (point.restitution - root * meanOfSurvivors((m + point.shift) / point.scatter)) /
                     point.mean_sd;
        r2 = miss * miss - point.least;
        if (point.counted) {
          r2 -= 2 * weight * (point.captured * logNormal(-z) + rebounds * logNormal(z));
        }
      }
    } else {
      const hypotenuse = Math.hypot(m, s2);
      const psi = Math.sqrt(m >= 0 ? 0.5 * (m + hypotenuse) : 0.5 * s2 * s2 / (hypotenuse - m));
      const sum = point.restitution + psi;
      const miss = point.restitution * point.restitution - s2 - m;
      r2 = miss * miss / (s2 * (sum * sum + 2 * s2) + input2);
    }
    r2 = Math.max(0, r2);
    return student
        ? student.unit * student.unit * (student.nu + 1) * Math.log1p(r2 / student.nu) : r2;
  }

  // chi2 of the points of a panel with all diameters scaled by `diameter` / panel.diameter.
  function misfit(panel, diameter, values) {
    return panel.points.reduce((sum, row) => {
      const point = pointOf(panel, row);
      const m = restitutionSquared(point.velocity, point.diameter * diameter / panel.diameter,
                                   values);
      return sum + square(point, m, panel.student);
    }, 0);
  }

  // A point from a row of numbers under panel.columns. Values without a column are 0.
  function pointOf(panel, row) {
    const point = {input_sd: 0, scatter: 0, shift: 0, censored: 0, captured: 0, counted: 0};
    panel.columns.forEach((name, i) => { point[name] = row[i]; });
    return point;
  }

  // ---------------------------------------------------------------- controls

  const svgNamespace = "http://www.w3.org/2000/svg";

  function element(name, properties, ...children) {
    const made = Object.assign(document.createElement(name), properties);
    made.append(...children);
    return made;
  }

  function shown(x) {
    if (!isFinite(x)) return "–";
    return Math.abs(x) >= 1e-3 && Math.abs(x) < 1e5 || x === 0 ? String(Number(x.toPrecision(4)))
                                                             : x.toExponential(3);
  }

  // A slider whose steps are factors, and the number beside it. The fitted value is in the middle.
  function control(name, unit, fitted, otherwise, reach, least, change) {
    const middle = fitted > 0 ? fitted : otherwise;
    const slider = element("input", {type: "range", min: "0", max: "1000", step: "1"});
    const number = element("input", {type: "number", min: String(least), step: "any"});
    const html = name.replace(/^(\w)_?(\w)$/, "<i>$1</i><sub>$2</sub>").replace(/^W$/, "<i>W</i>");
    const words = element("span");
    words.innerHTML = html + " [" + unit + "]";  // contains no text from the data
    slider.setAttribute("aria-label", name + " [" + unit + "], slider");
    number.setAttribute("aria-label", name + " [" + unit + "]");
    const own = {value: fitted};
    const set = (value, from) => {
      own.value = value;
      if (from !== number) number.value = String(Number(value.toPrecision(5)));
      if (from !== slider) {
        const place = 500 + 500 * Math.log(value / middle) / Math.log(reach);
        slider.value = String(value > 0 ? Math.min(1000, Math.max(1, place)) : 0);
      }
    };
    slider.addEventListener("input", () => {
      const place = Number(slider.value);
      set(place === 0 && least === 0 ? 0 : middle * Math.pow(reach, (place - 500) / 500), slider);
      change();
    });
    number.addEventListener("input", () => {
      const value = Number(number.value);
      if (number.value === "" || !(value >= least) || !isFinite(value)) return;
      set(value, number);
      change();
    });
    own.set = value => set(value, null);
    own.row = element("div", {className: "control"}, words, slider, number);
    own.set(fitted);
    return own;
  }

  // `frame`: left, top, right and foot of the axes in the picture.
  function curvePath(panel, [left, top, right, foot], diameter, values, capture) {
    const [slowest, fastest] = panel.velocities;
    const [least, most] = panel.restitutions;
    const place = (velocity, e) => {
      const x = left + (right - left) * Math.log(velocity / slowest) / Math.log(fastest / slowest);
      return x.toFixed(1) + " " + (foot - (foot - top) * Math.max(0, Math.min(1, (e - least) / (most - least)))).toFixed(1);
    };
    const velocities = [];
    for (let i = 0; i <= 100; ++i) velocities.push(slowest * Math.pow(fastest / slowest, i / 100));
    if (capture > slowest && capture < fastest) {
      for (let k = 1; k <= 8; ++k) velocities.push(capture * (1 + Math.pow(2, -2 * k)));
      velocities.push(capture * (1 - 1e-9));
    }
    velocities.sort((a, b) => a - b);
    return "M" + velocities.filter(v => v <= fastest)
                           .map(v => place(v, restitution(v, diameter, values))).join("L");
  }

  function controls(data) {
    const panel = JSON.parse(data.textContent);
    const figure = data.closest("figure");
    const svg = figure.querySelector("svg");
    const path = document.createElementNS(svgNamespace, "path");
    path.setAttribute("class", "explored");
    path.setAttribute("stroke", "#222222");
    path.setAttribute("stroke-width", "1.8");
    path.setAttribute("stroke-dasharray", "7 3 1.5 3");
    path.setAttribute("fill", "none");
    // The rectangle of the axes is what clips the picture's curves.
    const frame = svg.querySelector("clipPath path").getAttribute("d").match(/[\d.]+/g).map(Number);
    const result = element("p", {className: "explored-result"});
    result.setAttribute("aria-live", "polite");
    let waiting = false;
    const draw = () => {
      waiting = false;
      if (!folded.open) { path.remove(); return; }
      const values = Object.assign({}, panel, {C_H: own.C_H.value, C_A: own.C_A.value,
                                               adhesion: own.adhesion.value});
      const diameter = own.diameter.value * 1e-6;
      const capture = captureVelocity(diameter, values);
      path.setAttribute("d", curvePath(panel, frame, diameter, values, capture));
      svg.append(path);
      const stays = capture === 0 ? "no sphere is captured" : isNaN(capture)
          ? "every sphere is captured" : "capture below V* = " + shown(capture) + " m/s";
      result.textContent = "Dash-dotted: " + stays + "; chi2 of the " + panel.points.length +
          " points shown is " + shown(misfit(panel, diameter, values)) + ", under the fit " +
          shown(panel.chi2) + ".";
    };
    const change = () => {
      if (waiting) return;
      waiting = true;
      requestAnimationFrame(draw);
    };
    const adhesionUnit = panel.adhesion_unit + " at " + shown(panel.reference_diameter * 1e6) +
                         " µm";
    const own = {
      C_H: control("C_H", "s/m", panel.C_H, 1e-3, 100, 0, change),
      C_A: control("C_A", "s/m", panel.C_A, 1e-2, 100, 0, change),
      adhesion: control(panel.adhesion_name, lawOf(panel).byForce ? adhesionUnit : "J/m²",
                        panel.adhesion, lawOf(panel).byForce ? 1 : 0.05, 10, 0, change),
      diameter: control("diameter", "µm", panel.diameter * 1e6, 1, 5, 1e-6, change)
    };
    const back = element("button", {type: "button", textContent: "Back to the fit"});
    back.addEventListener("click", () => {
      for (const name of ["C_H", "C_A", "adhesion"]) own[name].set(panel[name]);
      own.diameter.set(panel.diameter * 1e6);
      change();
    });
    const folded = element("details", {className: "explore"},
        element("summary", {textContent: "Explore: other values of the parameters"}),
        ...Object.values(own).map(one => one.row), back, result);
    folded.addEventListener("toggle", change);
    figure.append(folded);
  }

  document.addEventListener("DOMContentLoaded", () => {
    document.querySelectorAll("script.explore").forEach(controls);
  });

  return {restitution, restitutionSquared, captureVelocity, misfit};
})();
