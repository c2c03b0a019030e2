#include "coverage/simulated_impacts.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/units.hpp"

namespace recoil {

TrueCurve::TrueCurve(const std::function<double(double)>& restitution, double capture,
                     double fastest)
    : capture_(capture), fastest_(fastest) {
  constexpr std::size_t nodes = 400;
  std::vector<double> x, y;
  for (std::size_t i = 0; i < nodes; ++i) {
    const double part = static_cast<double>(i) / (nodes - 1.0);
    const double v = capture * std::pow(fastest / capture, part * part);  // denser near capture
    const double back = i == 0 ? 0.0 : v * restitution(v);
    x.push_back(v * v);
    y.push_back(back * back);
  }
  const std::shared_ptr<gsl_spline> spline(gsl_spline_alloc(gsl_interp_steffen, nodes),
                                           gsl_spline_free);
  gsl_spline_init(spline.get(), x.data(), y.data(), nodes);
  spline_ = spline;
}

double TrueCurve::operator()(double v) const {
  if (v <= capture_) return 0.0;
  v = std::min(v, fastest_);
  return std::sqrt(std::max(0.0, gsl_spline_eval(spline_.get(), v * v, nullptr))) / v;
}

TrueMixture::TrueMixture(const std::function<double(double)>& restitution,
                         const MeasuredSizes& sizes, double mean, double velocity) {
  constexpr int parts = 5;  // of a bin
  const double slowest = std::sqrt(2.0 * standard_gravity * sizes.probe_height.value_or(0.0));
  const double scale = mean / sizes.mean_diameter();
  double below = 0.0;
  for (const SizeBin& bin : spread_within_bins(sizes.bins, parts)) {
    below += bin.weight / sizes.total();
    below_.push_back(below);
    const double e = restitution(scale * bin.diameter);
    restitution_.push_back(e * velocity > slowest ? e : 0.0);
  }
}

double TrueMixture::draw(RandomStream& random) const {
  const auto at = std::lower_bound(below_.begin(), below_.end() - 1, random.uniform());
  return restitution_[static_cast<std::size_t>(at - below_.begin())];
}

CountedImpacts count_impacts(int events, const std::function<double()>& restitution) {
  CountedImpacts found;
  double sum = 0.0;
  double squares = 0.0;
  for (int k = 0; k < events; ++k) {
    const double single = restitution();
    if (single == 0.0) ++found.captured;
    sum += single;
    squares += single * single;
  }
  const int back = events - found.captured;
  if (back == 0) return found;
  found.restitution = sum / back;
  if (back > 1) {
    found.variance_of_mean = std::max(0.0, squares - sum * found.restitution) / (back - 1.0) / back;
  }
  return found;
}

}  // namespace recoil
