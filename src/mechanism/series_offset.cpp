#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

/// e of the slowest rebound that is detected [1].
constexpr double lowest_seen = 0.1;

struct SeriesOffset {
  template <class T>
  static void observe(Observed<T>& s, std::span<const T> own) {
    s.square = shifted_if_seen(s.square, own[0], T(lowest_seen));
  }
};

}  // namespace

Mechanism series_offset() {
  return make_mechanism<SeriesOffset>({
      .id = "series_offset",
      .title = "each series has a constant error of its own",
      .kind = MechanismKind::measurement,
      .place = MechanismPlace::batch,
      .formula = "e is read as e + o, with one offset o for each series",
      .source = "a batch effect (day, adjustment, humidity); no published source",
      .fingerprint = "the residuals of one series have the same sign at all velocities. With one "
                     "size per series it absorbs part of any effect of size",
      .parameters = {{.name = "series_offset",
                      .unit = "1",
                      .meaning = "o, error of e in this series",
                      .lower = -0.5,
                      .upper = 0.5,
                      .plausible = {-0.1, 0.1, "an error of e above 0.1 would be noticed"},
                      .per_series = true}},
  });
}

}  // namespace recoil
