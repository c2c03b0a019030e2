#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

struct SizeLaw {
  template <class T>
  static void before(Encounter<T>& e, std::span<const T> own) {
    const T ratio = e.radius() / relative_radius(e.at->reference_diameter, e.at->surface_diameter);
    e.adhesion_force *= exponential((own[0] - 1.0 / 3.0) * logarithm(ratio));
  }
};

}  // namespace

Mechanism size_law() {
  return make_mechanism<SizeLaw>({
      .id = "size_law",
      .title = "adhesion with another power of the size",
      .kind = MechanismKind::description,
      .place = MechanismPlace::size,
      .formula = "f0 ~ r^p",
      .source = "generalises equation 12 of Li, X., Dunn, P. F. & Brach, R. M. (1999), p = 1/3",
      .fingerprint = "absorbs any dependence on size; a rate-independent loss (JKR, area "
                     "hysteresis) gives p near 5/9. It is a description, not a cause",
      .parameters = {{.name = "size_exponent",
                      .unit = "1",
                      .meaning = "p, exponent of f0 in the radius",
                      .null_value = 1.0 / 3.0,
                      .initial = 1.0 / 3.0,
                      .lower = -2.0,
                      .upper = 4.0,
                      .plausible = {1.0 / 3.0, 1.0 / 3.0, "equation 12 has 1/3"},
                      .starts = {0.55, 0.1}}},
  });
}

}  // namespace recoil
