#include "uncertainty/budget.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <utility>

#include "estimate/capture_velocity.hpp"
#include "estimate/impact_problem.hpp"
#include "estimate/misfit.hpp"
#include "estimate/residual.hpp"
#include "estimate/shared_errors.hpp"
#include "uncertainty/refit.hpp"

namespace recoil {
namespace {

// The certified error of e^2, see simulate_impacts_fast.
constexpr double solver_error = 1e-9;
// Below this share of the variance, a constant's effect is not checked for linearity.
constexpr double worth_a_refit = 0.02;
// Relative deviation of a shift from the linear sd up to which an effect counts as linear.
constexpr double linear_within = 0.25;

/// A quantity of a fit: its value and gradient at any theta; nullopt if it has no value.
struct Quantity {
  struct At {
    double value = 0.0;
    std::vector<double> gradient;
  };
  std::function<std::optional<At>(std::span<const double> theta)> at;
};

/// Data that all budgets of a fit share.
class BudgetMaker {
 public:
  explicit BudgetMaker(const FitResult& fitted) : fitted_(fitted) {
    const LeastSquaresProblem problem = impact_problem(fitted.model, fitted.data, fitted.weights);
    const std::size_t p = fitted.theta.size();
    std::vector<double> residuals(problem.residual_count);
    jacobian_.resize(problem.residual_count * p);
    usable_ = !fitted.covariance.empty() && problem.evaluate(fitted.theta, residuals, jacobian_);
    if (!usable_) return;
    covariance_ = fitted.covariance;
    for (std::size_t k = 0; k < fitted.spread_covariance.size(); ++k) {
      covariance_[k] -= fitted.spread_covariance[k];
    }
    add_constant_effects(fitted.constant_effects, covariance_, -1.0);
    scale_ = std::sqrt(scaled_covariance(fitted.data, {1.0}, fitted.noise_scale).front());
    shared_ = std::make_unique<const SharedErrors>(fitted.data, fitted.weights);
    loads_ = loads_of_sources(fitted.data, fitted.weights);
  }

  ErrorBudget operator()(const Quantity& quantity) const {
    ErrorBudget budget;
    if (!usable_) return budget;
    const auto here = quantity.at(fitted_.theta);
    if (!here) return budget;
    budget.value = here->value;
    const std::vector<double>& g = here->gradient;
    const std::size_t p = g.size();
    const std::size_t n = fitted_.data.points.size();
    std::vector<double> reach(p, 0.0);  // C g
    for (std::size_t a = 0; a < p; ++a) {
      for (std::size_t b = 0; b < p; ++b) reach[a] += covariance_[a * p + b] * g[b];
    }
    const auto part = [&](std::size_t row) {
      double sum = 0.0;
      for (std::size_t a = 0; a < p; ++a) sum += reach[a] * jacobian_[row * p + a];
      return sum / scale_;
    };
    add_points(part, budget);
    double spread = 0.0;
    for (std::size_t a = 0; a < p && !fitted_.spread_covariance.empty(); ++a) {
      for (std::size_t b = 0; b < p; ++b) {
        spread += g[a] * fitted_.spread_covariance[a * p + b] * g[b];
      }
    }
    add(budget, {"spread", "the estimated spread of the impacts"}, spread);
    double laws = 0.0;
    for (std::size_t k = 0; k < fitted_.model.constants.size(); ++k) {
      const double own =
          fitted_.constant_effects.empty()
              ? part(n + k)
              : std::inner_product(g.begin(), g.end(), fitted_.constant_effects[k].begin(), 0.0);
      if (k < fitted_.model.material_count()) {
        add(budget, {"", "", k}, own * own);
      } else {
        laws += own * own;
      }
    }
    add(budget, {"laws", "the error of the laws"}, laws);
    double variance = 0.0;
    for (const BudgetEntry& entry : budget.entries) variance += entry.sd * entry.sd;
    budget.sd = std::sqrt(variance);
    if (!budget.available()) return budget;
    for (BudgetEntry& entry : budget.entries) entry.share = entry.sd * entry.sd / variance;
    // Equal shares keep their order, whatever the rounding of sums.
    constexpr double grid = 1e6;
    std::ranges::stable_sort(budget.entries, std::ranges::greater(), [](const BudgetEntry& entry) {
      return std::llround(grid * entry.share);
    });
    for (BudgetEntry& entry : budget.entries) {
      if (!entry.constant) continue;
      if (!budget.sd_without_first_constant) {
        // The variance at a known constant: minus the squared covariance over the constant's
        // variance; if the fit does not move the constant, minus the constant's own part.
        const std::size_t j = fitted_.model.first_constant() + *entry.constant;
        const double given = variance - (fitted_.model.adjusts_constants()
                                             ? reach[j] * reach[j] / covariance_[j * p + j]
                                             : entry.sd * entry.sd);
        budget.sd_without_first_constant = std::sqrt(std::max(0.0, given));
      }
      if (entry.share >= worth_a_refit) move(quantity, entry, budget);
    }
    return budget;
  }

 private:
  void add(ErrorBudget& budget, BudgetEntry entry, double square) const {
    if (!(square > 0.0)) return;
    entry.sd = std::sqrt(square);
    budget.entries.push_back(entry);
  }

