#include "diagnosis/candidate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "diagnosis/discrepancy.hpp"
#include "estimate/impact_problem.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

constexpr double equal_deviances = 1e-6;  // a smaller difference is rounding

/// The options for descents from several starts, of which the best is followed to its minimum. (A
/// tolerance of the parameters would compare steps of very different units.)
LeastSquaresOptions descent() {
  LeastSquaresOptions options;
  options.max_iterations = 100;
  options.function_tolerance = 1e-4;
  options.gradient_tolerance = 1e-10;
  options.parameter_tolerance = 1e-10;
  options.finish = false;
  options.strategies = {Strategy::box_descent};
  options.first_radius = 10.0;
  return options;
}

/// The options from the end of the best descent to its minimum: the parameters there are within
/// 1e-7 of their errors, so that nothing shown depends on the start or on the rounding of a sum.
LeastSquaresOptions last_descent() {
  LeastSquaresOptions options = descent();
  options.function_tolerance = 1e-15;
  options.close_enough = 1e-7;
  options.first_radius = 1e4;
  return options;
}

/// The options for the residuals of a simulated data set, which are only compared with others: the
/// parameters are within a thousandth of their errors.
LeastSquaresOptions sample_descent() {
  LeastSquaresOptions options = last_descent();
  options.close_enough = 1e-3;
  return options;
}

/// The options if `descent` does not converge: the trust region of Ceres.
LeastSquaresOptions careful_descent() {
  LeastSquaresOptions options = descent();
  options.strategies = {Strategy::trust_region};
  options.max_iterations = 500;
  return options;
}

/// Is a deviance lower than `other` by more than rounding?
bool clearly_lower(double deviance, double other) {
  return deviance < other - equal_deviances * std::max(1.0, other);
}

/// Do `residuals` differ from those of a fit by so little that no point could tell them apart? By
/// at most a fifth of a standard error of the fit, over all points.
bool same_fit(std::span<const double> residuals, const LeastSquaresResult& fit,
              double times = 1.0) {
  constexpr double negligible = 0.04;
  double distance = 0.0;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    distance += std::pow(residuals[i] - fit.residuals[i], 2);
  }
  const auto n = static_cast<double>(residuals.size());
  return distance <= times * negligible * fit.sum_of_squares / n;
}

/// `weights` for comparisons of models, under the stated errors of the points and of the constants.
Weights comparing(Weights weights) {
  weights.noise.constants_weight = 1.0;
  return weights;
}

/// The ends of the descents from `starts`. A descent that comes near the end of an earlier one, and
/// whose next step leads to it, is broken off.
std::vector<LeastSquaresResult> ends_of_descents(const LeastSquaresProblem& problem,
                                                 const std::vector<std::vector<double>>& starts,
                                                 LeastSquaresOptions options) {
  constexpr double near = 250.0;
  std::vector<LeastSquaresResult> ends;
  bool known = false;
  options.stop = [&](std::span<const double> now, std::span<const double> after) {
    known = std::ranges::any_of(ends, [&](const LeastSquaresResult& end) {
      return same_fit(now, end, near) && same_fit(after, end);
    });
    return known;
  };
  for (const std::vector<double>& start : starts) {
    known = false;
    LeastSquaresResult run = minimise(problem, start, options);
    if (known) continue;
    if (!run.ended() && std::isfinite(run.sum_of_squares)) {
      run = minimise(problem, run.theta, careful_descent());
    }
    if (run.ended() && std::isfinite(run.sum_of_squares)) ends.push_back(std::move(run));
  }
  return ends;
}

