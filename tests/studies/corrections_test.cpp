// What leaving a correction out does, on events made by hand: the shift of e by formula, the count
// of the captured, the place of second impacts.
#include "validation/studies/corrections.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace recoil;
namespace fs = std::filesystem;

constexpr double g = 9.80665;
constexpr double height = 1e-3;   // [m]
constexpr double e_first = 0.8;   // of first impacts, at any velocity
constexpr double e_second = 0.6;  // of what comes back
constexpr int spheres = 60;       // per velocity

/// Spheres one after the other, without errors but for +-1 % of e.
class Stream {
 public:
  void sphere(double velocity, double restitution, bool again) {
    now_ += 5.0;
    double hits = now_;
    pass(hits, velocity, 1.0);
    if (restitution == 0.0) return;
    pass(hits, restitution * velocity, -1.0);
    if (!again) return;
    hits += 2.0 * restitution * velocity / g;
    pass(hits, restitution * velocity, 1.0);
    pass(hits, e_second * restitution * velocity, -1.0);
  }
  const std::vector<Passage>& events() const { return events_; }

 private:
  void pass(double hits, double speed, double direction) {
    const double plane = std::sqrt(speed * speed - 2.0 * g * height);
    const double apart = direction * (speed - plane) / g;
    events_.push_back({hits - apart, direction * plane, 0.0, 75e-6, 0, 0});
  }
  double now_ = 0.0;
  std::vector<Passage> events_;
};

struct Shipped {
  fs::path root = RECOIL_SOURCE_DIR;
  FitSpec spec = load_fit(root / "fits/li1999-sst125-silicon.toml");
  Dataset dataset = load_dataset(root / "datasets/li1999-sst125-silicon");
};

CorrectionStudy study_of(int captured, bool again) {
  KnownPassages known;
  known.velocities = {0.45, 1.0, 3.0};
  Stream stream;
  for (const double velocity : known.velocities) {
    for (int i = 0; i < spheres; ++i) {
      const bool returns = again && i % 3 == 0;
      const double e = e_first * (returns ? 1.0 : i % 2 == 0 ? 1.01 : 0.99);
      stream.sphere(velocity, e, returns);
    }
    for (int i = 0; i < captured && velocity < 0.5; ++i) stream.sphere(velocity, 0.0, false);
  }
  known.table.passages = stream.events();
  known.table.series = {"run"};
  known.table.file = "events.csv";
  known.diameter = 75e-6;
  known.restitution = [](double, double) { return e_first; };
  const Shipped shipped;
  AverageOptions averaging;
  averaging.per_bin = spheres;
  return study_corrections(shipped.spec, shipped.dataset, known, {}, averaging);
}

const CorrectionRow& row_of(const CorrectionStudy& study, Correction left_out) {
  return study.rows.at(static_cast<std::size_t>(left_out));
}

TEST(CorrectionStudy, ThePlaneShiftsRestitutionAsFreeFlightDoes) {
  const CorrectionStudy study = study_of(0, false);
  ASSERT_EQ(study.rows.size(), 5U);
  const CorrectionRow& base = row_of(study, Correction::none_left_out);
  EXPECT_EQ(base.points, 3U);
  EXPECT_NEAR(base.error_slow.value(), 0.0, 1e-4);
  EXPECT_NEAR(base.error_fast.value(), 0.0, 1e-4);
  const CorrectionRow& plane = row_of(study, Correction::probe_plane);
  for (std::size_t k = 0; k < study.velocities.size(); ++k) {
    const double v = study.velocities[k];
    double expected = 0.0;  // of both halves of the spheres
    for (const double e : {1.01 * e_first, 0.99 * e_first}) {
      expected += 0.5 * std::sqrt((e * e * v * v - 2.0 * g * height) / (v * v - 2.0 * g * height));
    }
    EXPECT_NEAR(plane.error.at(k).value(), expected - e_first, 1e-4) << v;
    EXPECT_NEAR(base.error.at(k).value(), 0.0, 1e-4) << v;
  }
  EXPECT_LT(plane.error_slow.value(), -0.02);
}

TEST(CorrectionStudy, CapturesAreCountedOrNot) {
  const CorrectionStudy study = study_of(30, false);
  const CorrectionRow& base = row_of(study, Correction::none_left_out);
  EXPECT_EQ(base.captured, 30U);
  const CorrectionRow& survivors = row_of(study, Correction::survivors);
  EXPECT_EQ(survivors.captured, 0U);
  EXPECT_EQ(survivors.error_slow, base.error_slow) << "the mean of the rebounds is the same";
  ASSERT_TRUE(base.usable && survivors.usable);
  EXPECT_GT(std::abs(base.capture_velocity / survivors.capture_velocity - 1.0), 0.05)
      << "a third captured and none captured cannot mean the same";
}

TEST(CorrectionStudy, SecondImpactsAreKeptOutOrLeftIn) {
  const CorrectionStudy study = study_of(0, true);
  const CorrectionRow& base = row_of(study, Correction::none_left_out);
  EXPECT_EQ(base.points, 3U);
  EXPECT_NEAR(base.error_slow.value(), 0.0, 1e-4);
  const CorrectionRow& later = row_of(study, Correction::second_impacts);
  // 20 of each velocity come back at 0.8 V with e = 0.6: bins of their own.
  EXPECT_EQ(later.points, 6U);
  // Below 0.7 m/s: 60 first impacts right, 20 with 0.6 instead of 0.8 from 0.45 m/s.
  EXPECT_NEAR(later.error_slow.value(), 20.0 * (e_second - e_first) / 80.0, 1e-3);
  const CorrectionRow& none = row_of(study, Correction::all_left_out);
  EXPECT_LT(none.error_slow.value(), later.error_slow.value()) << "and the plane on top";
}

TEST(CorrectionStudy, OnlyTheRowsThatAreWanted) {
  const Shipped shipped;
  KnownPassages known;
  known.velocities = {1.0, 3.0};
  known.diameter = 75e-6;
  known.restitution = [](double, double) { return e_first; };
  Stream stream;
  for (int i = 0; i < 10; ++i) {
    stream.sphere(1.0, i % 2 == 0 ? 0.7 : 0.75, false);
    stream.sphere(3.0, i % 2 == 0 ? 0.8 : 0.85, false);
  }
  known.table.passages = stream.events();
  known.table.series = {"run"};
  const std::array<Correction, 1> wanted = {Correction::probe_plane};
  const CorrectionStudy study =
      study_corrections(shipped.spec, shipped.dataset, known, {}, {}, wanted);
  ASSERT_EQ(study.rows.size(), 1U);
  EXPECT_EQ(study.rows[0].left_out, Correction::probe_plane);
}

}  // namespace
