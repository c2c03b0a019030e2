#include "estimate/law_error.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace recoil {
namespace {

constexpr double left_out = 1e-3;    // part of the variance of g that its functions may miss
constexpr double reach_below = 1.0;  // reach of g below the slowest point, in ln V

}  // namespace

LawError::LawError(const LawErrorPrior& prior, std::span<const PointConditions> points)
    : prior_(prior) {
  for (const PointConditions& point : points) {
    sizes_.push_back(
        {point.dataset, std::log(point.diameter), std::log(point.velocity) - reach_below});
  }
  std::ranges::sort(sizes_, {}, [](const Size& one) { return std::pair(one.key(), one.slowest); });
  const auto same = [](const Size& a, const Size& b) { return a.key() == b.key(); };
  sizes_.erase(std::unique(sizes_.begin(), sizes_.end(), same), sizes_.end());
  std::vector<Place> places;
  for (std::size_t k = 0; k < sizes_.size(); ++k) {
    for (const double by : {0.0, 0.5 * reach_below}) {
      places.push_back({sizes_[k].slowest + by, sizes_[k].log_diameter, k});
    }
  }
  for (const PointConditions& point : points) places.push_back(place_of(point));
  std::vector<double> unexplained(places.size(), 1.0);
  std::vector<std::vector<double>> columns;
  for (;;) {
    const auto most = std::max_element(unexplained.begin(), unexplained.end());
    if (!(*most > left_out)) break;
    const auto pivot = static_cast<std::size_t>(most - unexplained.begin());
    const double root = std::sqrt(*most);
    std::vector<double> column(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      double rest = correlation(places[i], places[pivot]);
      for (const std::vector<double>& other : columns) rest -= other[pivot] * other[i];
      column[i] = rest / root;
      unexplained[i] -= column[i] * column[i];
    }
    unexplained[pivot] = 0.0;
    columns.push_back(std::move(column));
    pivots_.push_back(places[pivot]);
  }
  const std::size_t count = pivots_.size();
  factor_.assign(count * count, 0.0);
  for (std::size_t row = 0; row < count; ++row) {
    for (std::size_t k = 0; k <= row; ++k) {
      double rest = correlation(pivots_[row], pivots_[k]);
      for (std::size_t j = 0; j < k; ++j) rest -= factor_[row * count + j] * factor_[k * count + j];
      factor_[row * count + k] = k < row ? rest / factor_[k * count + k] : std::sqrt(rest);
    }
  }
}

LawError::Place LawError::place_of(const PointConditions& at) const {
  const double log_diameter = std::log(at.diameter);
  const auto distance = [&](const Size& size) {
    return size.dataset == at.dataset ? std::abs(size.log_diameter - log_diameter) : INFINITY;
  };
  auto nearest =
      std::ranges::lower_bound(sizes_, std::pair(at.dataset, log_diameter), {}, &Size::key);
  if (nearest == sizes_.end() ||
      (nearest != sizes_.begin() && distance(*std::prev(nearest)) < distance(*nearest))) {
    --nearest;
  }
  return {std::max(std::log(at.velocity), nearest->slowest), log_diameter,
          static_cast<std::size_t>(nearest - sizes_.begin())};
}

double LawError::correlation(const Place& a, const Place& b) const {
  if (prior_.by_size && a.size != b.size) return 0.0;
  const double in_velocity = (a.log_velocity - b.log_velocity) / prior_.length;
  const double in_size = prior_.by_size ? 0.0 : (a.log_diameter - b.log_diameter) / length_in_size;
  return std::exp(-0.5 * (in_velocity * in_velocity + in_size * in_size));
}

void LawError::functions(const PointConditions& at, std::span<double> phi) const {
  const Place place = place_of(at);
  for (std::size_t k = 0; k < pivots_.size(); ++k) {
    double rest = correlation(place, pivots_[k]);
    const double* row = &factor_[k * pivots_.size()];
    for (std::size_t j = 0; j < k; ++j) rest -= row[j] * phi[j];
    phi[k] = rest / row[k];
  }
  for (double& value : phi) value *= prior_.size * decay(place);
}

double LawError::decay(const Place& at) const {
  if (!prior_.at_capture) return 1.0;
  constexpr double most = 4.0;
  const double slowest = sizes_[at.size].slowest + reach_below;
  return std::min(most, std::exp(2.0 * (slowest - at.log_velocity)));
}

double LawError::operator()(const PointConditions& at, std::span<const double> z) const {
  std::vector<double> phi(count());
  functions(at, phi);
  double sum = 0.0;
  for (std::size_t k = 0; k < z.size(); ++k) sum += z[k] * phi[k];
  return sum;
}

}  // namespace recoil
