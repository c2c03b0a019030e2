#include "diagnosis/search.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/kept_rows.hpp"
#include "diagnosis/discrepancy.hpp"
#include "estimate/impact_problem.hpp"
#include "estimate/observation.hpp"
#include "estimate/residual.hpp"
#include "estimate/setting_error.hpp"
#include "estimate/shared_errors.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

constexpr double rounding_of_criterion = 1e-6;  // a smaller difference of two is none

/// The fit with an error of settings that excludes smooth trends: the one that the fit estimated
/// includes the misfit of the base model and would hide it.
FitResult with_rough_settings(const FitSpec& spec, const std::vector<Dataset>& datasets,
                              const FitResult& fitted) {
  const Observations& data = fitted.data;
  const double sigma = fitted.weights.noise.setting_sd;
  if (!data.noise.setting_sd_estimated || !(sigma > 0.0)) return fitted;
  const int free = fitted.model.free_count();
  const Eigen::MatrixXd smooth = smooth_functions(data);
  const Eigen::Index half = (count_settings(data).settings - free) / 2;
  if (half < 1) return fitted;
  std::vector<std::vector<double>> trends;
  for (Eigen::Index k = 0; k < std::min<Eigen::Index>(half, smooth.cols()); ++k) {
    trends.emplace_back(smooth.col(k).begin(), smooth.col(k).end());
  }
  const double rough =
      estimated_setting_error(data, fitted.weights, fitted.prediction_squared, free, trends);
  NoiseSpec noise = spec.noise;
  noise.setting_sd = too_few_settings(data, free) ? 0.0 : std::min(rough, sigma);
  FitOptions options;
  options.several_starts = false;
  options.start = fitted.theta;
  FitResult again = fit(fitted.model, gather(datasets, noise), options);
  return again.usable ? again : fitted;
}

/// Draws a point whose impacts were all captured and whose scatter is unknown: if the model
/// predicts a rebound, the error of e decides (see `weighted_residual`).
void draw_capture(Observation& point, const PointWeights& weights, double square,
                  RandomStream& random) {
  const double sd = weights.sd;
  const double error = std::hypot(std::sqrt(2.0) * sd * sd, weights.input_sd);
  const double reading = std::sqrt(std::max(square, 0.0)) + sd * random.normal();
  if (!(square + error * random.normal() > 0.0) || !(reading > 0.0)) return;
  point.censored = false;
  point.captured = 0;
  point.restitution = reading;
}

/// The columns `chosen` of the first `points` rows of a Jacobian, scaled to unit length.
Eigen::MatrixXd unit_columns(const std::vector<double>& jacobian, Eigen::Index points,
                             std::size_t slots, const std::vector<std::size_t>& chosen) {
  const Eigen::Map<const RowMajor> all(jacobian.data(), points, static_cast<Eigen::Index>(slots));
  Eigen::MatrixXd columns(points, all.cols());
  Eigen::Index count = 0;
  for (const std::size_t j : chosen) {
    const Eigen::VectorXd column = all.col(static_cast<Eigen::Index>(j));
    const double length = column.norm();
    if (length > 0.0) columns.col(count++) = column / length;
  }
  return columns.leftCols(count);
}

/// An orthonormal basis of the span of the columns [points x rank].
Eigen::MatrixXd basis_of(const Eigen::MatrixXd& columns) {
  constexpr double negligible = 1e-6;  // of the unit length of the columns
  if (columns.cols() == 0) return columns;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  Eigen::Index rank = 0;
  while (rank < std::min(columns.rows(), columns.cols()) &&
         std::abs(qr.matrixR()(rank, rank)) > negligible) {
    ++rank;
  }
  return qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), rank);
}

/// Sets the errors of the laws that `base.spec` states, the refits under them and their criterion.
void allow_errors_of_laws(SearchBase& base) {
  const FitResult& fitted = base.fitted;
  base.laws = allowed_law_errors(base.spec.law_error, fitted.data);
  base.first = refit_with_law_error(base.candidate, fitted.data, fitted.weights, base.exact,
                                    base.laws, base.laws.sizes.front().size);
  RefitOverLaws over =
      refit_over_laws(base.candidate, fitted.data, fitted.weights, base.exact, base.laws);
  base.refit = std::move(over.refit);
  base.criterion = over.criterion;
}

}  // namespace

std::vector<double> jacobian_at(const SearchBase& base, const Candidate& candidate,
                                const std::vector<double>& theta) {
  const LeastSquaresProblem problem =
      whitened(impact_problem(candidate.model, base.fitted.data, base.fitted.weights),
               *base.refit.discrepancy);
  std::vector<double> residuals(problem.residual_count);
  std::vector<double> jacobian(problem.residual_count * theta.size(), 0.0);
  if (!problem.evaluate(theta, residuals, jacobian)) jacobian.assign(jacobian.size(), 0.0);
  return jacobian;
}

FitSpec with_constants_adjusted(FitSpec spec) {
  if (spec.uncertainty.materials != Materials::exact) {
    spec.uncertainty.materials = Materials::adjusted;
  }
  return spec;
}

SearchBase search_base(const FitSpec& spec, const std::vector<Dataset>& datasets,
                       const FitResult& estimated, const DiagnosisOptions& options) {
  SearchBase base{
      .spec = spec,
      .datasets = datasets,
      .fitted = with_rough_settings(spec, datasets, estimated),
      .candidate = make_candidate(spec, datasets, {}),
      .noise = white_noise(quick_samples, estimated.data.points.size(), options.seed),
      .options = options,
  };
  base.candidate.model.solver = base.fitted.model.solver;
  base.exact =
      refit_candidate(base.candidate, base.fitted.data, base.fitted.weights, base.fitted.theta, 1);
  if (!base.fitted.data.noise.sd_stated) base.noise_scale = base.fitted.noise_scale;
  allow_errors_of_laws(base);
  return base;
}

