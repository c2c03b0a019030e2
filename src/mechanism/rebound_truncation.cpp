#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

/// A point with a smaller share of detected rebounds is not measured [1].
constexpr double fewest_seen = 1e-3;
constexpr double none_seen = 1e-12;

struct ReboundTruncation {
  template <class T>
  static void observe(Observed<T>& s, std::span<const T> own) {
    const T slowest = own[0] / s.velocity;
    const T missing = s.square - slowest * slowest;
    if (!(value_of(s.square) > 0.0)) {
      s.square = missing;
      return;
    }
    const T e = sqrt(s.square);
    const T width = own[1] * e;
    const T away = (e - slowest) / width;
    const T seen = normal_probability(away);
    if (value_of(seen) < none_seen) {
      s.square = missing;
      return;
    }
    const T mean = e + width * normal_density(away) / seen;
    const T share = seen * (1.0 + fewest_seen) / (seen + fewest_seen);
    s.square = missing + share * (mean * mean - missing);
  }
};

}  // namespace

Mechanism rebound_truncation() {
  return make_mechanism<ReboundTruncation>({
      .id = "rebound_truncation",
      .title = "slow rebounds that are not detected",
      .kind = MechanismKind::measurement,
      .place = MechanismPlace::selection,
      .formula =
          "rebounds slower than V_min do not reach the measuring plane; e scatters by the fraction "
          "s from impact to impact, and a point is the mean of the detected rebounds",
      .source = "a beam at the height h detects no rebound slower than (2 g h)^(1/2); the mean of "
                "a truncated normal variable",
      .fingerprint = "near capture e stays above V_min / V, and slow rebounds look like captures; "
                     "V_min is the same for all sizes and targets",
      .parameters =
          {{.name = "slowest_rebound",
            .unit = "m/s",
            .meaning = "V_min, slowest rebound that is detected",
            .initial = 0.1,
            .upper = 50.0,
            .plausible = {0.0, 0.5,
                          "a beam 1 mm above the surface misses rebounds slower than 0.14 m/s"},
            .starts = {0.02, 0.3}},
           {.name = "event_scatter",
            .unit = "1",
            .meaning = "s, relative standard deviation of e from impact to impact",
            .null_value = 0.1,
            .initial = 0.1,
            .lower = 0.005,
            .upper = 0.3,
            .plausible = {0.01, 0.3, "0.05 to 0.1 is usual, more just above capture"},
            .free = false,
            .is_scatter_of_rebounds = true}},
      .methods = {Method::velocimeter, Method::video},
  });
}

}  // namespace recoil
