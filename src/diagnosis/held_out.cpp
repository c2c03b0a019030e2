#include "diagnosis/held_out.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/parallel.hpp"
#include "core/random.hpp"
#include "core/statistics.hpp"
#include "diagnosis/law_errors.hpp"
#include "estimate/impact_problem.hpp"
#include "estimate/observation.hpp"
#include "estimate/predictor.hpp"
#include "estimate/residual.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_size_folds = 6;
constexpr std::size_t velocity_bands = 3;
constexpr int resamplings = 1999;
// Larger deviations count as this [standard deviations]: if a model has a cut-off, one point on the
// wrong side would outweigh all others.
constexpr double worst_miss = 5.0;

/// The indices of all points but `fold`, in the order of the data.
std::vector<std::size_t> points_outside(const Fold& fold, std::size_t points) {
  std::vector<bool> outside(points, true);
  for (const std::size_t i : fold.points) outside[i] = false;
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < points; ++i) {
    if (outside[i]) indices.push_back(i);
  }
  return indices;
}

/// Subtracts from the `residuals` of a fold their prediction from the residuals `r_seen` of the
/// other points. @return the errors that the residuals of the fold then share
Discrepancy given_the_others(const Eigen::MatrixXd& U_seen, const std::vector<double>& r_seen,
                             const Eigen::MatrixXd& U, std::vector<double>& residuals) {
  const Eigen::Index rank = U.cols();
  const Eigen::LLT<Eigen::MatrixXd> information(Eigen::MatrixXd::Identity(rank, rank) +
                                                U_seen.transpose() * U_seen);
  const Eigen::Map<const Eigen::VectorXd> r(r_seen.data(), U_seen.rows());
  Eigen::Map<Eigen::VectorXd> own(residuals.data(), U.rows());
  own -= U * information.solve(U_seen.transpose() * r);
  // (I + U_s' U_s)^-1 = L^-T L^-1
  return Discrepancy(information.matrixL().solve(U.transpose()).transpose());
}

/// Splits distinct values into at most `most` groups of neighbours with about equally many values.
std::vector<std::vector<double>> groups_of(const std::set<double>& values, std::size_t most) {
  const std::vector<double> sorted(values.begin(), values.end());
  const std::size_t count = std::min(most, sorted.size());
  std::vector<std::vector<double>> groups(count);
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    groups[k * count / sorted.size()].push_back(sorted[k]);
  }
  return groups;
}

void add_size_folds(const Observations& data, std::vector<Fold>& folds) {
  std::set<double> diameters;
  for (const Observation& point : data.points) diameters.insert(point.diameter);
  if (diameters.size() < 2) return;
  for (const std::vector<double>& group : groups_of(diameters, most_size_folds)) {
    Fold fold{FoldKind::size, group.front(), group.back(), 0, {}};
    for (std::size_t i = 0; i < data.points.size(); ++i) {
      const double d = data.points[i].diameter;
      if (d >= group.front() && d <= group.back()) fold.points.push_back(i);
    }
    folds.push_back(std::move(fold));
  }
}

void add_velocity_folds(const Observations& data, std::vector<Fold>& folds) {
  const auto [slow, fast] = std::ranges::minmax_element(data.points, {}, &Observation::velocity);
  const double low = slow->velocity;
  const double high = fast->velocity;
  for (std::size_t k = 0; k < velocity_bands; ++k) {
    const auto edge = [&](std::size_t j) {
      return low * std::pow(high / low, static_cast<double>(j) / velocity_bands);
    };
    Fold fold{FoldKind::velocity, edge(k), edge(k + 1), 0, {}};
    for (std::size_t i = 0; i < data.points.size(); ++i) {
      const double V = data.points[i].velocity;
      const bool last = k + 1 == velocity_bands;
      if ((k == 0 || V >= edge(k)) && (last || V < edge(k + 1))) fold.points.push_back(i);
    }
    if (!fold.points.empty()) folds.push_back(std::move(fold));
  }
}

double root_mean_square(const std::vector<double>& errors) {
  double sum = 0.0;
  for (const double error : errors) sum += error * error;
  return errors.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(errors.size()));
}

}  // namespace

std::vector<Fold> held_out_folds(const Observations& data, std::size_t datasets, int free_count) {
  std::vector<Fold> folds;
  add_size_folds(data, folds);
  add_velocity_folds(data, folds);
  if (datasets > 1) {
    for (std::size_t k = 0; k < datasets; ++k) {
      Fold fold{FoldKind::target, 0.0, 0.0, k, {}};
      for (std::size_t i = 0; i < data.points.size(); ++i) {
        if (data.points[i].dataset == k) fold.points.push_back(i);
      }
      folds.push_back(std::move(fold));
    }
  }
  const auto least = static_cast<std::size_t>(free_count) + 2;
  std::erase_if(folds, [&](const Fold& fold) {
    return data.points.size() - fold.points.size() < least || fold.points.empty();
  });
  return folds;
}