SearchBase with_exact_laws(const SearchBase& allowed, const FitSpec& spec,
                           const DiagnosisOptions& options) {
  SearchBase base{
      .spec = spec,
      .datasets = allowed.datasets,
      .fitted = allowed.fitted,
      .candidate = allowed.candidate,
      .exact = allowed.exact,
      .noise_scale = allowed.noise_scale,
      .noise = allowed.noise,
      .options = options,
      .exact_fits = allowed.exact_fits,
  };
  allow_errors_of_laws(base);
  return base;
}

WeightedData simulate_points(const SearchBase& base, std::span<const double> squares, double bend,
                             std::uint64_t index) {
  RandomStream random(base.options.seed, RandomPurpose::diagnosis, index);
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(base.laws.functions.cols());
  for (double& weight : weights) weight = random.normal();
  const Eigen::VectorXd wrong_by = bend * (base.laws.functions * weights);
  const FitResult& fitted = base.fitted;
  WeightedData sample{fitted.data, fitted.weights};
  RandomStream of_shared(base.options.seed, RandomPurpose::settings, index);
  const std::vector<double> shared =
      draw_shared_errors(fitted.data, fitted.weights, base.noise_scale, of_shared);
  for (std::size_t i = 0; i < shared.size(); ++i) {
    Observation& point = sample.data.points[i];
    PointWeights& own = sample.weights.points[i];
    const double loss = std::clamp(1.0 - squares[i], 0.0, 1.0);
    const double bent = squares[i] + loss * wrong_by(static_cast<Eigen::Index>(i));
    const DrawnPoint drawn =
        simulate_observation(point, own, shifted_square(bent, shared[i]),
                             has_own_scatter(fitted.data, i) ? base.noise_scale : 0.0,
                             fitted.data.noise.student, random);
    point = drawn.point;
    own = drawn.weights;
    locate_peak(point, own);
    if (point.censored && !point.counts_only() && !(own.scatter > 0.0)) {
      draw_capture(point, own, squares[i], random);
    }
  }
  return sample;
}

WeightedData simulate_base(const SearchBase& base, std::uint64_t index) {
  return simulate_points(base, base.fitted.prediction_squared, base.laws.sizes.front().size, index);
}

std::optional<std::vector<double>> residuals_of_sample(const SearchBase& base,
                                                       std::uint64_t index) {
  using Answer = std::optional<std::vector<double>>;
  const auto make = [&] {
    return residuals_of_refit(base.candidate, simulate_base(base, index), base.first.theta,
                              *base.first.discrepancy);
  };
  const auto write = [](const Answer& answer) { return row_json(calibration_row(answer)); };
  const auto read = [&](const Json& row) -> Answer {
    const std::vector<double> values = row_numbers(row);
    if (values.size() == 1) return std::nullopt;
    if (values.size() != base.fitted.data.points.size() + 1) {
      throw std::length_error("residuals of other points");
    }
    return std::vector<double>(values.begin() + 1, values.end());
  };
  return kept_or_made(base.options.kept.get(), base.options.first_piece + index, make, write, read);
}

std::vector<double> calibration_row(const std::optional<std::vector<double>>& residuals) {
  if (!residuals) return {0.0};
  std::vector<double> row = {1.0};
  row.insert(row.end(), residuals->begin(), residuals->end());
  return row;
}

Eigen::MatrixXd gains_by_chance(const SearchBase& base,
                                const std::vector<CandidateResult>& candidates,
                                const Eigen::MatrixXd& residuals) {
  const Observations& data = base.fitted.data;
  const Eigen::Index points = residuals.rows();
  const Eigen::MatrixXd model = basis_of(unit_columns(
      base.refit.jacobian, points, base.refit.theta.size(), base.refit.moving_slots()));
  const Eigen::VectorXd squares = residuals.colwise().squaredNorm();
  Eigen::MatrixXd gains(residuals.cols(), static_cast<Eigen::Index>(candidates.size()));
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const Candidate& candidate = candidates[k].candidate;
    const auto& slots = candidate.model.slots;
    std::vector<std::size_t> added;
    for (std::size_t j = 0; j < slots.size(); ++j) {
      if (slots[j].free && candidate.adds(slots[j])) added.push_back(j);
    }
    Eigen::MatrixXd own = unit_columns(jacobian_at(base, candidate, candidates[k].refit.theta),
                                       points, slots.size(), added);
    own -= model * (model.transpose() * own);
    const Eigen::VectorXd taken = (basis_of(own).transpose() * residuals).colwise().squaredNorm();
    for (Eigen::Index b = 0; b < residuals.cols(); ++b) {
      gains(b, static_cast<Eigen::Index>(k)) =
          corrected_criterion(data, squares(b), base.candidate.free_count) -
          corrected_criterion(data, squares(b) - taken(b), candidate.free_count);
    }
  }
  return gains;
}

void calibrate(const SearchBase& base, std::vector<CandidateResult>& candidates,
               const Eigen::MatrixXd& residuals) {
  if (candidates.empty()) return;
  const Eigen::VectorXd most = gains_by_chance(base, candidates, residuals).rowwise().maxCoeff();
  for (CandidateResult& c : candidates) {
    const auto as_much = (most.array() >= -c.delta_aicc - rounding_of_criterion).count();
    c.p_value = (1.0 + static_cast<double>(as_much)) / (1.0 + static_cast<double>(most.size()));
  }
}

}  // namespace recoil
