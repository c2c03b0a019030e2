#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

/// e of the slowest rebound that is detected [1].
constexpr double least_restitution = 0.1;

struct Outliers {
  /// ((1 - q) e + q / 2)^2 for detected rebounds.
  template <class T>
  static void observe(Observed<T>& s, std::span<const T> own) {
    const T right = 1.0 - own[0];
    s.square = shifted_if_seen(right * right * s.square, 0.5 * own[0], T(least_restitution));
  }
};

}  // namespace

Mechanism outliers() {
  return make_mechanism<Outliers>({
      .id = "outliers",
      .title = "rebounds that were paired with the wrong impact",
      .kind = MechanismKind::measurement,
      .place = MechanismPlace::pairing,
      .formula = "a share q of all pairs is matched by chance and has e uniform between 0 and 1; "
                 "the mean is (1 - q) e + q / 2. Single outlying points belong to the noise "
                 "(Student's t), not to this mechanism",
      .source = "no published source",
      .fingerprint = "moves e towards 1/2 at all velocities: too low where e is high, too high "
                     "near capture; the same at all sizes and targets",
      .parameters = {{.name = "outlier_share",
                      .unit = "1",
                      .meaning = "q, share of wrong pairs",
                      .initial = 0.03,
                      .upper = 0.9,
                      .plausible = {0.0, 0.2,
                                    "a share above a fifth would show in every histogram"},
                      .starts = {0.1}}},
      .methods = {Method::velocimeter},
  });
}

}  // namespace recoil
