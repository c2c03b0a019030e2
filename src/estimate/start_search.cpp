#include "estimate/start_search.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "estimate/impact_problem.hpp"

namespace recoil {
namespace {

// Two sums of squares are the same within this relative difference, or within `least_chi2`.
constexpr double same_chi2 = 1e-3;
constexpr double least_chi2 = 1e-6;

// With more points than `many_points`, the descents from the starts use 250 to 374 of them: a rough
// answer is enough to compare starts, and only the last steps need all points.
constexpr std::size_t many_points = 500;
constexpr std::size_t searched_of_many = 250;

/// Adds `first` with the damping factors multiplied by 0.1, 1 and 10 in all combinations: capture
/// and strong damping create flat and non-convex regions around the minimum.
void add_dampings(const ImpactModel& model, const std::vector<double>& first,
                  std::vector<std::vector<double>>& starts) {
  for (const double hertz : {0.1, 1.0, 10.0}) {
    for (const double adhesion : {0.1, 1.0, 10.0}) {
      if (hertz == 1.0 && adhesion == 1.0) continue;
      std::vector<double> start = first;
      bool moved = false;
      for (std::size_t j = 0; j < start.size(); ++j) {
        const ParameterSlot& slot = model.slots[j];
        if (!slot.free || !slot.parameter->is_damping()) continue;
        const double factor =
            slot.parameter->role == ParameterRole::hertz_damping ? hertz : adhesion;
        start[j] = std::clamp(start[j] * factor, slot.lower, slot.upper);
        moved = moved || start[j] != first[j];
      }
      if (moved) starts.push_back(std::move(start));
    }
  }
}

/// The stated start, with other dampings; the same around the dampings of the catalogue if a stated
/// one differs from these by more than a factor of ten; then the starts that the catalogue of
/// mechanisms lists, one parameter at a time.
std::vector<std::vector<double>> starting_points(const ImpactModel& model,
                                                 const std::vector<double>& first, bool several) {
  std::vector<std::vector<double>> starts = {first};
  if (!several) return starts;
  add_dampings(model, first, starts);
  std::vector<double> usual = first;
  bool far = false;
  for (std::size_t j = 0; j < first.size(); ++j) {
    const ParameterSlot& slot = model.slots[j];
    if (!slot.free || !slot.parameter->is_damping()) continue;
    usual[j] = std::clamp(slot.parameter->initial, slot.lower, slot.upper);
    far = far || !(first[j] <= 10.0 * usual[j] && usual[j] <= 10.0 * first[j]);
  }
  if (far) {
    starts.push_back(usual);
    add_dampings(model, usual, starts);
  }
  for (std::size_t j = 0; j < first.size(); ++j) {
    const ParameterSlot& slot = model.slots[j];
    if (!slot.free) continue;
    for (const double value : slot.parameter->starts) {
      if (value < slot.lower || value > slot.upper || value == first[j]) continue;
      starts.push_back(first);
      starts.back()[j] = value;
    }
  }
  return starts;
}

/// Every n-th point, sorted by dataset, diameter and velocity.
std::vector<std::size_t> spread_part(const std::vector<Observation>& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) {
    return std::tuple(points[i].dataset, points[i].diameter, points[i].velocity, i);
  };
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  std::vector<std::size_t> part;
  const std::size_t stride = points.size() / searched_of_many;
  for (std::size_t k = stride / 2; k < order.size(); k += stride) part.push_back(order[k]);
  return part;
}

/// The points that the descents from the starts use; nullopt for all. Until the scatter of the
/// impacts is known, a mean of survivors lies far above the curve, so points with rebounds and
/// captures are left to `reweighted_fit` if the other points suffice.
std::optional<Observations> searched_part(const Observations& data, std::ptrdiff_t free_count) {
  const std::vector<bool> mixed = among_captures(data.points);
  std::ptrdiff_t rebounds = 0;
  for (std::size_t i = 0; i < mixed.size(); ++i) {
    if (!mixed[i] && !data.points[i].censored) ++rebounds;
  }
  const bool leave_mixed =
      std::find(mixed.begin(), mixed.end(), true) != mixed.end() && rebounds > free_count;
  const bool many = data.points.size() > many_points;
  if (!leave_mixed && !many) return std::nullopt;
  std::vector<std::size_t> used;
  if (many) {
    used = spread_part(data.points);
  } else {
    used.resize(data.points.size());
    std::iota(used.begin(), used.end(), std::size_t{0});
  }
  if (leave_mixed) std::erase_if(used, [&](std::size_t i) { return mixed[i]; });
  return data.subset(used);
}

/// Do two values of a parameter differ by more than a tenth of its standard error, or by more than
/// a thousandth of its `size` if it has none?
bool differ(double one, double other, double std_error, double size) {
  return std::abs(one - other) > (std_error > 0.0 ? 0.1 * std_error : 1e-3 * size);
}

bool ends_elsewhere(const LeastSquaresResult& run, const LeastSquaresResult& best) {
  const std::size_t p = run.theta.size();
  for (std::size_t j = 0; j < p; ++j) {
    const double error = best.covariance.empty() ? 0.0 : std::sqrt(best.covariance[j * p + j]);
    if (differ(run.theta[j], best.theta[j], error, std::abs(best.theta[j]))) return true;
  }
  return false;
}

/// Continues descents that reached the iteration limit with a smaller sum of squares than every
/// finished descent: by box_descent, as long as the sum decreases.
void finish_promising(const LeastSquaresProblem& problem, LeastSquaresOptions options,
                      std::vector<StartSummary>& starts, std::vector<StartLead>& ended) {
  constexpr int most_descents = 5;
  double least = INFINITY;
  for (const StartLead& lead : ended) least = std::min(least, lead.run.sum_of_squares);
  options.strategies = {Strategy::box_descent};
  for (std::size_t k = 0; k < starts.size(); ++k) {
    StartSummary& start = starts[k];
    for (int round = 0; start.ending == DescentEnd::limit && round < most_descents; ++round) {
      if (!(start.chi2 < least)) break;
      LeastSquaresResult run = minimise(problem, start.end, options);
      if (run.end == DescentEnd::no_answer || !(run.sum_of_squares < start.chi2 || run.ended()))
        break;
      start = {start.start, run.theta, run.sum_of_squares, run.end, run.message};
      if (!run.ended()) continue;
      least = std::min(least, run.sum_of_squares);
      ended.push_back({k, std::move(run)});
    }
  }
}

}  // namespace

