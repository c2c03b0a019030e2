#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

/// e of the border between seen and not seen.
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
      .title = "each series is off by a constant of its own",
      .kind = MechanismKind::measurement,
      .place = MechanismPlace::batch,
      .formula = "e is read as e + o, o one number for each series",
      .source = "a batch effect (day, adjustment, humidity); no further source",
      .fingerprint = "the residuals of one series have the same sign at all velocities. With one "
                     "size per series it takes up part of any effect of size",
      .parameters = {{.name = "series_offset",
                      .unit = "1",
                      .meaning = "o, by which e is read too high in this series",
                      .lower = -0.5,
                      .upper = 0.5,
                      .plausible = {-0.1, 0.1,
                                    "a batch that is off by more than 0.1 in e would be seen"},
                      .per_series = true}},
  });
}

}  // namespace recoil
