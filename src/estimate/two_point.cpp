#include "estimate/two_point.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace recoil {
namespace {

constexpr int most_iterations = 200;
constexpr double at_rest = 1e-8;         // relative change of both factors
constexpr double root_tolerance = 1e-9;  // relative, of each factor; Newton ends far below it

struct Excess {
  double value;  // e^2 of the model minus e^2 of the point
  double slope;  // d value / d damping, negative
};

/// Searches the damping in [0, upper] at which `excess` (which falls with damping) vanishes: Newton
/// from `guess`, kept inside a bracket. It asks for one value after the other, so that many
/// searches can be answered together.
class DampingSearch {
 public:
  DampingSearch(double guess, double upper) : damping_(guess), high_(upper), upper_(upper) {}

  /// Where the excess is wanted next.
  double damping() const { return damping_; }
  bool done() const { return done_; }
  /// Nothing when even no damping leaves the excess below zero, the largest leaves it above, or the
  /// model has no answer.
  std::optional<double> found() const { return found_; }

  void answer(const Excess& at) {
    if (!std::isfinite(at.value)) return end(std::nullopt);
    if (damping_ == 0.0) {
      if (at.value < 0.0) return end(std::nullopt);
      zero_allows_it_ = true;
    }
    if (at.value > 0.0 && damping_ >= upper_) return end(std::nullopt);
    (at.value > 0.0 ? low_ : high_) = damping_;
    double next = damping_ - at.value / at.slope;
    if (next <= 0.0 && !zero_allows_it_) {
      next = 0.0;
    } else if (!(next > low_) || !(next < high_)) {
      // Newton left the bracket: from below a root it may overshoot into the flat or captured
      // range.
      next = low_ > 0.0 ? std::min(4.0 * low_, std::sqrt(low_ * high_)) : 0.25 * high_;
      if (high_ == upper_ && next > 0.5 * upper_) next = upper_;
    }
    if (next > 0.0 && std::abs(next - damping_) <= root_tolerance * next) return end(next);
    damping_ = next;
    constexpr int most_steps = 200;
    if (++steps_ == most_steps) end(damping_);
  }

 private:
  void end(std::optional<double> found) {
    found_ = found;
    done_ = true;
  }

  double damping_;
  double low_ = 0.0;
  double high_;
  double upper_;
  bool zero_allows_it_ = false;  // excess(0) >= 0: there is a root above zero
  int steps_ = 0;
  bool done_ = false;
  std::optional<double> found_;
};

/// The iteration on one pair of points, advanced by one impact at a time.
class Iteration {
 public:
  Iteration(const ImpactModel& model, const TwoPoints& points)
      : points_(points),
        upper_hertz_(model.slots[model.slot_C_H[points.dataset]].upper),
        upper_adhesion_(model.slots[model.slot_C_A[points.dataset]].upper),
        beta_low_(beta_at(model, points, points.low.velocity)),
        beta_high_(beta_at(model, points, points.high.velocity)),
        search_(0.0, upper_hertz_) {
    run_.iterations = 1;
  }

  bool done() const { return done_; }
  const TwoPointRun& run() const { return run_; }

  /// The impact whose outcome is wanted next.
  ImpactGroups query() const {
    const double hertz = on_high_ ? search_.damping() : run_.C_H;
    const double adhesion = on_high_ ? run_.C_A : search_.damping();
    return {hertz * point().velocity, on_high_ ? beta_high_ : beta_low_,
            adhesion * point().velocity};
  }

  void answer(const ImpactResult& result) {
    const double target = point().restitution * point().restitution;
    const double slope = point().velocity * result.gradient[on_high_ ? 0 : 2];
    search_.answer(result.usable() ? Excess{result.restitution_squared - target, slope}
                                   : Excess{std::nan(""), 0.0});
    if (!search_.done()) return;
    const std::optional<double> found = search_.found();
    double& damping = on_high_ ? run_.C_H : run_.C_A;
    const double change = std::abs(found.value_or(0.0) - damping);
    damping = found.value_or(0.0);
    const bool moves = change > at_rest * damping;
    if (on_high_) {
      hertz_found_ = found.has_value();
      hertz_moves_ = moves;
      on_high_ = false;
      search_ = DampingSearch(run_.C_A, upper_adhesion_);
      return;
    }
    if (!hertz_moves_ && !moves) {
      run_.status = !hertz_found_        ? TwoPointStatus::no_hertz_damping
                    : !found.has_value() ? TwoPointStatus::no_adhesion_damping
                                         : TwoPointStatus::converged;
      done_ = true;
    } else if (run_.iterations == most_iterations) {
      run_.status = TwoPointStatus::not_converging;
      done_ = true;
    } else {
      ++run_.iterations;
      on_high_ = true;
      search_ = DampingSearch(run_.C_H, upper_hertz_);
    }
  }