/// The lowest end of the descents from `starts`, followed to its minimum unless it is `rough`.
/// Other fits that are close to the lowest are followed, too: their minima may be lower.
LeastSquaresResult best_descent(const LeastSquaresProblem& problem,
                                const std::vector<std::vector<double>>& starts, bool rough) {
  constexpr std::size_t most_followed = 3;
  constexpr double known_to = 1e-3;  // relative; the deviance at the end of a rough descent
  const bool twice = !rough && starts.size() > 1;
  std::vector<LeastSquaresResult> runs =
      ends_of_descents(problem, starts, rough || twice ? descent() : last_descent());
  if (runs.empty()) return {};
  std::ranges::stable_sort(runs, {}, &LeastSquaresResult::sum_of_squares);
  if (!twice) return std::move(runs.front());
  const double close = runs.front().sum_of_squares * (1.0 + known_to);
  LeastSquaresResult best;
  std::vector<LeastSquaresResult> followed;
  for (LeastSquaresResult& run : runs) {
    if (followed.size() == most_followed || run.sum_of_squares > close) break;
    if (std::ranges::any_of(followed, [&](const auto& f) { return same_fit(run.residuals, f); })) {
      continue;
    }
    LeastSquaresResult last = minimise(problem, run.theta, last_descent());
    followed.push_back(run);
    if (!last.ended() || last.sum_of_squares > run.sum_of_squares) last = std::move(run);
    if (!best.ended() || clearly_lower(last.sum_of_squares, best.sum_of_squares)) {
      best = std::move(last);
    }
  }
  return best;
}

/// `near`, and copies of it with one parameter of an added mechanism at a start of the catalogue.
std::vector<std::vector<double>> advised_starts(const Candidate& candidate,
                                                const std::vector<double>& near) {
  std::vector<std::vector<double>> starts = {near};
  for (std::size_t j = 0; j < near.size(); ++j) {
    const ParameterSlot& slot = candidate.model.slots[j];
    if (!slot.free || !candidate.adds(slot)) continue;
    std::vector<double> values = slot.parameter->starts;
    values.push_back(slot.initial);
    for (const double value : values) {
      if (value == near[j] || value < slot.lower || value > slot.upper) continue;
      starts.push_back(near);
      starts.back()[j] = value;
    }
  }
  return starts;
}

/// `near` with a tenth of the damping of the base model: another loss may replace it.
std::vector<double> hardly_damped(const Candidate& candidate, std::vector<double> near) {
  for (std::size_t j = 0; j < near.size(); ++j) {
    const ParameterSlot& slot = candidate.model.slots[j];
    if (!slot.free || !slot.parameter->is_damping()) continue;
    near[j] = std::clamp(0.1 * near[j], slot.lower, slot.upper);
  }
  return near;
}

/// The `most` of `starts` with the smallest deviance.
std::vector<std::vector<double>> best_starts(const LeastSquaresProblem& problem,
                                             std::vector<std::vector<double>> starts,
                                             std::size_t most) {
  if (starts.size() <= most) return starts;
  std::vector<double> residuals(problem.residual_count);
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    if (!problem.evaluate(starts[k], residuals, {})) continue;
    order.emplace_back(
        std::inner_product(residuals.begin(), residuals.end(), residuals.begin(), 0.0), k);
  }
  std::ranges::sort(order);
  std::vector<std::vector<double>> best;
  for (const auto& [deviance, k] : order) {
    if (best.size() < most) best.push_back(std::move(starts[k]));
  }
  return best;
}

/// If the added mechanism does not lower the deviance, its parameters may have any of many values.
/// Then they get those at which it vanishes.
void take_null_values(const LeastSquaresProblem& problem, const Candidate& candidate,
                      LeastSquaresResult& best) {
  LeastSquaresResult without = best;
  for (std::size_t j = 0; j < without.theta.size(); ++j) {
    const ParameterSlot& slot = candidate.model.slots[j];
    if (!slot.free || !candidate.adds(slot)) continue;
    without.theta[j] = std::clamp(slot.parameter->null_value, slot.lower, slot.upper);
    without.at_bound[j] = true;
  }
  if (without.theta == best.theta) return;
  if (!problem.evaluate(without.theta, without.residuals, without.jacobian)) return;
  without.sum_of_squares = std::inner_product(without.residuals.begin(), without.residuals.end(),
                                              without.residuals.begin(), 0.0);
  if (!clearly_lower(best.sum_of_squares, without.sum_of_squares)) best = std::move(without);
}

