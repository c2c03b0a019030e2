#include "diagnosis/plausibility.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "diagnosis/moving_columns.hpp"

namespace recoil {
namespace {

constexpr double at_null = 1e-9;  // of the range of a parameter

/// Beyond the range by no more than half of it, or a factor of two.
bool is_near(const ParameterSlot& slot, double value, double lower, double upper) {
  if (slot.log_scale) return value >= 0.5 * lower && value <= 2.0 * upper;
  const double half = 0.5 * (upper - lower);
  return value >= lower - half && value <= upper + half;
}

/// `value` by `reach` towards the range; for a logarithmic slot in ln.
double nearest_to_range(const ParameterSlot& slot, double value, double reach, double lower,
                        double upper) {
  if (!(reach > 0.0)) return value;
  const double down = slot.log_scale ? value * std::exp(-reach / value) : value - reach;
  const double up = slot.log_scale ? value * std::exp(reach / value) : value + reach;
  if (value > upper) return std::max(down, upper);
  if (value < lower) return std::min(up, lower);
  return value;
}

/// Sets what of `parameter`, the one of slot `j`, is impossible.
void judge(const Candidate& candidate, const Refit& refit, std::size_t j, double reach,
           FoundParameter& parameter) {
  const ParameterSlot& slot = candidate.model.slots[j];
  const AllowedValues allowed = allowed_values(candidate, refit.theta, j);
  const double value = nearest_to_range(slot, parameter.value, reach, allowed.lower, allowed.upper);
  if (value >= allowed.lower && value <= allowed.upper) return;
  const bool by_limit = value > allowed.upper ? allowed.upper_by_limit : allowed.lower_by_limit;
  const PlausibleLimit& limit = slot.parameter->limit;
  parameter.implausible = by_limit ? Implausible::beyond_limit : Implausible::outside_range;
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
    const bool vanishes = std::abs(parameter.value - slot.parameter->null_value) <=
                          at_null * (slot.upper - slot.lower);
    if (slot.free && !vanishes) judge(candidate, refit, j, errors * sd[j], parameter);
    found.push_back(std::move(parameter));
  }
  return found;
}

}  // namespace recoil
