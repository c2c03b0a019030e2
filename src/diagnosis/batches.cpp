#include "diagnosis/batches.hpp"

#include <gsl/gsl_cdf.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/gsl_errors.hpp"
#include "diagnosis/moving_columns.hpp"

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
  const auto batch = std::find_if(model.chain.begin(), model.chain.end(),
                                  [](const Mechanism* mechanism) { return mechanism->is_batch(); });
  if (batch == model.chain.end()) return {};
  const std::size_t first = first_parameter(model, **batch);
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
  const auto moving = moving_columns(refit);
  if (!moving) return {};
  place.assign(refit.theta.size(), -1);
  for (std::size_t k = 0; k < moving->slots.size(); ++k) {
    place[moving->slots[k]] = static_cast<Eigen::Index>(k);
  }
  const Eigen::MatrixXd inverse =
      (moving->unit.transpose() * moving->unit).completeOrthogonalDecomposition().pseudoInverse();
  const Eigen::VectorXd back = moving->length.cwiseInverse();
  return back.asDiagonal() * inverse * back.asDiagonal();
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