/// Narrows the bounds of a mechanism's parameter to its allowed range plus 20 % of its width on
/// either side (in the logarithm for `log_scale`), as an estimate scatters about a true value at
/// the limit.
void keep_possible(ParameterSpec& spec, const AllowedValues& allowed) {
  const Parameter& parameter = *spec.parameter;
  const double upper = allowed.upper;
  // If the lower limit is a limit on a quantity, and the null value lies below it, the null value
  // remains reachable.
  const bool open = allowed.lower_by_limit && parameter.null_value <= allowed.lower;
  const double lower =
      open ? std::max(parameter.plausible.lower, parameter.null_value) : allowed.lower;
  if (!(upper > lower)) return;  // no value is allowed; the judgement reports it
  if (parameter.log_scale) {
    const double beyond = std::pow(upper / lower, 0.2);
    spec.lower = std::max(spec.lower, lower / beyond);
    spec.upper = std::min(spec.upper, upper * beyond);
  } else {
    const double beyond = 0.2 * (upper - lower);
    spec.lower = std::max(spec.lower, lower == parameter.null_value ? lower : lower - beyond);
    spec.upper = std::min(spec.upper, upper + beyond);
  }
  spec.initial = std::clamp(spec.initial, spec.lower, spec.upper);
}

/// Relative scatter of single impacts among the slowest rebounds [1], from the stated sd sqrt(n) /
/// e: the root mean square over the slowest 5 %, at least three. Nullopt if fewer points state it.
/// It decides which rebounds are too slow to be detected.
std::optional<double> scatter_of_slow_rebounds(const std::vector<Dataset>& datasets) {
  constexpr std::size_t fewest = 3;
  std::vector<std::pair<double, double>> stated;  // rebound velocity, square of the scatter
  for (const Dataset& dataset : datasets) {
    for (const ImpactPoint& point : dataset.points) {
      if (!point.restitution_sd || !(point.restitution > 0.0)) continue;
      const double relative = *point.restitution_sd / point.restitution;
      stated.emplace_back(point.restitution * point.incident_velocity,
                          relative * relative * (point.events - point.captured));
    }
  }
  if (stated.size() < fewest) return {};
  std::ranges::sort(stated);
  stated.resize(std::max(fewest, stated.size() / 20));
  double sum = 0.0;
  for (const auto& [velocity, square] : stated) sum += square;
  return std::sqrt(sum / static_cast<double>(stated.size()));
}

}  // namespace

std::shared_ptr<const Discrepancy> nothing_shared() {
  static const auto nothing = std::make_shared<const Discrepancy>();
  return nothing;
}

std::vector<std::size_t> Refit::moving_slots() const {
  std::vector<std::size_t> slots;
  for (std::size_t j = 0; j < moving.size(); ++j) {
    if (moving[j]) slots.push_back(j);
  }
  return slots;
}

bool Candidate::adds(const std::string& id) const {
  return std::ranges::find(added, id) != added.end();
}

bool Candidate::adds(const ParameterSlot& slot) const {
  return slot.mechanism() != nullptr && adds(std::string(slot.mechanism()->info.id));
}

std::string Candidate::name() const { return fmt::format("{}", fmt::join(added, " + ")); }

std::size_t first_parameter(const ImpactModel& model, const Mechanism& mechanism) {
  std::size_t first = 0;
  for (const Mechanism* before : model.chain) {
    if (before == &mechanism) break;
    first += before->info.parameters.size();
  }
  return first;
}

std::vector<const Mechanism*> mechanisms_that_may_act(const FitSpec& spec,
                                                      const ImpactModel& model) {
  std::vector<const Mechanism*> possible;
  for (const Mechanism& mechanism : mechanism_catalogue()) {
    const auto& own = spec.mechanisms;
    const bool is_new = std::ranges::find(own, mechanism.info.id) == own.end();
    // If the sizes are stated, a mechanism for mixed sizes has nothing to explain.
    const bool acts = std::ranges::any_of(model.surroundings, [&](const Surroundings& at) {
      return mechanism.is_possible_at(at) && !(mechanism.info.mixes_sizes && at.sizes.mixed());
    });
    if (is_new && acts && mechanism.works_with(spec.adhesion) &&
        rival_among(own, mechanism.info.id) == nullptr) {
      possible.push_back(&mechanism);
    }
  }
  return possible;
}

