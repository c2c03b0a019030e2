#include "validation/truth/elastoplastic_truth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "core/numerics.hpp"

namespace recoil {
namespace {

using std::numbers::pi;

/// JKR's contact of one curvature, in the contact radius.
struct JkrContact {
  double E, w, curvature;

  double closes() const { return std::cbrt(2.0 * pi * w * curvature * curvature / E); }
  double pull(double a) const { return std::sqrt(8.0 * pi * w * E * a * a * a); }
  double force(double a) const { return 4.0 * E * a * a * a / (3.0 * curvature) - pull(a); }
  /// Work against the force from alpha = 0 to a.
  double work(double a) const { return stored(a) - stored(closes()); }
  /// Work from alpha = 0 to the tear at fixed grips, a^3 = pi w R^2 / (8 E).
  double parting() const { return work(closes() / std::cbrt(16.0)); }
  double approach_slope(double a) const {
    return 2.0 * a / curvature - (a > 0.0 ? std::sqrt(0.5 * pi * w / (E * a)) : 0.0);
  }

 private:
  double stored(double a) const {
    return 8.0 / 15.0 * E * std::pow(a, 5) / (curvature * curvature) -
           4.0 / 3.0 * std::sqrt(2.0 * pi * w * E) * std::pow(a, 3.5) / curvature + pi * w * a * a;
  }
};

/// Loading with no pressure above p_Y.
class Loading {
 public:
  explicit Loading(const ElastoplasticContact& c)
      : jkr_{c.reduced_modulus, c.adhesion_energy, c.radius}, limit_(c.yield_pressure) {
    begins_ = jkr_.closes();
    yields_ = std::numeric_limits<double>::infinity();
    if (!std::isfinite(limit_)) return;
    // The pressure in the centre rises with a: it is 0 at a0 / 4^(1/3) and below p_Y + its pull's
    // share further out.
    const double bare = pi * c.radius * limit_ / (2.0 * c.reduced_modulus);
    const double most = 2.0 * (bare + begins_);
    yields_ = find_root([&](double a) { return centre(a) / limit_ - 1.0; }, 0.5 * bare, most);
  }

  const JkrContact& elastic() const { return jkr_; }
  bool yielded(double a) const { return a > yields_; }
  /// Energy of JKR's contact that flow has taken at a.
  double lost(double a) const {
    const double from = std::max(yields_, begins_);
    if (!(a > from)) return 0.0;
    // In the root of a the integrand is a polynomial where there is no adhesion.
    static const std::vector<QuadratureNode> nodes = gauss_legendre(16);
    const double width = std::sqrt(a) - std::sqrt(from);
    double sum = 0.0;
    for (const QuadratureNode& node : nodes) {
      const double root = std::sqrt(from) + width * node.at;
      const double at = root * root;
      sum += node.weight * missing(at) * jkr_.approach_slope(at) * 2.0 * root;
    }
    return sum * width;
  }
  double work(double a) const { return jkr_.work(a) - lost(a); }
  double force(double a) const { return jkr_.force(a) - (yielded(a) ? missing(a) : 0.0); }

 private:
  double rise(double a) const { return 2.0 * jkr_.E * a / (pi * jkr_.curvature); }
  double fall(double a) const {
    return a > 0.0 ? std::sqrt(2.0 * jkr_.w * jkr_.E / (pi * a)) : 0.0;
  }
  double centre(double a) const { return rise(a) - fall(a); }
  /// What is above p_Y, integrated over 2 pi rho d rho = -2 pi a^2 s ds from the s where it begins.
  double missing(double a) const {
    const double up = rise(a);
    const double down = fall(a);
    const double s = (limit_ + std::sqrt(limit_ * limit_ + 4.0 * up * down)) / (2.0 * up);
    if (!(s < 1.0)) return 0.0;
    return 2.0 * pi * a * a *
           (up * (1.0 - s * s * s) / 3.0 - down * (1.0 - s) - 0.5 * limit_ * (1.0 - s * s));
  }

  JkrContact jkr_;
  double limit_;
  double begins_ = 0.0;  ///< a at alpha = 0
  double yields_ = 0.0;  ///< a at which the centre bears p_Y
};

/// a* [m].
double widest_contact(const Loading& loading, const ElastoplasticContact& c, double energy) {
  // Without adhesion and yield; both widen it.
  double low = loading.elastic().closes();
  double high =
      std::pow(15.0 * c.radius * c.radius * energy / (8.0 * c.reduced_modulus), 0.2) + low;
  constexpr int most = 200;  // times 1.5 is a factor of 10^35
  for (int i = 0; !(loading.force(high) > 0.0 && loading.work(high) >= energy); ++i) {
    if (i == most) throw ComputationError("an impact of the truth has no turning point");
    low = high;
    high *= 1.5;
  }
  return find_root([&](double a) { return loading.work(a) / energy - 1.0; }, low, high);
}

}  // namespace

double jkr_parting_work(double adhesion_energy, double radius, double reduced_modulus) {
  return JkrContact{reduced_modulus, adhesion_energy, radius}.parting();
}

ElastoplasticImpact elastoplastic_impact(const ElastoplasticContact& contact, double velocity) {
  const double E = contact.reduced_modulus;
  const double energy = 0.5 * contact.mass * velocity * velocity;
  const Loading loading(contact);
  const double a = widest_contact(loading, contact, energy);

  JkrContact unloading = loading.elastic();
  double recovered = energy;
  if (loading.yielded(a)) {
    unloading.curvature = 4.0 * E * a * a * a / (3.0 * (loading.force(a) + unloading.pull(a)));
    recovered = unloading.work(a);
  }
  const double parting = unloading.parting();
  const double peeling = contact.hysteresis * pi * a * a;

  ElastoplasticImpact impact;
  impact.restitution_squared = (recovered - parting - peeling) / energy;
  impact.rebounded = impact.restitution_squared > 0.0;
  impact.restitution = impact.rebounded ? std::sqrt(impact.restitution_squared) : 0.0;
  impact.contact_radius = a;
  impact.unloading_radius = unloading.curvature;
  impact.plastic_share = 1.0 - recovered / energy;
  return impact;
}

}  // namespace recoil