  /// Adds the parts of the points' errors. With a the parts of the whitened residuals and W the
  /// whitening, sum a^2 = b'(D + U U')b, b = W a (SharedErrors): one term for the scatter of each
  /// point, of which the errors of its own V and d are a share, and one for every shared draw.
  template <class Part>
  void add_points(const Part& part, ErrorBudget& budget) const {
    const Observations& data = fitted_.data;
    const std::size_t n = data.points.size();
    std::vector<double> b(n);
    for (std::size_t i = 0; i < n; ++i) b[i] = part(i);
    shared_->whiten(b);
    double scatter = 0.0, numerics = 0.0;
    std::vector<double> of_source(data.sources.size(), 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      const PointWeights& own = fitted_.weights.points[i];
      const double slope =
          weighted_residual(data.points[i], own, fitted_.prediction_squared[i], data.noise.student)
              .slope;
      numerics += std::pow(b[i] * slope * solver_error / scale_, 2);
      double rest = has_own_scatter(data, i) ? b[i] * b[i] : 0.0;
      for (std::size_t k = 0; k < of_source.size() && rest > 0.0; ++k) {
        if (data.sources[k]->shared != SharedBy::none) continue;
        const double share = std::pow(fitted_.weights.effects[k][i] * slope, 2);
        const double square = std::min(rest, b[i] * b[i] * share);
        of_source[k] += square;
        rest -= square;
      }
      scatter += rest;
    }
    for (std::size_t k = 0; k < of_source.size(); ++k) {
      const ErrorSource& source = *data.sources[k];
      std::map<std::uint64_t, double> draws;
      for (std::size_t i = 0; i < n; ++i) {
        const double load = source.is_scatter() ? 1.0 : loads_[k][i];
        for (const ErrorPart& one : source.parts(data.points[i])) {
          draws[one.draw] += b[i] * load * one.factor;
        }
      }
      for (const auto& [draw, sum] : draws) {
        (source.is_scatter() ? scatter : of_source[k]) += sum * sum;
      }
    }
    add(budget, {"scatter", "scatter of the points"}, scatter);
    for (std::size_t k = 0; k < of_source.size(); ++k) {
      add(budget, {data.sources[k]->names.id, data.sources[k]->names.words}, of_source[k]);
    }
    add(budget, {"numerics", "numerics"}, numerics);
  }

  /// Sets the shift of the quantity when the constant is one standard deviation lower or higher.
  void move(const Quantity& quantity, BudgetEntry& entry, ErrorBudget& budget) const {
    for (const double by : {-1.0, 1.0}) {
      const auto theta = estimate_with_constant_moved(fitted_, *entry.constant, by);
      if (!theta) return;
      const auto there = quantity.at(*theta);
      if (!there) return;
      (by < 0.0 ? entry.lower : entry.upper) = there->value - budget.value;
    }
    const double low = std::abs(*entry.lower);
    const double high = std::abs(*entry.upper);
    const bool opposite = *entry.lower * *entry.upper < 0.0;
    if (!opposite || std::abs(low - entry.sd) > linear_within * entry.sd ||
        std::abs(high - entry.sd) > linear_within * entry.sd) {
      budget.linear = false;
    }
  }

  const FitResult& fitted_;
  bool usable_ = false;
  double scale_ = 1.0;
  std::vector<double> jacobian_, covariance_;
  std::unique_ptr<const SharedErrors> shared_;
  std::vector<std::vector<double>> loads_;
};

Quantity slot_quantity(std::size_t slot) {
  return {[slot](std::span<const double> theta) -> std::optional<Quantity::At> {
    std::vector<double> gradient(theta.size(), 0.0);
    gradient[slot] = 1.0;
    return Quantity::At{theta[slot], std::move(gradient)};
  }};
}

/// f0 or W of a dataset whose adhesion changes with its material constants.
Quantity adhesion_quantity(const ImpactModel& model, std::size_t dataset) {
  return {[&model, dataset](std::span<const double> theta) -> std::optional<Quantity::At> {
    Quantity::At at{adhesion_value_under(model, theta, dataset),
                    std::vector<double>(theta.size(), 0.0)};
    for (const MaterialSlope& slope : material_slopes(model, theta, dataset)) {
      const bool ring = traits(model.adhesion).by_force;
      at.gradient[model.first_constant() + slope.index] =
          at.value * (ring ? slope.adhesion_force : slope.adhesion_energy);
    }
    return at;
  }};
}

Quantity capture_quantity(const ImpactModel& model, const CaptureEstimate& estimate) {
  return {[&model, &estimate](std::span<const double> theta) -> std::optional<Quantity::At> {
    CaptureVelocity found =
        capture_velocity(model, theta, estimate.dataset, estimate.diameter, estimate.value);
    if (!found.found || !(found.value > 0.0)) return std::nullopt;
    return Quantity::At{found.value, std::move(found.gradient)};
  }};
}

}  // namespace

std::vector<ErrorBudget> parameter_budgets(const FitResult& fitted) {
  const BudgetMaker make(fitted);
  const ImpactModel& model = fitted.model;
  std::vector<ErrorBudget> budgets(model.slots.size());
  for (std::size_t j = 0; j < budgets.size(); ++j) {
    if (model.slots[j].free) budgets[j] = make(slot_quantity(j));
  }
  for (std::size_t d = 0; d < model.contacts.size() && !model.constants.empty(); ++d) {
    if (!follows_materials(model, d)) continue;
    budgets[model.slot_adhesion[d]] = make(adhesion_quantity(model, d));
  }
  return budgets;
}

std::vector<ErrorBudget> capture_budgets(const FitResult& fitted,
                                         const std::vector<CaptureEstimate>& capture) {
  const BudgetMaker make(fitted);
  std::vector<ErrorBudget> budgets;
  for (const CaptureEstimate& estimate : capture) {
    budgets.push_back(estimate.found && estimate.value > 0.0
                          ? make(capture_quantity(fitted.model, estimate))
                          : ErrorBudget{});
  }
  return budgets;
}

}  // namespace recoil