StartSearch search_from_starts(const ImpactModel& model, const Observations& data,
                               const std::vector<double>& first, bool several,
                               LeastSquaresOptions options) {
  StartSearch search;
  const std::optional<Observations> part = searched_part(data, model.free_count());
  const Observations& seen = part ? *part : data;
  search.points = seen.points.size();
  search.sampled = data.points.size() > many_points;
  const Weights weights = first_weights(seen);
  const auto predictor = std::make_shared<PointPredictor>(model, seen.conditions());
  const LeastSquaresProblem problem = impact_problem(model, seen, weights, predictor);
  options.finish = false;  // only the best run is refined
  std::vector<StartLead> ended;
  for (const std::vector<double>& start : starting_points(model, first, several)) {
    LeastSquaresResult run = minimise(problem, start, options);
    search.starts.push_back({start, run.theta, run.sum_of_squares, run.end, run.message});
    if (run.ended()) ended.push_back({search.starts.size() - 1, std::move(run)});
  }
  finish_promising(problem, options, search.starts, ended);
  search.handovers = predictor->handovers();
  if (ended.empty()) return search;
  const auto best =
      std::min_element(ended.begin(), ended.end(), [](const StartLead& a, const StartLead& b) {
        return a.run.sum_of_squares < b.run.sum_of_squares;
      });
  std::iter_swap(ended.begin(), best);
  search.leads.push_back(std::move(ended.front()));
  if (!search.sampled) return search;
  // If the sums of squares over all points differ by D on average, a sample's difference has the
  // standard deviation 2 sqrt(D). A minimum that is worse over all points is ahead by this much in
  // the sample only if chance exceeds seven of these.
  constexpr double telling = 50.0;
  const double least = search.leads.front().run.sum_of_squares;
  const double noise = std::max(1.0, least / static_cast<double>(problem.residual_count));
  for (std::size_t k = 1; k < ended.size(); ++k) {
    const LeastSquaresResult& run = ended[k].run;
    if (run.end == DescentEnd::flat || run.sum_of_squares > least + telling * noise) continue;
    const bool is_new =
        std::all_of(search.leads.begin(), search.leads.end(),
                    [&](const StartLead& lead) { return ends_elsewhere(run, lead.run); });
    if (is_new) search.leads.push_back(std::move(ended[k]));
  }
  return search;
}

void compare_starts(std::vector<StartSummary>& starts, std::size_t best_start,
                    const std::vector<double>& std_error) {
  const StartSummary& best = starts[best_start];
  for (std::size_t k = 0; k < starts.size(); ++k) {
    StartSummary& start = starts[k];
    if (start.ending == DescentEnd::limit || start.ending == DescentEnd::no_answer) continue;
    if (k == best_start) {
      start.outcome = StartOutcome::best;
    } else if (start.ending == DescentEnd::flat) {
      start.outcome = StartOutcome::flat;
    } else if (start.chi2 > best.chi2 * (1.0 + same_chi2) + least_chi2) {
      start.outcome = StartOutcome::worse;
    } else {
      for (std::size_t j = 0; j < start.end.size(); ++j) {
        const double size = std::max(std::abs(best.end[j]), std::abs(start.start[j]));
        if (differ(start.end[j], best.end[j], std_error[j], size)) start.differing.push_back(j);
      }
      start.outcome = start.differing.empty() ? StartOutcome::same : StartOutcome::tie;
    }
  }
}

}  // namespace recoil
