#include "plan/possible_points.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_sf_erf.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/numerics.hpp"
#include "core/units.hpp"
#include "estimate/predictor.hpp"
#include "estimate/residual.hpp"

namespace recoil {
namespace {

// e^2 over its scatter up to which counts matter, see `reweighted_fit`.
constexpr double near_capture = 30.0;
constexpr double far_out = 35.0;  // standard deviations beyond which phi is 0

/// phi^2 / (Phi(z) Phi(-z)): the information of one capture or rebound about z.
double information_of_a_count(double z) {
  if (std::abs(z) > far_out) return 0.0;
  return gsl_sf_hazard(z) * gsl_sf_hazard(-z);
}

/// The information about z of a normal deviate of mean z that is censored at 0.
double information_of_censored(double z) {
  if (z > far_out) return 1.0;
  if (z < -far_out) return 0.0;
  const double density = gsl_ran_ugaussian_pdf(z);
  return gsl_cdf_ugaussian_P(z) - z * density + density * gsl_sf_hazard(z);
}

PointOutlook where_some_are_captured(double m, double s, double tau, const PlannedScatter& by) {
  const double n = by.events;
  const double shared = s * s + tau * tau;
  const double weight = (1.0 + (n - 1.0) * s * s / shared) / n;
  PointOutlook found;
  found.information = weight * n * information_of_a_count(m / std::sqrt(shared)) / shared;
  const double u = m / s;
  const double rebounds = n * gsl_cdf_ugaussian_P(u);
  found.captured = gsl_cdf_ugaussian_Q(u);
  const RootMoments root = root_of_positive_normal(u);
  found.restitution = std::sqrt(s) * root.mean;
  const double own = std::hypot(by.scatter * found.restitution, by.floor);
  if (rebounds < 0.5) return found;
  const double variance = (own * own + s * root.variance) / rebounds;
  found.sd = std::sqrt(variance);
  const double slope = root.slope / std::sqrt(s);
  found.information += slope * slope / (variance + slope * slope * tau * tau);
  return found;
}

}  // namespace

PointOutlook point_outlook(double m, double m_V, double m_d, const PlannedScatter& by) {
  gsl_errors_are_values();
  const double shared = by.rebound_measured ? 2.0 * std::max(m, 0.0) : 0.0;
  const double tau = std::hypot((m_V + shared) * by.velocity_error, m_d * by.diameter_error);
  const double s = by.spread * std::abs(m_V);
  if (s > 0.0 && m < near_capture * s) return where_some_are_captured(m, s, tau, by);
  PointOutlook found;
  found.restitution = std::sqrt(std::max(m, 0.0));
  found.captured = m > 0.0 ? 0.0 : 1.0;
  const double own = std::hypot(by.scatter * found.restitution, by.floor);
  const double spread = s > 0.0 ? 0.5 * s / found.restitution : 0.0;  // m is above 30 s
  const double variance = (own * own + spread * spread) / by.events;
  if (m > 0.0) found.sd = std::sqrt(variance);
  // 4 psi^2 with psi of `weighted_residual`; for m far below zero the sum would cancel.
  const double hypotenuse = std::hypot(m, variance);
  const double four_psi_squared =
      m >= 0.0 ? 2.0 * (m + hypotenuse) : 2.0 * variance * variance / (hypotenuse - m);
  const double width = std::sqrt(variance * (four_psi_squared + 2.0 * variance) + tau * tau);
  found.information = information_of_censored(m / width) / (width * width);
  return found;
}

PlannedParameters planned_parameters(const ImpactModel& model, const std::vector<double>& theta) {
  PlannedParameters found;
  std::vector<double> information;
  for (std::size_t j = 0; j < model.slots.size(); ++j) {
    const ParameterSlot& slot = model.slots[j];
    if (!slot.free && !slot.is_constant()) continue;
    found.slots.push_back(j);
    if (slot.is_constant()) {
      const UncertainConstant& constant = model.constants[j - model.first_constant()];
      found.unit.push_back(1.0 / constant.deviation_slope(theta[j]));
      information.push_back(1.0);
    } else {
      found.unit.push_back(theta[j] != 0.0 ? std::abs(theta[j]) : 1.0);
      information.push_back(0.0);
    }
  }
  const Eigen::Map<const Eigen::VectorXd> diagonal(information.data(),
                                                   static_cast<Eigen::Index>(information.size()));
  found.known = diagonal.asDiagonal();
  return found;
}

PossiblePoints possible_points(const ImpactModel& model, const std::vector<double>& theta,
                               const PlannedParameters& parameters, std::vector<PointConditions> at,
                               const std::vector<PlannedScatter>& scatter) {
  PossiblePoints found;
  found.at = std::move(at);
  PointPredictor predictor(model, found.at);
  predictor.evaluate(theta, true);
  found.slopes.resize(static_cast<Eigen::Index>(found.at.size()),
                      static_cast<Eigen::Index>(parameters.slots.size()));
  std::vector<double> gradient(theta.size());
  for (std::size_t i = 0; i < found.at.size(); ++i) {
    const PointConditions& point = found.at[i];
    if (!predictor.at(i).usable()) {
      throw ComputationError(
          fmt::format("the impact at V = {:.6g} m/s, d = {:.6g} um has no answer", point.velocity,
                      point.diameter / units::um));
    }
    const double square = predictor.at(i).restitution_squared;
    found.outlook.push_back(point_outlook(square, predictor.velocity_slope(i) * point.velocity,
                                          predictor.diameter_slope(i) * point.diameter,
                                          scatter[point.dataset]));
    predictor.gradient_row(i, 1.0, gradient);
    for (std::size_t k = 0; k < parameters.slots.size(); ++k) {
      found.slopes(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          gradient[parameters.slots[k]] * parameters.unit[k];
    }
  }
  return found;
}

Eigen::MatrixXd PossiblePoints::rows() const {
  Eigen::VectorXd weights(slopes.rows());
  for (std::size_t i = 0; i < outlook.size(); ++i) {
    weights(static_cast<Eigen::Index>(i)) = std::sqrt(outlook[i].information);
  }
  return weights.asDiagonal() * slopes;
}

}  // namespace recoil