const ParameterSlot& strength_at(const ImpactModel& model, const Mechanism& mechanism,
                                 const PointConditions& at) {
  const Parameter& strength = mechanism.info.parameters.front();
  return model.slots[*own_slot(model, first_parameter(model, mechanism), strength, at)];
}

bool is_taken_away(const ImpactModel& model, const Mechanism& mechanism,
                   const PointConditions& at) {
  if (mechanism.info.parameters.front().stated_by.empty()) return false;
  const ParameterSlot& strength = strength_at(model, mechanism, at);
  return strength.stated && strength.initial == strength.parameter->null_value;
}

AllowedValues allowed_values(const Candidate& candidate, std::span<const double> theta,
                             std::size_t j) {
  const ImpactModel& model = candidate.model;
  const Parameter& parameter = *model.slots[j].parameter;
  const std::vector<Parameter>& parameters = parameter.mechanism->info.parameters;
  const std::size_t first = first_parameter(model, *parameter.mechanism);
  const auto k = static_cast<std::size_t>(&parameter - parameters.data());
  std::vector<double> own;
  std::vector<Encounter<double>> spheres;
  for (const PointConditions& at : candidate.impacts) {
    const std::vector<std::size_t>& slots = model.slot_own[first + k][at.dataset];
    if (std::ranges::find(slots, j) == slots.end()) continue;
    if (own.empty()) {
      for (std::size_t i = 0; i < parameters.size(); ++i) {
        const auto slot = own_slot(model, first + i, parameters[i], at);
        own.push_back(slot ? theta[*slot] : parameters[i].null_value);
      }
    }
    spheres.push_back(
        plain_sphere(model.surroundings[at.dataset], at.diameter, at.velocity, at.series));
  }
  return allowed_values(parameter, k, own, spheres);
}

Candidate make_candidate(const FitSpec& spec, const std::vector<Dataset>& datasets,
                         const std::vector<std::string>& added, bool release, bool possible) {
  Candidate candidate;
  candidate.released = release;
  candidate.spec = spec;
  for (const Mechanism* mechanism : chain_of(added)) {
    candidate.added.emplace_back(mechanism->info.id);
    candidate.spec.mechanisms.emplace_back(mechanism->info.id);
  }
  candidate.spec.parameters.clear();
  for (const Parameter* parameter : parameters_with(candidate.spec.mechanisms, spec.adhesion)) {
    ParameterSpec stated = spec.statement_of(*parameter);
    const auto& before = spec.mechanisms;
    const bool is_new = parameter->mechanism != nullptr &&
                        std::ranges::find(before, parameter->mechanism->info.id) == before.end();
    if (is_new) {
      stated.free = stated.free || (release && stated.parameter->searched);
      const std::optional<double> scatter =
          parameter->is_scatter_of_rebounds ? scatter_of_slow_rebounds(datasets) : std::nullopt;
      if (scatter) stated.initial = std::clamp(*scatter, stated.lower, stated.upper);
    }
    candidate.spec.parameters.push_back(stated);
  }
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    for (const ImpactPoint& point : datasets[d].points) {
      candidate.impacts.push_back({d, point.diameter, point.incident_velocity, point.series});
    }
  }
  candidate.model = make_model(candidate.spec, datasets);
  if (possible) {
    const std::vector<double> initial = candidate.model.initial();
    for (std::size_t j = 0; j < initial.size(); ++j) {
      const ParameterSlot& slot = candidate.model.slots[j];
      if (!slot.free || !candidate.adds(slot)) continue;
      for (ParameterSpec& stated : candidate.spec.parameters) {
        if (stated.parameter != slot.parameter) continue;
        keep_possible(stated, allowed_values(candidate, initial, j));
      }
    }
    candidate.model = make_model(candidate.spec, datasets);
  }
  candidate.free_count = candidate.model.free_count();
  return candidate;
}

