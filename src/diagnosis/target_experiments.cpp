#include "diagnosis/target_experiments.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnosis/measurable.hpp"
#include "diagnosis/odds.hpp"
#include "diagnosis/predicted_spread.hpp"

namespace recoil {
namespace {

constexpr double least_expected = 0.3;  // nearer to capture a straight line is a poor guess
constexpr int velocities_of_size = 6;   // of each size
constexpr double least_range = 3.0;     // the fastest over the slowest of them
constexpr int looked_at = 24;           // velocities, to find the slowest

/// The dataset with the most points.
std::size_t fullest(const SearchBase& base) {
  const auto most = std::max_element(
      base.datasets.begin(), base.datasets.end(),
      [](const Dataset& a, const Dataset& b) { return a.points.size() < b.points.size(); });
  return static_cast<std::size_t>(most - base.datasets.begin());
}

/// ln of the odds that `count` impacts at every place are expected to give the right one of two:
/// the smaller of the two divergences of Kullback & Leibler.
double expected_log_odds(const PredictedTogether& a, const PredictedTogether& b,
                         const Eigen::VectorXd& apart, double count) {
  const Eigen::Index size = apart.size();
  const Eigen::MatrixXd noise = Eigen::MatrixXd::Identity(size, size) / count;
  const auto divergence = [&](const Eigen::MatrixXd& from, const Eigen::MatrixXd& to) {
    const Eigen::LLT<Eigen::MatrixXd> wide(to), narrow(from);
    const auto log_determinant = [](const Eigen::LLT<Eigen::MatrixXd>& factor) {
      return 2.0 * factor.matrixLLT().diagonal().array().log().sum();
    };
    return 0.5 * (wide.solve(from).trace() - static_cast<double>(size) + log_determinant(wide) -
                  log_determinant(narrow) + apart.dot(wide.solve(apart)));
  };
  const Eigen::MatrixXd of_a = a.covariance + noise;
  const Eigen::MatrixXd of_b = b.covariance + noise;
  return std::min(divergence(of_a, of_b), divergence(of_b, of_a));
}

/// One target, as all rivals see it.
class Target {
 public:
  Target(const SearchBase& base, const std::vector<const CandidateResult*>& rivals,
         std::size_t like, const TargetMaterial& material)
      : base_(base), like_(like), material_(material) {
    const Dataset dataset = on_target(base.datasets[like], material);
    std::vector<RivalElsewhere> models;
    for (const CandidateResult* rival : rivals) models.emplace_back(base, *rival, dataset, like);
    place(models);
    for (const RivalElsewhere& model : models) {
      predicted_.push_back(possible_.at.empty() ? PredictedTogether{} : model.predicted(possible_));
    }
  }

  /// The impacts that tell rivals `a` and `b` apart, put into `experiment`; false where a million
  /// would not do.
  bool tells(std::size_t a, std::size_t b, NextExperiment& experiment) const {
    const PredictedTogether& one = predicted_[a];
    const PredictedTogether& other = predicted_[b];
    if (one.covariance.size() == 0 || other.covariance.size() == 0) return false;
    const auto places = static_cast<int>(possible_.at.size());
    const Eigen::Map<const Eigen::VectorXd> sd(possible_.sd.data(), places);
    const Eigen::VectorXd difference = one.restitution - other.restitution;
    const Eigen::VectorXd apart = difference.cwiseQuotient(sd);
    if (!apart.allFinite()) return false;
    const auto odds = [&](double count) { return expected_log_odds(one, other, apart, count); };
    const std::optional<int> count = fewest_impacts(odds, most_impacts / places);
    if (!count) return false;
    Eigen::Index where = 0;
    apart.cwiseAbs().maxCoeff(&where);
    const PointConditions& at = possible_.at[static_cast<std::size_t>(where)];
    experiment.kind = ExperimentKind::target;
    experiment.dataset = like_;
    experiment.diameter = at.diameter;
    experiment.velocity = at.velocity;
    experiment.difference = difference(where);
    experiment.events = *count * places;
    experiment.log_odds = odds(*count);
    experiment.material = material_;
    experiment.places.clear();
    for (const PointConditions& place : possible_.at) {
      experiment.places.push_back({place.diameter, place.velocity, *count});
    }
    return true;
  }

 private:
  void place(const std::vector<RivalElsewhere>& models) {
    double low = INFINITY, high = 0.0;
    for (const ImpactPoint& point : base_.datasets[like_].points) {
      low = std::min(low, point.incident_velocity);
      high = std::max(high, point.incident_velocity);
    }
    const std::vector<double> sizes = distinct_diameters(base_.datasets[like_]);
    add_places(models, sizes.front(), low, high);
    if (sizes.size() > 1) add_places(models, sizes.back(), low, high);
  }

  void add_places(const std::vector<RivalElsewhere>& models, double diameter, double low,
                  double high) {
    const std::size_t dataset = models.front().dataset();
    const auto spaced = [&](double from, int count) {
      std::vector<PointConditions> at;
      for (int k = 0; k < count; ++k) {
        const double share = static_cast<double>(k) / (count - 1);
        at.push_back({dataset, diameter, from * std::pow(high / from, share)});
      }
      return at;
    };
    const std::vector<PointConditions> looked = spaced(low, looked_at);
    std::size_t first = 0;  // from here on all expect rebounds
    for (const RivalElsewhere& model : models) {
      const std::vector<double> e = model.restitution(looked);
      for (std::size_t i = first; i < e.size(); ++i) {
        if (!(e[i] >= least_expected)) first = i + 1;
      }
    }
    if (first == looked.size() || high < least_range * looked[first].velocity) return;
    for (const PointConditions& at : spaced(looked[first].velocity, velocities_of_size)) {
      possible_.at.push_back(at);
      possible_.sd.push_back(scatter_of_one_event(base_.fitted, like_, at.velocity));
    }
  }

  const SearchBase& base_;
  std::size_t like_;
  TargetMaterial material_;
  PossibleImpacts possible_;
  std::vector<PredictedTogether> predicted_;
};

}  // namespace

std::vector<NextExperiment> target_experiments(const SearchBase& base,
                                               const std::vector<const CandidateResult*>& rivals) {
  if (rivals.size() < 2) return {};
  const std::size_t like = fullest(base);
  std::vector<Target> targets;
  for (const TargetMaterial& material : other_targets(base.datasets[like])) {
    targets.emplace_back(base, rivals, like, material);
  }
  std::vector<NextExperiment> all;
  for (std::size_t a = 0; a < rivals.size(); ++a) {
    for (std::size_t b = a + 1; b < rivals.size(); ++b) {
      std::optional<NextExperiment> best;
      for (const Target& target : targets) {
        NextExperiment found;
        found.one = rivals[a]->candidate.name();
        found.other = rivals[b]->candidate.name();
        if (!target.tells(a, b, found)) continue;
        if (!best || found.events < best->events) best = std::move(found);
      }
      if (best) all.push_back(*std::move(best));
    }
  }
  return all;
}

}  // namespace recoil
