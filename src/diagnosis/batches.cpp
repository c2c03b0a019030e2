#include "diagnosis/batches.hpp"

#include <gsl/gsl_cdf.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/gsl_errors.hpp"

namespace recoil {
namespace {

constexpr double not_by_chance = 0.001;
constexpr std::size_t terms = 3;  // of a parabola

struct Offset {
  std::size_t slot = 0;
  std::size_t dataset = 0;
  double log_diameter = 0.0;
};

/// The offsets that move, each with the diameter of its series.
std::vector<Offset> moving_offsets(const Observations& data, const CandidateResult& candidate) {
  const ImpactModel& model = candidate.candidate.model;
  std::size_t first = 0;  // of the batch's parameters among those of the chain
  for (const Mechanism* mechanism : model.chain) {
    if (mechanism->is_batch()) break;
    first += mechanism->info.parameters.size();
  }
  std::map<std::size_t, Offset> found;
  for (const Observation& point : data.points) {
    const std::size_t slot = model.slot_own[first][point.dataset][point.series];
    if (candidate.refit.moving[slot]) {
      found[slot] = {slot, point.dataset, std::log(point.diameter)};
    }
  }
  std::vector<Offset> offsets;
  for (const auto& [slot, offset] : found) offsets.push_back(offset);
  return offsets;
}

/// The covariance of all that moves; the place of each slot in it.
Eigen::MatrixXd covariance_of(const Refit& refit, std::vector<Eigen::Index>& place) {
  const std::size_t p = refit.theta.size();
  const auto n = static_cast<Eigen::Index>(refit.residuals.size());
  place.assign(p, -1);
  Eigen::Index moving = 0;
  for (std::size_t j = 0; j < p; ++j) {
    if (refit.moving[j]) place[j] = moving++;
  }
  Eigen::MatrixXd J(n, moving);
  for (std::size_t j = 0; j < p; ++j) {
    for (Eigen::Index i = 0; i < n && place[j] >= 0; ++i) {
      J(i, place[j]) = refit.jacobian[static_cast<std::size_t>(i) * p + j];
    }
  }
  const Eigen::VectorXd length = J.colwise().norm();
  if (!(length.minCoeff() > 0.0)) return {};
  J = J * length.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd inverse =
      (J.transpose() * J).completeOrthogonalDecomposition().pseudoInverse();
  return length.cwiseInverse().asDiagonal() * inverse * length.cwiseInverse().asDiagonal();
}

}  // namespace

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
  if (!series_are_sizes(data)) return false;
  const std::vector<Offset> offsets = moving_offsets(data, candidate);
  std::map<std::size_t, std::vector<Offset>> of_dataset;
  for (const Offset& offset : offsets) of_dataset[offset.dataset].push_back(offset);
  std::size_t columns = 0;
  for (const auto& [dataset, own] : of_dataset) columns += std::min(terms, own.size());
  if (offsets.size() <= columns) return true;
  std::vector<Eigen::Index> place;
  const Eigen::MatrixXd all = covariance_of(candidate.refit, place);
  if (all.size() == 0) return true;
  const auto count = static_cast<Eigen::Index>(offsets.size());
  Eigen::MatrixXd C(count, count),
      A = Eigen::MatrixXd::Zero(count, static_cast<Eigen::Index>(columns));
  Eigen::VectorXd o(count);
  Eigen::Index column = 0;
  std::map<std::size_t, Eigen::Index> first;  // column of each dataset
  for (const auto& [dataset, own] : of_dataset) {
    first[dataset] = column;
    column += static_cast<Eigen::Index>(std::min(terms, own.size()));
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    const Offset& at = offsets[static_cast<std::size_t>(i)];
    o(i) = candidate.refit.theta[at.slot];
    const std::vector<Offset>& own = of_dataset[at.dataset];
    double power = 1.0;
    for (std::size_t k = 0; k < std::min(terms, own.size()); ++k) {
      A(i, first[at.dataset] + static_cast<Eigen::Index>(k)) = power;
      power *= at.log_diameter - own.front().log_diameter;
    }
    for (Eigen::Index j = 0; j < count; ++j) {
      C(i, j) = noise_scale * noise_scale *
                all(place[at.slot], place[offsets[static_cast<std::size_t>(j)].slot]);
    }
  }
  // What the base model's own parameters make of offsets has no error of its own: a floor.
  C.diagonal().array() += 1e-12;
  const Eigen::LLT<Eigen::MatrixXd> root(C);
  if (root.info() != Eigen::Success) return true;
  const Eigen::MatrixXd white = root.matrixL().solve(A);
  const Eigen::VectorXd seen = root.matrixL().solve(o);
  const Eigen::VectorXd rest = seen - white * white.colPivHouseholderQr().solve(seen);
  gsl_errors_are_values();
  return gsl_cdf_chisq_Q(rest.squaredNorm(), static_cast<double>(count - column)) > not_by_chance;
}

}  // namespace recoil
