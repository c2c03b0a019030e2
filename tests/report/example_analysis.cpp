#include "example_analysis.hpp"

#include <array>
#include <cmath>

#include "core/random.hpp"
#include "core/units.hpp"
#include "impact/impact.hpp"

namespace recoil::sample {
namespace {

constexpr std::array<double, 4> diameters = {2.58e-6, 3.42e-6, 4.90e-6, 6.89e-6};  // [m]
constexpr double noise = 0.03;                                                     // sd of e [1]

Dataset sphere_dataset(const std::string& id, const std::string& surface, double modulus) {
  Dataset dataset;
  dataset.id = id;
  dataset.title = "Ammonium fluorescein spheres on " + surface;
  dataset.provenance = Provenance::reconstruction;
  dataset.system.particle = {"ammonium fluorescein", 1350.0, 1.2e9, 0.33, std::nullopt};
  dataset.system.surface = {surface, 10220.0, modulus, 0.31, std::nullopt};
  dataset.system.reference_diameter = 4.90e-6;
  dataset.sources = {"An example made for the tests, https://example.org/?a=1&b=2"};
  dataset.sha256 = std::string(60, 'a') + "0123";
  return dataset;
}

ParameterSlot slot(ParameterRole role, double initial, double upper, bool free) {
  ParameterSlot s;
  for (const Parameter& parameter : base_parameters()) {
    if (parameter.role == role) s.parameter = &parameter;
  }
  s.initial = initial;
  s.upper = upper;
  s.free = free;
  return s;
}

/// e at (diameter, velocity) under theta = (C_H, C_A, f0), straight from the impact stage.
double restitution(const ContactProperties& contact, const std::array<double, 3>& theta,
                   double diameter, double velocity) {
  ImpactConditions c;
  c.diameter = diameter;
  c.velocity = velocity;
  c.density = contact.particle_density;
  c.stiffness = contact.stiffness;
  c.adhesion_force = contact.adhesion_force_at(theta[2], diameter);
  c.hertz_damping = theta[0];
  c.adhesion_damping = theta[1];
  return std::sqrt(std::max(0.0, simulate_impact(impact_groups(c)).restitution_squared));
}

Interval between(double lower, double upper) {
  Interval interval;
  interval.lower = lower;
  interval.upper = upper;
  interval.shape = ProfileShape::bounded;
  return interval;
}

IntervalSet interval_set(double estimate, double error) {
  IntervalSet set;
  set[IntervalKind::wald] = between(estimate - 1.96 * error, estimate + 1.96 * error);
  set[IntervalKind::profile] = between(estimate - 1.85 * error, estimate + 2.10 * error);
  set[IntervalKind::percentile] = between(estimate - 1.80 * error, estimate + 2.05 * error);
  set[IntervalKind::bca] = between(estimate - 1.83 * error, estimate + 2.08 * error);
  set[IntervalKind::studentized] = no_interval(NoInterval::no_standard_error);
  set.recommended = IntervalKind::profile;
  return set;
}

/// Points, predictions, residuals and curves of one dataset, appended to `a`.
void add_dataset(Analysis& a, std::size_t k, const std::array<double, 3>& theta,
                 const std::array<double, 2>& two_point, bool with_capture) {
  Dataset& dataset = a.datasets[k];
  const ContactProperties& contact = a.fitted.model.contacts[k];
  RandomStream random(20260101, RandomPurpose::reconstruction, k);
  for (std::size_t d = 0; d < diameters.size(); ++d) {
    dataset.series.push_back("d" + std::to_string(d + 1));
    const double capture = 1.28 * std::pow(diameters[d] / 4.9e-6, -1.26);
    for (int i = 0; i < 8; ++i) {
      ImpactPoint point;
      point.series = d;
      point.diameter = diameters[d];
      point.incident_velocity = 1.25 * capture * std::pow(60.0 / capture, i / 7.0);
      point.events = 20;
      const double truth = restitution(contact, theta, point.diameter, point.incident_velocity);
      point.restitution = std::max(0.0, truth + noise * random.normal());
      if (with_capture && i == 0) {
        point.incident_velocity = 0.6 * capture;
        point.restitution = 0.0;
        point.captured = point.events;
      } else if (a.fitted.data.noise.sd_stated) {
        point.restitution_sd = noise;
      }
      dataset.points.push_back(point);
      Observation seen;
      seen.dataset = k;
      seen.series = d;
      seen.diameter = point.diameter;
      seen.velocity = point.incident_velocity;
      seen.restitution = point.restitution;
      seen.sd = a.fitted.data.noise.sd_stated ? noise : 1.0;
      seen.censored = point.all_captured();
      a.fitted.data.points.push_back(seen);
      a.fitted.weights.points.emplace_back().sd = seen.sd;
      const double fitted = seen.censored ? 0.0 : truth;
      a.fitted.prediction.push_back(fitted);
      a.fitted.prediction_squared.push_back(fitted * fitted);
      a.fitted.residuals.push_back((point.restitution - fitted) / seen.sd);
      a.fitted.leverage.push_back(0.02 + 0.02 * i);
    }
    RestitutionCurve curve;
    curve.dataset = k;
    curve.series = dataset.series[d];
    curve.diameter = diameters[d];
    for (int i = 0; i <= 80; ++i) {
      const double v = capture * std::pow(90.0 / capture, i / 80.0);
      const double e = restitution(contact, theta, curve.diameter, v);
      curve.velocity.push_back(v);
      curve.restitution.push_back(e);
      const double half = 0.01 + 0.05 * std::exp(-3.0 * (v / capture - 1.0));
      curve.lower.push_back(std::max(0.0, e - half));
      curve.upper.push_back(e + half);
      curve.two_point.push_back(
          restitution(contact, {two_point[0], two_point[1], theta[2]}, curve.diameter, v));
    }
    a.uncertainty.curves.push_back(curve);
    CaptureEstimate estimate;
    estimate.dataset = k;
    estimate.diameter = diameters[d];
    estimate.value = capture;
    estimate.found = true;
    estimate.interval = between(0.95 * capture, 1.06 * capture);
    a.uncertainty.capture.push_back(estimate);
  }
}

void add_two_point(Analysis& a, std::size_t k, double C_H, double C_A) {
  TwoPointComparison comparison;
  comparison.dataset = k;
  comparison.result.status = TwoPointStatus::converged;
  comparison.result.diameter = 4.9e-6;
  comparison.result.low_point = 32 * k + 16;
  comparison.result.high_point = 32 * k + 23;
  comparison.result.theta = a.fitted.theta;
  comparison.result.theta[a.fitted.model.slot_C_H[k]] = C_H;
  comparison.result.theta[a.fitted.model.slot_C_A[k]] = C_A;
  comparison.result.iterations = 6;
  comparison.rmse = 0.047;
  comparison.held_out_rmse = 0.052;
  comparison.full_rmse = 0.029;
  comparison.full_held_out_rmse = 0.034;
  comparison.rows = {
      {CalibrationKind::two_point, comparison.result.theta, "", 0.047, 0.052},
      {CalibrationKind::full, a.fitted.theta, "", 0.029, 0.034, a.fitted.std_error},
      {CalibrationKind::full_f0_free, {}, "no start converged", std::nullopt, std::nullopt}};
  comparison.spread.assign(a.fitted.theta.size(), 0.0);
  comparison.full_spread.assign(a.fitted.theta.size(), 0.0);
  comparison.spread[0] = 0.0011;
  comparison.spread[1] = 0.009;
  comparison.full_spread[0] = 0.0002;
  comparison.full_spread[1] = 0.002;
  comparison.failed = 12;
  a.uncertainty.two_point.push_back(comparison);
}

/// The profile of a normal likelihood.
std::vector<ProfilePoint> parabola(double estimate, double error) {
  std::vector<ProfilePoint> curve;
  for (int k = -14; k <= 14; ++k) {
    curve.push_back({estimate + 0.2 * k * error, 0.04 * k * k, 3.841458821});
  }
  return curve;
}

void add_statistics(Analysis& a, const std::vector<double>& errors) {
  FitResult& f = a.fitted;
  const std::size_t slots = f.model.slots.size();
  f.usable = true;
  f.at_bound.assign(slots, false);
  f.std_error = errors;
  f.covariance.assign(slots * slots, 0.0);
  for (std::size_t s = 0; s < slots; ++s) f.covariance[s * slots + s] = errors[s] * errors[s];
  f.covariance[1] = f.covariance[slots] = -0.43 * errors[0] * errors[1];
  for (const double residual : f.residuals) f.chi2 += residual * residual;
  f.dof = static_cast<int>(f.residuals.size()) - 2;
  f.p_value = 0.37;
  f.rmse = 0.0293;
  f.starts = {
      {{3e-3, 3e-2, 8.9}, f.theta, f.chi2, DescentEnd::minimum, "converged"},
      {{1e-2, 1e-1, 8.9}, f.theta, f.chi2, DescentEnd::minimum, "converged"},
      {{1e-4, 5.0, 8.9}, {1e-4, 5.0, 8.9}, 1e4, DescentEnd::no_answer, "no rebound at the start"}};

  UncertaintyResult& u = a.uncertainty;
  u.options.replicates = 1999;
  u.bootstrap.scheme = Scheme::parametric;
  u.bootstrap.because = SchemeBecause::sd_stated;
  u.bootstrap.replicates = 1999;
  u.bootstrap.failed = 3;
  u.bootstrap.seed = 20260101;
  u.bootstrap.two_point_failed.assign(a.datasets.size(), 12);
  u.bootstrap.two_point_theta.resize(a.datasets.size());
  for (std::uint64_t b = 0; b < 1996; ++b) {
    RandomStream random(20260101, RandomPurpose::bootstrap, b);
    std::vector<double> full = f.theta;
    std::vector<double> two = f.theta;
    const double x = random.normal();
    const double y = -0.43 * x + 0.9 * random.normal();
    full[0] += errors[0] * x;
    full[1] += errors[1] * y;
    for (std::size_t s = 2; s < slots; ++s) full[s] += errors[s] * random.normal();
    two[0] = std::max(0.0, two[0] + 5.0 * errors[0] * random.normal());
    two[1] = std::max(0.0, two[1] * 1.2 + 4.0 * errors[1] * random.normal());
    u.bootstrap.theta.push_back(full);
    if (b % 160 == 0) continue;  // a replicate in which the two-point iteration failed
    for (auto& converged : u.bootstrap.two_point_theta) converged.push_back(two);
  }
  for (std::size_t s = 0; s < slots; ++s) {
    u.intervals.push_back(f.model.slots[s].free ? interval_set(f.theta[s], errors[s])
                                                : IntervalSet{});
    if (f.model.slots[s].free) {
      u.intervals.back().profile_curve = parabola(f.theta[s], errors[s]);
    }
  }
  u.identifiability.verdict = IdentifiabilityVerdict::identifiable;
  for (std::size_t s = 0; s < slots; ++s) {
    u.identifiability.parameter.emplace_back().identifiable = f.model.slots[s].free;
  }
}

}  // namespace

Analysis four_diameters() {
  Analysis a;
  a.spec.id = "example-four";
  a.spec.file = "fits/example-four.toml";
  a.spec.sha256 = std::string(64, 'b');
  a.datasets = {sphere_dataset("example-molybdenum", "molybdenum", 320e9)};
  ImpactModel& model = a.fitted.model;
  model.contacts = {derive_contact(a.datasets[0].system, 4.9e-6)};
  model.surroundings = {surroundings_of(a.datasets[0].system, model.contacts[0])};
  const double f0 = model.contacts[0].adhesion_force;
  model.slots = {slot(ParameterRole::hertz_damping, 3e-3, 1.0, true),
                 slot(ParameterRole::adhesion_damping, 3e-2, 10.0, true),
                 slot(ParameterRole::adhesion_force, f0, 1e4, false)};
  model.slot_C_H = {0};
  model.slot_C_A = {1};
  model.slot_adhesion = {2};
  a.fitted.theta = {0.00312, 0.0487, f0};
  add_dataset(a, 0, {0.00312, 0.0487, f0}, {0.0046, 0.062}, false);
  add_statistics(a, {0.00021, 0.0023, 0.0});
  add_two_point(a, 0, 0.0046, 0.062);
  return a;
}

Analysis two_datasets() {
  Analysis a;
  a.spec.id = "example-joint";
  a.spec.file = "fits/example-joint.toml";
  a.datasets = {sphere_dataset("example-molybdenum", "molybdenum", 320e9),
                sphere_dataset("example-silicon", "silicon", 131e9)};
  a.datasets[1].provenance = Provenance::measured;
  a.fitted.data.noise.sd_stated = false;
  ImpactModel& model = a.fitted.model;
  for (const Dataset& dataset : a.datasets) {
    model.contacts.push_back(derive_contact(dataset.system, 4.9e-6));
    model.surroundings.push_back(surroundings_of(dataset.system, model.contacts.back()));
  }
  model.contacts[1].contradictions = {
      "stiffness_K = 11.4 GPa is stated, but the elastic constants give K = 113 GPa"};
  model.slots = {slot(ParameterRole::hertz_damping, 3e-3, 1.0, true),
                 slot(ParameterRole::adhesion_damping, 3e-2, 10.0, true),
                 slot(ParameterRole::adhesion_force, 8.9, 1e4, true),
                 slot(ParameterRole::adhesion_force, 6.6, 1e4, true)};
  model.slots[2].dataset = a.datasets[0].id;
  model.slots[3].dataset = a.datasets[1].id;
  model.slot_C_H = {0, 0};
  model.slot_C_A = {1, 1};
  model.slot_adhesion = {2, 3};
  a.fitted.theta = {0.00312, 0.0487, 8.9, 5.9};
  add_dataset(a, 0, {0.00312, 0.0487, 8.9}, {0.0046, 0.062}, true);
  add_dataset(a, 1, {0.00312, 0.0487, 5.9}, {0.0046, 0.062}, true);
  add_statistics(a, {0.00021, 0.0023, 0.4, 0.3});
  a.fitted.noise_scale = noise;
  a.fitted.noise_verdict = NoiseVerdict::estimated;
  add_two_point(a, 0, 0.0046, 0.062);
  add_two_point(a, 1, 0.0041, 0.055);
  a.uncertainty.two_point[1].result.status = TwoPointStatus::no_adhesion_damping;
  return a;
}

}  // namespace recoil::sample
