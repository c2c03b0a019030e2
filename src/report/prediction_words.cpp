#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "report/format.hpp"
#include "report/prediction.hpp"
#include "report/text_blocks.hpp"
#include "report/words_dataset.hpp"

namespace recoil {
namespace {

constexpr std::size_t rows_printed = 12;

std::string value_text(const BandedValue& at, int decimals) {
  if (!at.value) return "-";
  std::string text = fmt::format("{:.{}f}", *at.value, decimals);
  if (at.lower && at.upper) {
    text += fmt::format(" [{:.{}f}, {:.{}f}]", *at.lower, decimals, *at.upper, decimals);
  }
  return text;
}

std::string percent_text(const BandedValue& at) {
  return at.value ? fmt::format("{:.0f} %", 100.0 * *at.value) : "-";
}

/// The largest difference between two averages where both are, and where [m/s].
struct Difference {
  double value = 0.0;
  double velocity = 0.0;
};
Difference largest_difference(const PolydispersePrediction& mixture) {
  Difference largest;
  for (std::size_t k = 0; k < mixture.velocity.size(); ++k) {
    const auto& low = mixture.average[0][k].value;
    const auto& high = mixture.average[2][k].value;
    if (low && high && *high - *low > largest.value) {
      largest = {*high - *low, mixture.velocity[k]};
    }
  }
  return largest;
}

std::string miss_words(const CurveMiss& miss) {
  return miss.rmse ? fmt::format("{} ({} points)", digits(*miss.rmse, 2), miss.points)
                   : std::string("no point has a prediction");
}

}  // namespace

std::vector<std::string> mixture_words(const Analysis& analysis,
                                       const PolydispersePrediction& mixture) {
  std::vector<std::string> words;
  words.push_back(
      fmt::format("{} bins from {} to {} um in {} sizes, d10 = {} um; capture below {} m/s at the "
                  "lower end and {} m/s "
                  "at the upper",
                  mixture.sizes.bins.size(), diameter_text(mixture.sizes.smallest),
                  diameter_text(mixture.sizes.largest), mixture.simulated,
                  diameter_text(mixture.sizes.mean_diameter()),
                  number(mixture.size_curves.front().capture_velocity, 3),
                  number(mixture.size_curves.back().capture_velocity, 3)));
  if (!mixture.sizes.description.empty()) {
    words.push_back("the size distribution: " + mixture.sizes.description);
  }
  const Difference apart = largest_difference(mixture);
  if (apart.value > 0.0) {
    words.push_back(
        fmt::format("the three conventions differ most at {} m/s, by {} in e; the paper does not "
                    "say which of "
                    "them its weighted average is",
                    number(apart.velocity, 3), digits(apart.value, 2)));
  }
  std::vector<std::pair<double, std::string>> misses;
  for (std::size_t c = 0; c < all_conventions.size(); ++c) {
    if (mixture.miss[c].rmse) {
      misses.emplace_back(*mixture.miss[c].rmse, words_of(all_conventions[c]));
    }
  }
  if (!misses.empty() && mixture.miss_single.rmse) {
    const auto best = std::min_element(misses.begin(), misses.end());
    words.push_back(
        fmt::format("of the three averages the points of {} ({}) lie closest to that with {}: {} "
                    "in e (root mean "
                    "square), where d10 alone misses by {}",
                    analysis.datasets[mixture.dataset].id,
                    to_string(analysis.datasets[mixture.dataset].provenance), best->second,
                    digits(best->first, 2), digits(*mixture.miss_single.rmse, 2)));
  }
  words.emplace_back(
      "the parameters are those of the fit, which took every point as spheres of the one "
      "diameter "
      "that the dataset states; nothing was fitted to the mixture");
  return words;
}

std::string text_prediction(const Analysis& analysis, const PolydispersePrediction& mixture) {
  const Dataset& dataset = analysis.datasets[mixture.dataset];
  Blocks blocks;
  blocks.open("Mixture", fmt::format(" {} with the parameters of {}", mixture.sizes.file.string(),
                                     analysis.spec.id));
  blocks.item("dataset", fmt::format("{}, {}: {}", dataset.id, to_string(dataset.provenance),
                                     provenance_sentence(dataset.provenance)));
  if (!mixture.sizes.provenance.empty()) {
    blocks.item("sizes are a", mixture.sizes.provenance);
  }
  blocks.item(
      "measuring plane",
      fmt::format("{} mm above the surface: rebounds below {} m/s are not seen",
                  number(mixture.probe_height / units::mm, 3), number(mixture.slowest_seen, 3)));
  for (const std::string& sentence : mixture_words(analysis, mixture)) {
    blocks.entry(as_sentence(sentence));
  }
  blocks.open("Weighted averages", mixture.replicates > 0
                                       ? fmt::format(" with pointwise {} bands of {} replicates",
                                                     percent(mixture.level), mixture.replicates)
                                       : std::string(" without bands: no bootstrap"));
  blocks.line("A: captured spheres count as e = 0;  B: captured spheres left out;");
  blocks.line("C: left out also when too slow to be seen");
  blocks.line(fmt::format("{:>8} {:>6}  {:<21}{:<21}{:<21}{:>8} {:>7}", "V [m/s]", "d10", "A", "B",
                          "C", "captured", "unseen"));
  const std::size_t stride = std::max<std::size_t>(1, mixture.velocity.size() / rows_printed);
  for (std::size_t k = 0; k < mixture.velocity.size(); k += stride) {
    const double e = mixture.size_curves[1].restitution[k];
    blocks.line(fmt::format(
        "{:>8} {:>6}  {:<21}{:<21}{:<21}{:>8} {:>7}", digits(mixture.velocity[k], 3),
        std::isfinite(e) ? fmt::format("{:.3f}", e) : "-", value_text(mixture.average[0][k], 3),
        value_text(mixture.average[1][k], 3), value_text(mixture.average[2][k], 3),
        percent_text(mixture.captured[k]), percent_text(mixture.unseen[k])));
  }
  blocks.open("Distance of the points", " from each curve, root mean square of e");
  blocks.item("d10 alone", miss_words(mixture.miss_single));
  blocks.item("A", miss_words(mixture.miss[0]));
  blocks.item("B", miss_words(mixture.miss[1]));
  blocks.item("C", miss_words(mixture.miss[2]));
  return blocks.take();
}

}  // namespace recoil