std::vector<FoldPrediction> predict_folds(const Candidate& candidate, const Observations& data,
                                          const Weights& weights, const LawErrors& laws,
                                          const std::vector<Fold>& folds, const Refit& all,
                                          int threads) {
  const double size = all.law_error;
  std::vector<FoldPrediction> predictions(folds.size());
  parallel_over(folds.size(), threads, [&](std::size_t f) {
    const std::vector<std::size_t> others = points_outside(folds[f], data.points.size());
    const Observations seen = data.subset(others);
    const Observations unseen = data.subset(folds[f].points);
    const Weights weights_seen = weights.subset(others);
    const Weights weights_unseen = weights.subset(folds[f].points);
    const bool errors = laws.act(candidate, size);
    const LawErrors of_seen = errors ? laws.of(others) : LawErrors();
    const LawErrors of_unseen = errors ? laws.of(folds[f].points) : LawErrors();
    Refit start;
    start.usable = true;
    start.theta = all.theta;
    const Refit refit = errors ? refit_with_law_error(candidate, seen, weights_seen,
                                                      std::move(start), of_seen, size)
                               : refit_candidate(candidate, seen, weights_seen, all.theta, 0);
    if (!refit.usable) return;
    const LeastSquaresProblem problem = impact_problem(candidate.model, unseen, weights_unseen);
    std::vector<double> residuals(problem.residual_count);
    if (!problem.evaluate(refit.theta, residuals, {})) return;
    residuals.resize(unseen.points.size());
    double log_determinant = 0.0;
    if (errors) {
      const auto U_seen =
          law_error_columns(candidate, seen, weights_seen, refit.theta, of_seen, size);
      const auto U_unseen =
          law_error_columns(candidate, unseen, weights_unseen, refit.theta, of_unseen, size);
      if (!U_seen || !U_unseen) return;
      std::vector<double> plain = refit.residuals;
      refit.discrepancy->unwhiten(plain);
      const Discrepancy left = given_the_others(*U_seen, plain, *U_unseen, residuals);
      left.whiten(residuals);
      log_determinant = left.log_determinant();
    }
    const std::vector<Prediction> at =
        predict(candidate.model, refit.theta, unseen.conditions(), false);
    FoldPrediction& out = predictions[f];
    out.usable = true;
    out.criterion = corrected_criterion(seen, refit, candidate.free_count);
    out.deviance = log_determinant;
    for (std::size_t k = 0; k < residuals.size(); ++k) {
      const Observation& point = unseen.points[k];
      out.deviance += std::min(residuals[k] * residuals[k], worst_miss * worst_miss);
      if (point.counts_only()) continue;
      out.error.push_back(
          (point.censored ? 0.0 : point.restitution) -
          expected_restitution(point, weights_unseen.points[k], at[k].restitution_squared));
    }
  });
  return predictions;
}

HeldOutGain held_out_gain(const std::vector<Fold>& folds, const std::vector<FoldPrediction>& base,
                          std::vector<FoldPrediction> extended, std::uint64_t seed) {
  HeldOutGain gain;
  std::vector<bool> chosen(folds.size(), true);
  for (std::size_t f = 0; f < folds.size(); ++f) {
    chosen[f] = !(extended[f].usable && extended[f].criterion > base[f].criterion);
    if (!chosen[f]) extended[f] = base[f];
    const bool usable = base[f].usable && extended[f].usable;
    gain.decisive = gain.decisive || (usable && folds[f].kind != FoldKind::velocity);
  }
  std::vector<std::size_t> used;
  std::vector<double> all_base, all_extended;
  for (std::size_t f = 0; f < folds.size(); ++f) {
    if (!base[f].usable || !extended[f].usable) continue;
    const double log_score = 0.5 * (base[f].deviance - extended[f].deviance);
    const bool counted = !gain.decisive || folds[f].kind != FoldKind::velocity;
    gain.folds.push_back({folds[f], root_mean_square(base[f].error),
                          root_mean_square(extended[f].error), log_score, counted, chosen[f]});
    if (!counted) continue;
    used.push_back(f);
    gain.log_score += log_score;
    all_base.insert(all_base.end(), base[f].error.begin(), base[f].error.end());
    all_extended.insert(all_extended.end(), extended[f].error.begin(), extended[f].error.end());
  }
  if (used.empty()) return gain;
  gain.rmse_base = root_mean_square(all_base);
  gain.rmse_extended = root_mean_square(all_extended);
  if (!(gain.rmse_base > 0.0)) return gain;
  gain.relative = 1.0 - gain.rmse_extended / gain.rmse_base;
  std::vector<double> samples;
  for (int b = 0; b < resamplings; ++b) {
    RandomStream random(seed, RandomPurpose::held_out, static_cast<std::uint64_t>(b));
    double square_base = 0.0, square_extended = 0.0;
    for (const std::size_t f : used) {
      for (std::size_t k = 0; k < base[f].error.size(); ++k) {
        const std::size_t i = random.below(base[f].error.size());
        square_base += base[f].error[i] * base[f].error[i];
        square_extended += extended[f].error[i] * extended[f].error[i];
      }
    }
    if (square_base > 0.0) samples.push_back(1.0 - std::sqrt(square_extended / square_base));
  }
  std::ranges::sort(samples);
  if (!samples.empty()) {
    gain.lower = sorted_quantile(samples, 0.025);
    gain.upper = sorted_quantile(samples, 0.975);
  }
  return gain;
}

}  // namespace recoil