 private:
  /// f0 stays at eq. 12 even when the full fit frees it: the iteration knows no third unknown.
  static double beta_at(const ImpactModel& model, const TwoPoints& points, double velocity) {
    std::vector<double> theta = model.initial();
    theta[model.slot_adhesion[points.dataset]] = derived_adhesion(model, points.dataset);
    return impact_groups(conditions_at(model, theta, points.dataset, points.diameter, velocity))
        .beta;
  }

  const Rebound& point() const { return on_high_ ? points_.high : points_.low; }

  TwoPoints points_;
  double upper_hertz_;
  double upper_adhesion_;
  double beta_low_;
  double beta_high_;
  bool on_high_ = true;  // which point is being calibrated
  bool hertz_found_ = false;
  bool hertz_moves_ = false;
  bool done_ = false;
  TwoPointRun run_;
  DampingSearch search_;
};

bool choose_points(const Observations& data, std::size_t dataset, double diameter,
                   TwoPointResult& result) {
  double nearest = 0.0;
  for (const Observation& point : data.points) {
    if (point.dataset != dataset || point.censored) continue;
    if (nearest == 0.0 || std::abs(point.diameter - diameter) < std::abs(nearest - diameter)) {
      nearest = point.diameter;
    }
  }
  result.diameter = nearest;
  std::optional<std::size_t> low;
  std::optional<std::size_t> high;
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const Observation& point = data.points[i];
    if (point.dataset != dataset || point.censored || point.diameter != nearest) continue;
    if (!low || point.velocity < data.points[*low].velocity) low = i;
    if (!high || point.velocity > data.points[*high].velocity) high = i;
  }
  if (!low || *low == *high) return false;
  result.low_point = *low;
  result.high_point = *high;
  return true;
}

}  // namespace

std::vector<TwoPointRun> iterate_two_points(const ImpactModel& model,
                                            std::span<const TwoPoints> pairs) {
  std::vector<Iteration> iterations;
  iterations.reserve(pairs.size());
  for (const TwoPoints& points : pairs) iterations.emplace_back(model, points);
  std::vector<std::size_t> running(pairs.size());
  std::iota(running.begin(), running.end(), std::size_t{0});
  const ImpactOptions options = model.impact_options(true);
  const SimulateImpacts simulate = model.simulator();
  std::vector<ImpactGroups> groups;
  std::vector<ImpactResult> results(pairs.size());
  while (!running.empty()) {
    groups.clear();
    for (const std::size_t i : running) groups.push_back(iterations[i].query());
    simulate(groups, options, std::span(results).first(groups.size()));
    for (std::size_t k = 0; k < running.size(); ++k) iterations[running[k]].answer(results[k]);
    std::erase_if(running, [&](std::size_t i) { return iterations[i].done(); });
  }
  std::vector<TwoPointRun> runs;
  for (const Iteration& iteration : iterations) runs.push_back(iteration.run());
  return runs;
}

std::vector<double> two_point_theta(const ImpactModel& model, std::size_t dataset,
                                    const TwoPointRun& run) {
  std::vector<double> theta = model.initial();
  theta[model.slot_adhesion[dataset]] = derived_adhesion(model, dataset);
  theta[model.slot_C_H[dataset]] = run.C_H;
  theta[model.slot_C_A[dataset]] = run.C_A;
  return theta;
}

TwoPointResult two_point(const ImpactModel& model, const Observations& data, std::size_t dataset,
                         double diameter) {
  TwoPointResult result;
  result.theta = without_mechanisms(model, model.initial());
  if (!choose_points(data, dataset, diameter, result)) return result;
  const Observation& low = data.points[result.low_point];
  const Observation& high = data.points[result.high_point];
  const TwoPoints pair{
      dataset, result.diameter, {low.velocity, low.restitution}, {high.velocity, high.restitution}};
  const TwoPointRun run = iterate_two_points(model, std::span(&pair, 1)).front();
  result.status = run.status;
  result.iterations = run.iterations;
  result.theta = two_point_theta(model, dataset, run);
  return result;
}

}  // namespace recoil
