#include "diagnosis/next_experiment.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/measurable.hpp"
#include "estimate/predictor.hpp"
#include "mechanism/catalogue.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_compared = 4;
constexpr double most_impacts = 1e6;
const double wanted_log_odds = std::log(99.0);

using Curve = std::vector<double>;

/// e on the grid, 0 where captured; NaN where there is no answer.
Curve curve_of(const Candidate& candidate, const std::vector<double>& theta,
               const std::vector<PointConditions>& grid) {
  Curve curve;
  for (const Prediction& at : predict(candidate.model, theta, grid, false)) {
    curve.push_back(at.usable() ? at.restitution() : NAN);
  }
  return curve;
}

/// Has this dataset impacts from which a condition takes the mechanism away already?
bool was_taken_away(const Candidate& candidate, const Mechanism& mechanism, std::size_t dataset) {
  return std::any_of(
      candidate.impacts.begin(), candidate.impacts.end(), [&](const PointConditions& at) {
        return at.dataset == dataset && is_taken_away(candidate.model, mechanism, at);
      });
}

/// The series whose impacts are most like `experiment`, in ln d and then in ln V.
std::size_t most_like(const Observations& data, const NextExperiment& experiment) {
  std::size_t series = 0;
  double least = INFINITY;
  for (const Observation& point : data.points) {
    if (point.dataset != experiment.dataset) continue;
    const double away = 10.0 * std::abs(std::log(point.diameter / experiment.diameter)) +
                        std::abs(std::log(point.velocity / experiment.velocity));
    if (away < least) series = point.series;
    least = std::min(least, away);
  }
  return series;
}

bool has(const CandidateResult& rival, const std::string& id) {
  const auto& ids = rival.candidate.added;
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

class Search {
 public:
  explicit Search(const FitResult& base) : grid_(measurable_impacts(base)) {
    for (const PointConditions& at : grid_) {
      sd_.push_back(scatter_of_one_event(base, at.dataset, at.velocity));
    }
  }
  const std::vector<PointConditions>& grid() const { return grid_; }

  /// Where two curves differ most, put into `experiment`; false where a million impacts would not
  /// do.
  bool place(const Curve& a, const Curve& b, NextExperiment& experiment) const {
    double most = 0.0;
    for (std::size_t i = 0; i < grid_.size(); ++i) {
      const double difference = a[i] - b[i];
      if (!(std::abs(difference) / sd_[i] > most)) continue;
      most = std::abs(difference) / sd_[i];
      experiment.dataset = grid_[i].dataset;
      experiment.diameter = grid_[i].diameter;
      experiment.velocity = grid_[i].velocity;
      experiment.difference = difference;
    }
    const double each = 0.5 * most * most;
    if (!(each > 0.0) || wanted_log_odds / each > most_impacts) return false;
    experiment.events = std::max(1, static_cast<int>(std::ceil(wanted_log_odds / each)));
    experiment.log_odds = each * experiment.events;
    return true;
  }

 private:
  std::vector<PointConditions> grid_;
  std::vector<double> sd_;
};

/// Changes of a condition that take away what `one` has and `other` has not.
void add_changes(const Search& search, const CandidateResult& one, const CandidateResult& other,
                 const Curve& with, std::vector<NextExperiment>& all) {
  for (const std::string& id : one.candidate.added) {
    const Mechanism& mechanism = *find_mechanism(id);
    if (!mechanism.info.taken_away || has(other, id)) continue;
    NextExperiment change;
    change.kind = ExperimentKind::condition;
    change.one = one.candidate.name();
    change.other = other.candidate.name();
    const Curve rest =
        curve_of(one.candidate, without_mechanism(one.candidate.model, one.refit.theta, mechanism),
                 search.grid());
    if (!search.place(with, rest, change)) continue;
    if (was_taken_away(one.candidate, mechanism, change.dataset)) continue;
    change.condition = mechanism.info.taken_away->condition;
    change.value = mechanism.info.taken_away->value;
    change.doing = mechanism.info.taken_away->doing;
    all.push_back(std::move(change));
  }
}

int effort(const NextExperiment& experiment) {
  return experiment.events +
         (experiment.kind == ExperimentKind::condition ? effort_of_a_change : 0);
}

}  // namespace

std::vector<NextExperiment> next_experiments(const FitResult& base,
                                             const std::vector<const CandidateResult*>& rivals) {
  const Search search(base);
  const std::size_t count = std::min(most_compared, rivals.size());
  std::vector<Curve> curves;
  for (std::size_t k = 0; k < count; ++k) {
    curves.push_back(curve_of(rivals[k]->candidate, rivals[k]->refit.theta, search.grid()));
  }
  std::vector<NextExperiment> all;
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = a + 1; b < count; ++b) {
      NextExperiment points;
      points.one = rivals[a]->candidate.name();
      points.other = rivals[b]->candidate.name();
      if (search.place(curves[a], curves[b], points)) all.push_back(points);
      add_changes(search, *rivals[a], *rivals[b], curves[a], all);
      add_changes(search, *rivals[b], *rivals[a], curves[b], all);
    }
  }
  for (NextExperiment& next : all) next.series = most_like(base.data, next);
  std::stable_sort(all.begin(), all.end(), [](const NextExperiment& a, const NextExperiment& b) {
    return effort(a) < effort(b);
  });
  return all;
}

}  // namespace recoil
