#include "uncertainty/locate_failures.hpp"

#include <algorithm>
#include <cmath>

#include "uncertainty/refit.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_suspects = 3;
constexpr int most_compared = 999;      // replicates that say what is usual
constexpr double clearly_unlike = 3.0;  // standard errors of a mean

/// Sums of a point's disturbance over some replicates.
struct Moments {
  double count = 0.0, sum = 0.0, square = 0.0;

  void add(double value) {
    count += 1.0;
    sum += value;
    square += value * value;
  }
  double mean() const { return count > 0.0 ? sum / count : 0.0; }
  double sd() const {
    return count > 1.0 ? std::sqrt(std::max(0.0, (square - sum * sum / count) / (count - 1.0)))
                       : 0.0;
  }
};

}  // namespace

FailedReplicates locate_failures(const ResamplingPlan& plan, std::uint64_t seed, int replicates,
                                 std::vector<std::uint64_t> index) {
  FailedReplicates result;
  result.index = std::move(index);
  if (result.index.empty()) return result;
  const std::size_t n = plan.fitted->data.points.size();
  std::vector<Moments> failed(n);
  std::vector<Moments> usual(n);
  const auto add = [&](std::uint64_t replicate, std::vector<Moments>& to) {
    const std::vector<double> values = disturbance(plan, seed, replicate);
    for (std::size_t i = 0; i < n; ++i) to[i].add(values[i]);
  };
  for (std::size_t k = 0; k < result.index.size() && k < most_compared; ++k) {
    add(result.index[k], failed);
  }
  for (int r = 0; r < std::min(replicates, most_compared); ++r) {
    const auto own = static_cast<std::uint64_t>(r);
    if (!std::binary_search(result.index.begin(), result.index.end(), own)) add(own, usual);
  }
  std::vector<std::pair<double, FailedReplicates::Suspect>> ranked;
  for (std::size_t i = 0; i < n; ++i) {
    const double sd = usual[i].sd();
    if (!(sd > 0.0)) continue;
    const double distance =
        std::abs(failed[i].mean() - usual[i].mean()) * std::sqrt(failed[i].count) / sd;
    ranked.push_back(
        {distance, {i, failed[i].mean(), usual[i].mean(), distance >= clearly_unlike}});
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  for (std::size_t k = 0; k < std::min(ranked.size(), most_suspects); ++k) {
    result.suspects.push_back(ranked[k].second);
  }
  // The first failure once more, for what the minimiser has to say.
  Observations sample = plan.fitted->data;
  resample(plan, seed, result.index.front(), sample);
  const LeastSquaresResult again = refit(plan.fitted->model, sample, plan.fitted->theta);
  result.undetermined = again.ended();
  if (!again.ended()) result.message = again.message;
  return result;
}

}  // namespace recoil
