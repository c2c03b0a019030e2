#include <algorithm>
#include <cassert>

#include "mechanism/mechanism.hpp"
#include "mechanism/survivors_mean.hpp"

namespace recoil {
namespace {

/// ln(d / mean) of the sphere at z for a standard deviation s, with the distribution that the
/// dataset states, or else a truncated lognormal one.
template <class T>
T logarithm_at(const MixedSizes& sizes, const T& s, double z) {
  if (!sizes.mixed()) return s * (cut_scale() * z) - cut_lognormal_mean(s);
  const auto& nodes = spread_positions();
  const auto node = std::ranges::find(nodes, z);
  assert(node != nodes.end());
  return s * sizes.shape[static_cast<std::size_t>(node - nodes.begin())];
}

struct Polydispersity {
  template <class T>
  static void vary(Encounter<T>& e, std::span<const T> own, double z) {
    e.resize(exponential(logarithm_at(e.at->sizes, own[0], z)));
  }
};

}  // namespace

Mechanism polydispersity() {
  return make_mechanism<Polydispersity>({
      .id = "polydispersity",
      .title = "spheres of many sizes in one point",
      .cause = "unequal impacts averaged in one point",
      .kind = MechanismKind::measurement,
      .place = MechanismPlace::spread,
      .formula =
          "diameters are lognormal with the stated one as their mean (by number) and s as the "
          "standard deviation of ln d, truncated at 2.62 s; a point is the mean e of rebounds",
      .source = "Hinds, W. C., Aerosol Technology (lognormal sizes)",
      .fingerprint = "rounds off e(V) near capture, where only the large spheres rebound: just "
                     "above V* of the mean sphere, e is too high",
      .parameters =
          {{.name = "size_spread",
            .unit = "1",
            .meaning = "standard deviation of ln(diameter)",
            .initial = 0.1,
            .upper = 1.0,
            .plausible = {0.0, 0.5,
                          "calibration spheres have 0.01 to 0.05, sieved powders about 0.3"},
            .starts = {0.02, 0.3},
            .stated_by = {none_where(Condition::sizes_equal)}}},
      .mixes_sizes = true,
      .taken_away =
          TakenAway{Condition::sizes_equal, 1.0, "take spheres that were measured one by one"},
  });
}

}  // namespace recoil
