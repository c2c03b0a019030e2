#include "diagnosis/judge.hpp"

#include <gsl/gsl_cdf.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "core/numerics.hpp"
#include "diagnosis/unstated_errors.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

/// The columns of a refit's Jacobian for the moving slots, scaled to unit length, because the units
/// of the parameters differ by twenty orders of magnitude.
struct MovingColumns {
  std::vector<std::size_t> slots;  ///< [columns]
  Eigen::MatrixXd unit;            ///< [points x columns]
  Eigen::VectorXd length;          ///< [columns]
};

/// Nullopt if no slot moves, or if a moving slot has no effect.
std::optional<MovingColumns> moving_columns(const Refit& refit) {
  const std::size_t slots = refit.theta.size();
  MovingColumns found;
  found.slots = refit.moving_slots();
  if (found.slots.empty()) return std::nullopt;
  const Eigen::Map<const RowMajor> jacobian(
      refit.jacobian.data(), static_cast<Eigen::Index>(refit.jacobian.size() / slots),
      static_cast<Eigen::Index>(slots));
  found.unit = jacobian(Eigen::all, found.slots);
  found.length = found.unit.colwise().norm();
  if (!(found.length.minCoeff() > 0.0)) return std::nullopt;
  found.unit *= found.length.cwiseInverse().asDiagonal();
  return found;
}

constexpr double at_null = 1e-9;  // relative to the usual size of a parameter

/// Is `value` outside the range by at most half of it, or by a factor of two for `log_scale`?
bool is_near(const ParameterSlot& slot, double value, double lower, double upper) {
  if (slot.log_scale) return value >= 0.5 * lower && value <= 2.0 * upper;
  const double half = 0.5 * (upper - lower);
  return value >= lower - half && value <= upper + half;
}

/// `value`, moved towards the range by at most `reach`; for `log_scale` in the logarithm.
double nearest_to_range(const ParameterSlot& slot, double value, double reach, double lower,
                        double upper) {
  if (!(reach > 0.0)) return value;
  const double down = slot.log_scale ? value * std::exp(-reach / value) : value - reach;
  const double up = slot.log_scale ? value * std::exp(reach / value) : value + reach;
  if (value > upper) return std::max(down, upper);
  if (value < lower) return std::min(up, lower);
  return value;
}

/// Sets the plausibility of `parameter`, the one of slot `j`.
void judge_plausibility(const Candidate& candidate, const Refit& refit, std::size_t j, double reach,
                        FoundParameter& parameter) {
  const ParameterSlot& slot = candidate.model.slots[j];
  const AllowedValues allowed = allowed_values(candidate, refit.theta, j);
  const double value = nearest_to_range(slot, parameter.value, reach, allowed.lower, allowed.upper);
  if (value >= allowed.lower && value <= allowed.upper) return;
  const bool by_limit = value > allowed.upper ? allowed.upper_by_limit : allowed.lower_by_limit;
  const PlausibleLimit& limit = slot.parameter->limit;
  parameter.implausible = true;
  parameter.near_plausible =
      !(by_limit && limit.sharp) && is_near(slot, value, allowed.lower, allowed.upper);
  parameter.lower = allowed.lower;
  parameter.upper = allowed.upper;
  parameter.range_why = slot.parameter->plausible.why;
  if (by_limit) {
    parameter.limit = &limit;
    parameter.quantity = allowed.quantity;
  }
}

/// The covariance of the slots [slots x slots]; 0 for those that do not move. Empty if none moves,
/// or if a moving slot has no effect.
Eigen::MatrixXd covariance_of(const Refit& refit) {
  const auto moving = moving_columns(refit);
  if (!moving) return {};
  const Eigen::MatrixXd inverse =
      (moving->unit.transpose() * moving->unit).completeOrthogonalDecomposition().pseudoInverse();
  const Eigen::VectorXd back = moving->length.cwiseInverse();
  const auto slots = static_cast<Eigen::Index>(refit.theta.size());
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(slots, slots);
  covariance(moving->slots, moving->slots) = back.asDiagonal() * inverse * back.asDiagonal();
  return covariance;
}

/// The offset of one series.
struct Offset {
  std::size_t slot = 0;
  std::size_t dataset = 0;
  double log_diameter = 0.0;
};

