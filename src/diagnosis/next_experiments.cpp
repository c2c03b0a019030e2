#include "diagnosis/next_experiments.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnosis/measurable.hpp"
#include "diagnosis/odds.hpp"
#include "diagnosis/predicted_spread.hpp"
#include "diagnosis/target_experiments.hpp"
#include "mechanism/catalogue.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_compared = 4;

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

/// ln of the odds that `count` impacts are expected to give the right one of two rivals, who
/// predict their mean with variances `one` and `other` (in those of one impact) and a difference of
/// `apart` (in its standard deviation): the smaller of the two divergences of Kullback & Leibler.
double expected_log_odds(double apart, double one, double other, double count) {
  const double a = one + 1.0 / count;
  const double b = other + 1.0 / count;
  const auto divergence = [&](double from, double to) {
    return 0.5 * (from / to - 1.0 - std::log(from / to) + apart * apart / to);
  };
  return std::min(divergence(a, b), divergence(b, a));
}

class Search {
 public:
  explicit Search(const SearchBase& base) : base_(base) {
    possible_.at = measurable_impacts(base.fitted);
    for (const PointConditions& at : possible_.at) {
      possible_.sd.push_back(scatter_of_one_event(base.fitted, at.dataset, at.velocity));
    }
  }

  PredictedSpread predicted(const CandidateResult& rival,
                            const Mechanism* without = nullptr) const {
    return predicted_spread(base_, rival, possible_, without);
  }

  /// Where the fewest impacts tell two predictions apart, put into `experiment`; false where a
  /// million would not do anywhere.
  bool place(const PredictedSpread& a, const PredictedSpread& b, NextExperiment& experiment) const {
    std::optional<int> fewest;
    for (std::size_t i = 0; i < possible_.at.size(); ++i) {
      const double difference = a.restitution[i] - b.restitution[i];
      const double apart = difference / possible_.sd[i];
      if (!std::isfinite(apart + a.variance[i] + b.variance[i])) continue;
      const auto odds = [&](double count) {
        return expected_log_odds(apart, a.variance[i], b.variance[i], count);
      };
      const auto count = fewest_impacts(odds, most_impacts);
      if (!count || (fewest && *count >= *fewest)) continue;
      fewest = count;
      experiment.dataset = possible_.at[i].dataset;
      experiment.diameter = possible_.at[i].diameter;
      experiment.velocity = possible_.at[i].velocity;
      experiment.difference = difference;
      experiment.events = *count;
      experiment.log_odds = odds(*count);
    }
    return fewest.has_value();
  }

 private:
  const SearchBase& base_;
  PossibleImpacts possible_;
};

/// Changes of a condition that take away what `one` has and `other` has not.
void add_changes(const Search& search, const CandidateResult& one, const CandidateResult& other,
                 const PredictedSpread& of_other, std::vector<NextExperiment>& all) {
  for (const std::string& id : one.candidate.added) {
    const Mechanism& mechanism = *find_mechanism(id);
    if (!mechanism.info.taken_away || has(other, id)) continue;
    NextExperiment change;
    change.kind = ExperimentKind::condition;
    change.one = one.candidate.name();
    change.other = other.candidate.name();
    if (!search.place(search.predicted(one, &mechanism), of_other, change)) continue;
    if (was_taken_away(one.candidate, mechanism, change.dataset)) continue;
    change.condition = mechanism.info.taken_away->condition;
    change.value = mechanism.info.taken_away->value;
    change.doing = mechanism.info.taken_away->doing;
    all.push_back(std::move(change));
  }
}

int effort(const NextExperiment& experiment) {
  switch (experiment.kind) {
    case ExperimentKind::points:
      return experiment.events;
    case ExperimentKind::condition:
      return experiment.events + effort_of_a_change;
    case ExperimentKind::target:
      return experiment.events + effort_of_a_target;
  }
  return experiment.events;
}

}  // namespace

std::vector<NextExperiment> next_experiments(const SearchBase& base,
                                             const std::vector<const CandidateResult*>& rivals) {
  const Search search(base);
  const std::size_t count = std::min(most_compared, rivals.size());
  const std::vector<const CandidateResult*> compared(
      rivals.begin(), rivals.begin() + static_cast<std::ptrdiff_t>(count));
  std::vector<PredictedSpread> predicted;
  for (std::size_t k = 0; k < count && count > 1; ++k) {
    predicted.push_back(search.predicted(*rivals[k]));
  }
  std::vector<NextExperiment> all = target_experiments(base, compared);
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = a + 1; b < count; ++b) {
      NextExperiment points;
      points.one = rivals[a]->candidate.name();
      points.other = rivals[b]->candidate.name();
      if (search.place(predicted[a], predicted[b], points)) all.push_back(points);
      add_changes(search, *rivals[a], *rivals[b], predicted[b], all);
      add_changes(search, *rivals[b], *rivals[a], predicted[a], all);
    }
  }
  for (NextExperiment& next : all) next.series = most_like(base.fitted.data, next);
  std::stable_sort(all.begin(), all.end(), [](const NextExperiment& a, const NextExperiment& b) {
    return effort(a) < effort(b);
  });
  return all;
}

}  // namespace recoil
