#include "diagnosis/target_experiments.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnosis/elsewhere.hpp"
#include "diagnosis/measurable.hpp"
#include "diagnosis/odds.hpp"
#include "diagnosis/predicted_spread.hpp"

namespace recoil {
namespace {

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
    find_places(models);
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
  void find_places(const std::vector<RivalElsewhere>& models) {
    double low = INFINITY, high = 0.0;
    for (const ImpactPoint& point : base_.datasets[like_].points) {
      low = std::min(low, point.incident_velocity);
      high = std::max(high, point.incident_velocity);
    }
    const auto expected = [&](const std::vector<PointConditions>& at) {
      std::vector<double> least(at.size(), INFINITY);
      for (const RivalElsewhere& model : models) {
        const std::vector<double> e = model.restitution(at);
        for (std::size_t i = 0; i < e.size(); ++i) {
          least[i] = std::isnan(e[i]) ? 0.0 : std::min(least[i], e[i]);
        }
      }
      return least;
    };
    possible_.at =
        places_elsewhere(base_.datasets[like_], base_.datasets.size(), low, high, expected);
    for (const PointConditions& at : possible_.at) {
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
  const std::size_t like = fullest(base.datasets);
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