/// The moving offsets, each with the diameter of its series.
std::vector<Offset> moving_offsets(const Observations& data, const CandidateResult& candidate) {
  const ImpactModel& model = candidate.candidate.model;
  const auto batch = std::ranges::find_if(model.chain, &Mechanism::is_batch);
  if (batch == model.chain.end()) return {};
  const std::size_t first = first_parameter(model, **batch);
  std::map<std::size_t, Offset> found;
  for (const Observation& point : data.points) {
    const std::size_t slot = model.slot_own[first][point.dataset][point.series];
    found[slot] = {slot, point.dataset, std::log(point.diameter)};
  }
  std::vector<Offset> offsets;
  for (const auto& [slot, offset] : found) {
    if (candidate.refit.moving[slot]) offsets.push_back(offset);
  }
  return offsets;
}

/// Is the parameter an error of a drop height, a length [m] that only drop experiments have?
bool is_height(const Parameter& parameter) {
  const Mechanism* const mechanism = parameter.mechanism;
  return mechanism != nullptr && parameter.unit == "m" &&
         mechanism->info.kind == MechanismKind::measurement &&
         mechanism->info.methods == std::vector<Method>{Method::drop_heights};
}

/// Is an added parameter an error of a height that may be due to the rounding of the heights?
bool within_a_step(const SearchBase& base, const CandidateResult& c) {
  const std::vector<double> errors = standard_errors(c.refit, base.noise_scale);
  for (std::size_t j = 0; j < c.refit.theta.size(); ++j) {
    const ParameterSlot& slot = c.candidate.model.slots[j];
    if (!is_height(*slot.parameter) || !c.candidate.adds(slot)) continue;
    const double least = std::abs(c.refit.theta[j]) - allowed_errors * errors[j];
    const double step = height_step(base.datasets);
    if (step > 0.0 && least <= 0.5 * step) return true;
  }
  return false;
}

std::optional<SetAside> reason_against(const SearchBase& base, const CandidateResult& c) {
  if (c.kind == MechanismKind::description) return SetAside::description;
  if (!(c.delta_aicc < 0.0)) return SetAside::gains_too_little;
  if (c.p_value && *c.p_value > base.options.chance) return SetAside::chance;
  if (c.candidate.added.size() == 1 && find_mechanism(c.candidate.added.front())->is_batch() &&
      batch_is_size(base.fitted.data, c, base.noise_scale)) {
    return SetAside::batch_is_size;
  }
  if (!c.plausible) return SetAside::not_possible;
  if (within_a_step(base, c)) return SetAside::within_a_step;
  if (c.remaining_p < tolerated_level) return SetAside::leaves_structure;
  return std::nullopt;
}

}  // namespace

std::vector<double> standard_errors(const Refit& refit, double noise_scale) {
  std::vector<double> errors(refit.theta.size(), 0.0);
  const auto moving = moving_columns(refit);
  if (!moving) return errors;
  const Eigen::MatrixXd& J = moving->unit;
  const Eigen::Index count = J.cols();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(J);
  if (qr.rank() < count) return errors;
  const Eigen::MatrixXd inverse =
      (J.transpose() * J).ldlt().solve(Eigen::MatrixXd::Identity(count, count));
  for (Eigen::Index j = 0; j < count; ++j) {
    errors[moving->slots[static_cast<std::size_t>(j)]] =
        noise_scale * std::sqrt(std::max(inverse(j, j), 0.0)) / moving->length(j);
  }
  return errors;
}

std::vector<FoundParameter> found_parameters(const Candidate& candidate, const Refit& refit,
                                             double noise_scale, double errors) {
  const std::vector<double> sd = standard_errors(refit, noise_scale);
  std::vector<FoundParameter> found;
  for (std::size_t j = 0; j < refit.theta.size(); ++j) {
    const ParameterSlot& slot = candidate.model.slots[j];
    if (!candidate.adds(slot)) continue;
    FoundParameter parameter;
    parameter.label = slot.label();
    parameter.unit = slot.parameter->unit;
    parameter.value = refit.theta[j];
    parameter.sd = sd[j];
    parameter.null_value = slot.parameter->null_value;
    parameter.stated_by = slot.stated;
    const double usual =
        std::max(std::abs(slot.parameter->initial), std::abs(parameter.null_value));
    const bool vanishes = std::abs(parameter.value - parameter.null_value) <= at_null * usual;
    if (slot.free && !vanishes) judge_plausibility(candidate, refit, j, errors * sd[j], parameter);
    found.push_back(std::move(parameter));
  }
  return found;
}