std::vector<double> carried_over(const ImpactModel& model, std::span<const double> theta,
                                 const ImpactModel& to) {
  std::map<std::string, double> values;
  for (std::size_t j = 0; j < theta.size(); ++j) values[model.slots[j].label()] = theta[j];
  std::vector<double> carried = to.initial();
  for (std::size_t j = 0; j < carried.size(); ++j) {
    const auto found = values.find(to.slots[j].label());
    if (found != values.end() && to.slots[j].moves()) carried[j] = found->second;
  }
  return carried;
}

std::optional<std::vector<double>> residuals_of_refit(const Candidate& candidate,
                                                      const WeightedData& sample,
                                                      std::span<const double> near,
                                                      const Discrepancy& discrepancy) {
  const Weights weights = comparing(sample.weights);
  const LeastSquaresProblem problem =
      whitened(impact_problem(candidate.model, sample.data, weights), discrepancy);
  std::vector<LeastSquaresResult> ends =
      ends_of_descents(problem, {{near.begin(), near.end()}}, sample_descent());
  if (ends.empty()) return std::nullopt;
  ends.front().residuals.resize(sample.data.points.size());
  return std::move(ends.front().residuals);
}

Refit refit_candidate(const Candidate& candidate, const Observations& data, const Weights& weights,
                      std::span<const double> near, int tries,
                      std::shared_ptr<const Discrepancy> discrepancy) {
  const Weights stated = comparing(weights);
  const LeastSquaresProblem problem =
      whitened(impact_problem(candidate.model, data, stated), *discrepancy);
  const std::vector<double> first(near.begin(), near.end());
  const auto most = static_cast<std::size_t>(tries);
  std::vector<std::vector<double>> starts = {first};
  if (tries > 0) starts = best_starts(problem, advised_starts(candidate, first), most);
  if (tries > 1) {
    for (std::vector<double>& start :
         best_starts(problem, advised_starts(candidate, hardly_damped(candidate, first)), most)) {
      starts.push_back(std::move(start));
    }
  }
  const bool rough = candidate.added.size() > 1;
  LeastSquaresResult best = best_descent(problem, starts, rough);
  Refit refit;
  refit.discrepancy = std::move(discrepancy);
  if (!best.ended() || !std::isfinite(best.sum_of_squares)) return refit;
  if (tries > 0 && !rough) take_null_values(problem, candidate, best);
  refit.usable = true;
  refit.theta = std::move(best.theta);
  refit.chi2 = best.sum_of_squares;
  refit.residuals = std::move(best.residuals);
  refit.residuals.resize(data.points.size());
  refit.jacobian = std::move(best.jacobian);
  refit.moving.assign(refit.theta.size(), false);
  for (std::size_t j = 0; j < refit.theta.size(); ++j) {
    refit.moving[j] = candidate.model.slots[j].free && !best.at_bound[j];
  }
  // A material constant counts as moving if the points determine it better than its stated value
  // does.
  const std::size_t p = refit.theta.size();
  for (std::size_t k = 0; k < candidate.model.constants.size(); ++k) {
    const std::size_t j = candidate.model.first_constant() + k;
    double information = 0.0;
    for (std::size_t i = 0; i < data.points.size(); ++i) {
      information += refit.jacobian[i * p + j] * refit.jacobian[i * p + j];
    }
    const double stated_alone = refit.jacobian[(data.points.size() + k) * p + j];
    refit.moving[j] = information > stated_alone * stated_alone && !best.at_bound[j];
  }
  return refit;
}

double corrected_criterion(const Observations& data, double chi2, int free_count) {
  const auto n = static_cast<double>(data.points.size());
  const double k = free_count + (data.noise.sd_stated ? 0 : 1);
  const double spare = n - k - 1.0;
  if (spare <= 0.0) return INFINITY;
  const double deviance = data.noise.sd_stated ? chi2 : n * std::log(std::max(chi2, 1e-300) / n);
  return deviance + 2.0 * k + 2.0 * k * (k + 1.0) / spare;
}

double corrected_criterion(const Observations& data, const Refit& refit, int free_count) {
  return corrected_criterion(data, refit.chi2, free_count) + refit.discrepancy->log_determinant();
}

}  // namespace recoil
