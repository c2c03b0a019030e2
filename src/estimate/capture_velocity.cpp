#include "estimate/capture_velocity.hpp"

#include <algorithm>
#include <cmath>

#include "estimate/predictor.hpp"

namespace recoil {
namespace {

/// V*^2 [m2/s2] to first order in the dampings: the start of the search.
double weakly_damped_square(const ImpactModel& model, const ImpactConditions& c) {
  return traits(model.adhesion)
      .capture_square(c.hertz_damping, c.adhesion_damping,
                      model.phase == AdhesionDampingPhase::both, adhesion_velocity(c));
}

/// The search for one capture velocity, one evaluation of e^2 at a time.
///
/// Newton's method on e^2 V^2 as a function of V^2. It is nearly a straight line of slope 1 for
/// weak damping, because the energy loss hardly depends on V near capture. Bisection where a Newton
/// step leaves the bracket.
class CaptureSearch {
 public:
  CaptureSearch(const ImpactModel& model, std::span<const double> theta, const CaptureQuery& query)
      : query_(query) {
    result_.gradient.assign(model.slots.size(), 0.0);
    const ImpactConditions c = conditions_at(model, theta, query.dataset, query.diameter, 1.0);
    scale_ = adhesion_velocity(c);
    extended_ = !model.chain.empty();
    if (extended_) {
      // Mechanisms may capture spheres that rebound in the base model.
      if (!(scale_ > 0.0)) scale_ = 1.0;
    }
    const bool no_loss =
        !traits(model.adhesion).jumps && c.hertz_damping == 0.0 && c.adhesion_damping == 0.0;
    if (without_adhesion(model, query.dataset) || (!extended_ && (!(scale_ > 0.0) || no_loss))) {
      result_.found = true;  // every sphere rebounds
      done_ = true;
      return;
    }
    square_ = query.guess > 0.0 ? query.guess * query.guess : weakly_damped_square(model, c);
    if (extended_ && !(square_ > lowest * scale_ * scale_)) square_ = scale_ * scale_;
    rebounds_ = 1e6 * scale_ * scale_;
  }

  bool done() const { return done_; }
  PointConditions next() const { return {query_.dataset, query_.diameter, std::sqrt(square_)}; }
  const CaptureVelocity& result() const { return result_; }

  /// Updates the bracket with point `i`, evaluated at next().
  void update(const PointPredictor& predictor, std::size_t i) {
    const ImpactResult& impact = predictor.at(i);
    done_ = !impact.usable() || ++iterations_ == most_iterations;
    if (!impact.usable()) return;
    const double velocity = std::sqrt(square_);
    const double per_velocity = predictor.velocity_slope(i);
    const double excess = impact.restitution_squared * square_;
    const double slope = impact.restitution_squared + 0.5 * velocity * per_velocity;
    (excess > 0.0 ? rebounds_ : captured_) = square_;
    rebound_seen_ = rebound_seen_ || excess > 0.0;
    double next = square_ - excess / slope;
    if (!(slope > 0.0) || !(next > captured_) || !(next < rebounds_)) {
      next = rebound_seen_ ? std::sqrt(std::max(captured_, 1e-4 * rebounds_) * rebounds_)
                           : 4.0 * square_;
      if (!rebound_seen_ && next > 1e6 * scale_ * scale_) {  // nothing rebounds
        done_ = true;
        return;
      }
    }
    if (extended_ && rebound_seen_ && captured_ == 0.0 && next < lowest * scale_ * scale_) {
      result_.found = true;  // every sphere rebounds
      done_ = true;
      return;
    }
    if (std::abs(next - square_) <= convergence * square_) {
      done_ = true;
      result_.found = true;
      result_.value = std::sqrt(next);
      // Differentiate e^2(V*, theta) = 0.
      predictor.gradient_row(i, -1.0 / per_velocity, result_.gradient);
    }
    square_ = next;
  }

 private:
  static constexpr int most_iterations = 60;
  static constexpr double convergence = 2e-9;  // of V^2
  // V^2 / V_a^2 below which a sphere counts as at rest: the error of e^2, 1e-10 of the depth of the
  // well, is 1 % here.
  static constexpr double lowest = 1e-8;

  CaptureQuery query_;
  CaptureVelocity result_;
  double scale_ = 0.0;     // V_a
  double square_ = 0.0;    // V^2 to try next
  double captured_ = 0.0;  // largest V^2 seen that is captured
  double rebounds_ = 0.0;  // smallest V^2 seen that rebounds
  bool rebound_seen_ = false;
  bool extended_ = false;  // true: mechanisms act
  bool done_ = false;
  int iterations_ = 0;
};

}  // namespace

double weakly_damped_capture(const ImpactModel& model, std::span<const double> theta,
                             std::size_t dataset, double diameter) {
  const double square =
      weakly_damped_square(model, conditions_at(model, theta, dataset, diameter, 1.0));
  return std::sqrt(std::max(0.0, square));
}

std::vector<CaptureVelocity> capture_velocities(const ImpactModel& model,
                                                std::span<const double> theta,
                                                std::span<const CaptureQuery> queries) {
  std::vector<CaptureSearch> searches;
  for (const CaptureQuery& query : queries) searches.emplace_back(model, theta, query);
  for (;;) {
    std::vector<std::size_t> open;
    std::vector<PointConditions> points;
    for (std::size_t i = 0; i < searches.size(); ++i) {
      if (searches[i].done()) continue;
      open.push_back(i);
      points.push_back(searches[i].next());
    }
    if (open.empty()) break;
    PointPredictor predictor(model, std::move(points), Effects::of_nature);
    predictor.evaluate(theta, true);
    for (std::size_t k = 0; k < open.size(); ++k) searches[open[k]].update(predictor, k);
  }
  std::vector<CaptureVelocity> results;
  for (const CaptureSearch& search : searches) results.push_back(search.result());
  return results;
}

CaptureVelocity capture_velocity(const ImpactModel& model, std::span<const double> theta,
                                 std::size_t dataset, double diameter, double guess) {
  const CaptureQuery query{dataset, diameter, guess};
  return capture_velocities(model, theta, {&query, 1}).front();
}

}  // namespace recoil