bool series_are_sizes(const Observations& data) {
  std::set<std::pair<std::size_t, std::size_t>> series;
  std::set<std::pair<std::size_t, double>> sizes;
  std::set<std::tuple<std::size_t, std::size_t, double>> both;
  for (const Observation& point : data.points) {
    series.insert({point.dataset, point.series});
    sizes.insert({point.dataset, point.diameter});
    both.insert({point.dataset, point.series, point.diameter});
  }
  return sizes.size() > 1 && series.size() == both.size() && sizes.size() == both.size();
}

bool batch_is_size(const Observations& data, const CandidateResult& candidate, double noise_scale) {
  constexpr double not_by_chance = 0.001;
  constexpr std::size_t terms = 3;  // coefficients of a parabola
  if (!series_are_sizes(data)) return false;
  const std::vector<Offset> offsets = moving_offsets(data, candidate);
  const auto count = static_cast<Eigen::Index>(offsets.size());
  std::map<std::size_t, std::vector<Eigen::Index>> of_dataset;
  std::vector<std::size_t> slots;
  Eigen::VectorXd x(count), o(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Offset& offset = offsets[static_cast<std::size_t>(i)];
    of_dataset[offset.dataset].push_back(i);
    slots.push_back(offset.slot);
    x(i) = offset.log_diameter;
    o(i) = candidate.refit.theta[offset.slot];
  }
  std::vector<Eigen::VectorXd> columns;
  for (const auto& [dataset, own] : of_dataset) {
    Eigen::VectorXd power = Eigen::VectorXd::Zero(count);
    power(own).setOnes();
    for (std::size_t k = 0; k < std::min(terms, own.size()); ++k) {
      columns.push_back(power);
      power.array() *= x.array() - x(own.front());
    }
  }
  if (offsets.size() <= columns.size()) return true;
  const Eigen::MatrixXd all = covariance_of(candidate.refit);
  if (all.size() == 0) return true;
  Eigen::MatrixXd C = noise_scale * noise_scale * all(slots, slots);
  // A lower limit of the variances: combinations of offsets that the base parameters can produce
  // have a singular covariance.
  C.diagonal().array() += 1e-12;
  const Eigen::LLT<Eigen::MatrixXd> root(C);
  if (root.info() != Eigen::Success) return true;
  Eigen::MatrixXd A(count, static_cast<Eigen::Index>(columns.size()));
  for (Eigen::Index k = 0; k < A.cols(); ++k) A.col(k) = columns[static_cast<std::size_t>(k)];
  const Eigen::MatrixXd white = root.matrixL().solve(A);
  const Eigen::VectorXd seen = root.matrixL().solve(o);
  const Eigen::VectorXd rest = seen - white * white.colPivHouseholderQr().solve(seen);
  gsl_errors_are_values();
  return gsl_cdf_chisq_Q(rest.squaredNorm(), static_cast<double>(count - A.cols())) > not_by_chance;
}

void judge(const SearchBase& base, std::vector<CandidateResult>& candidates, double reach,
           const std::vector<Fold>& folds) {
  std::optional<std::vector<FoldPrediction>> base_folds;  // computed when first needed
  const auto predictions_by = [&](const Candidate& candidate, const Refit& refit) {
    return predict_folds(candidate, base.fitted.data, base.fitted.weights, base.laws, folds, refit,
                         base.options.threads);
  };
  for (CandidateResult& c : candidates) {
    if (c.explains()) c.set_aside = reason_against(base, c);
  }
  double best = INFINITY;  // smallest delta_aicc of the explanations so far
  for (CandidateResult& c : candidates) {
    if (!c.explains() || c.delta_aicc > best + reach) continue;
    if (!base_folds) base_folds = predictions_by(base.candidate, base.refit);
    c.gain =
        held_out_gain(folds, *base_folds, predictions_by(c.candidate, c.refit), base.options.seed);
    if (c.gain->decisive && !(c.gain->log_score > 0.0)) {
      c.set_aside = SetAside::predicts_no_better;
    } else {
      best = std::min(best, c.delta_aicc);
    }
  }
}

}  // namespace recoil
