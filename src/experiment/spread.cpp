#include "experiment/spread.hpp"

#include <algorithm>
#include <numeric>

#include "core/statistics.hpp"

namespace recoil {

LocalSpread::LocalSpread(const std::vector<double>& x, const std::vector<double>& deviation,
                         double lowest, double highest) {
  constexpr std::size_t least = 60;
  constexpr std::size_t most_classes = 8;
  const std::size_t classes = std::clamp<std::size_t>(x.size() / least, 1, most_classes);
  std::vector<std::size_t> order(x.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return x[a] < x[b]; });
  for (std::size_t k = 0; k < classes; ++k) {
    const std::size_t begin = k * x.size() / classes;
    const std::size_t end = (k + 1) * x.size() / classes;
    std::vector<double> places;
    std::vector<double> values;
    for (std::size_t i = begin; i < end; ++i) {
      places.push_back(x[order[i]]);
      values.push_back(deviation[order[i]]);
    }
    x_.push_back(median(places));
    sd_.push_back(std::clamp(robust_sd(std::move(values)), lowest, highest));
  }
}

double LocalSpread::at(double x) const {
  if (x <= x_.front()) return sd_.front();
  if (x >= x_.back()) return sd_.back();
  const auto above = std::upper_bound(x_.begin(), x_.end(), x);
  const auto i = static_cast<std::size_t>(above - x_.begin());
  const double share = (x - x_[i - 1]) / (x_[i] - x_[i - 1]);
  return sd_[i - 1] + share * (sd_[i] - sd_[i - 1]);
}

double LocalSpread::largest() const { return *std::max_element(sd_.begin(), sd_.end()); }

}  // namespace recoil
