// The pairing against simulated streams of which every row's origin is known.
#include "experiment/pairing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "experiment/flight.hpp"
#include "validation/studies/pairing_score.hpp"
#include "validation/synthetic/event_stream.hpp"

namespace {

using namespace recoil;

/// One sphere by hand: down at 1 m/s, up at 0.5 m/s, from a plane 1 mm above the surface.
std::vector<Passage> one_impact(double diameter_up = 49e-6) {
  // sqrt(1 + 0.0196133) - 1 = 0.00975902, sqrt(0.25 + 0.0196133) - 0.5 = 0.01924300; by g.
  const double time = (0.009759022 + 0.019243002) / 9.80665;
  return {{1.0, 1.0, 0.0, 49e-6, 0, 2}, {1.0 + time, -0.5, 0.0, diameter_up, 0, 3}};
}

TEST(Pairing, OneImpactByHand) {
  PairingOptions options;
  const PairingResult result = pair_passages(one_impact(), options);
  ASSERT_EQ(result.impacts.size(), 1U);
  EXPECT_FALSE(result.refined);
  EXPECT_DOUBLE_EQ(result.height, 1e-3);
  EXPECT_NEAR(result.impacts[0].incident, 1.009759022, 1e-8);
  EXPECT_NEAR(result.impacts[0].rebound, 0.519243002, 1e-8);
  EXPECT_NEAR(result.impacts[0].restitution, 0.519243002 / 1.009759022, 1e-8);
  EXPECT_NEAR(result.impacts[0].diameter, 49e-6, 1e-12);
  EXPECT_TRUE(result.unpaired.empty());
  EXPECT_EQ(result.orphans, 0U);
}

TEST(Pairing, AnotherSizeIsNoPartner) {
  const PairingResult result = pair_passages(one_impact(65e-6), {});
  EXPECT_TRUE(result.impacts.empty());
  EXPECT_EQ(result.unpaired.size(), 1U);
  EXPECT_EQ(result.orphans, 1U);
}

TEST(Pairing, AnotherTimeOrAnotherRunIsNoPartner) {
  std::vector<Passage> late = one_impact();
  late[1].time += 0.002;
  EXPECT_TRUE(pair_passages(late, {}).impacts.empty());
  std::vector<Passage> elsewhere = one_impact();
  elsewhere[1].series = 1;
  EXPECT_TRUE(pair_passages(elsewhere, {}).impacts.empty());
}

TEST(Pairing, FasterThanItCameIsNoPartner) {
  std::vector<Passage> events = one_impact();
  events[0].velocity = 0.5;
  events[1].velocity = -1.0;
  EXPECT_TRUE(pair_passages(events, {}).impacts.empty());
}

/// A pair whose flight takes as long as from a plane at 1.15 mm, where its e is 1.49. At the height
/// of 1 mm that is stated, its e is 1.53.
TEST(Pairing, RestitutionIsLimitedAtTheHeightThatAllPairsShare) {
  constexpr double twice_g = 2.0 * 9.80665;
  const double down = 0.1;
  const double at_surface = std::sqrt(down * down + twice_g * 1.15e-3);
  const double up = std::sqrt(std::pow(1.49 * at_surface, 2) - twice_g * 1.15e-3);
  const double time = (at_surface - down + 1.49 * at_surface - up) / 9.80665;
  EXPECT_GT(up * up + twice_g * 1e-3, 1.5 * 1.5 * (down * down + twice_g * 1e-3));
  const std::vector<Passage> events = {{1.0, down, 0.0, 49e-6, 0, 2},
                                       {1.0 + time, -up, 0.0, 49e-6, 0, 3}};
  PairingOptions stated;
  EXPECT_TRUE(pair_passages(events, stated).impacts.empty());
  stated.height = 1.15e-3;
  const PairingResult there = pair_passages(events, stated);
  ASSERT_EQ(there.impacts.size(), 1U);
  EXPECT_NEAR(there.impacts[0].restitution, 1.49, 1e-9);
}

TEST(Pairing, AReturnIsASecondImpact) {
  std::vector<Passage> events = one_impact();
  const double back = events[1].time + 2.0 * 0.5 / 9.80665;
  events.push_back({back, 0.5, 0.0, 49e-6, 0, 4});
  const double time = (0.019243002 + 0.032160340) / 9.80665;  // up at 0.289 m/s
  events.push_back({back + time, -0.288764, 0.0, 49e-6, 0, 5});
  PairingResult result = pair_passages(events, {});
  ASSERT_EQ(result.impacts.size(), 2U);
  EXPECT_TRUE(result.impacts[0].used);
  EXPECT_EQ(result.impacts[1].number, 2);
  EXPECT_FALSE(result.impacts[1].used);
  PairingOptions all;
  all.keep_later = true;
  EXPECT_TRUE(pair_passages(events, all).impacts[1].used);
}

TEST(Pairing, AReturnInAnotherRunIsAFirstImpact) {
  std::vector<Passage> events = one_impact();
  const double back = events[1].time + 2.0 * 0.5 / 9.80665;
  events.push_back({back, 0.5, 0.0, 49e-6, 1, 4});
  const double time = (0.019243002 + 0.032160340) / 9.80665;  // up at 0.289 m/s
  events.push_back({back + time, -0.288764, 0.0, 49e-6, 1, 5});
  const PairingResult result = pair_passages(events, {});
  ASSERT_EQ(result.impacts.size(), 2U);
  EXPECT_EQ(result.impacts[1].number, 1);
  EXPECT_TRUE(result.impacts[1].used);
}

TEST(Pairing, NothingIsNoError) {
  EXPECT_TRUE(pair_passages({}, {}).impacts.empty());
  EXPECT_EQ(pair_passages({{1.0, 1.0, 0.0, 49e-6, 0, 2}}, {}).unpaired.size(), 1U);
}

TEST(Pairing, ThresholdAndAngleSelect) {
  std::vector<Passage> events = one_impact();
  events[1].tangential = 0.1;  // atan(0.1 / 0.5192) = 10.9 degrees
  PairingOptions options;
  EXPECT_NEAR(pair_passages(events, options).impacts[0].angle, std::atan(0.1 / 0.519243), 1e-6);
  options.angle = 8.0 * M_PI / 180.0;
  EXPECT_FALSE(pair_passages(events, options).impacts[0].used);
  options.angle = 12.0 * M_PI / 180.0;
  EXPECT_TRUE(pair_passages(events, options).impacts[0].used);
  options.threshold = 1.001;
  EXPECT_FALSE(pair_passages(events, options).impacts[0].used);
}

struct Paired {
  stream::Stream stream;
  PassageTable table;
  PairingResult result;
  stream::Score score;
};

Paired run(const stream::Design& design, const PairingOptions& options = {}) {
  Paired done;
  done.stream = stream::simulate(design);
  done.table = stream::read(done.stream);
  done.result = pair_passages(done.table.passages, options);
  done.score = stream::score(done.stream, done.table, done.result);
  return done;
}

TEST(PairingOfStreams, PureAndEfficientAtAnyNumber) {
  for (const std::size_t spheres : {40UL, 400UL, 4000UL}) {
    for (const double rate : {1.0, 10.0, 50.0}) {
      stream::Design design;
      design.spheres = spheres;
      design.rate = rate;
      design.seed = spheres;
      const stream::Score score = run(design).score;
      EXPECT_GE(score.purity(), 0.99) << spheres << " spheres at " << rate;
      EXPECT_GE(score.first_purity(), 0.99) << spheres << " spheres at " << rate;
      EXPECT_GE(score.efficiency(), 0.95) << spheres << " spheres at " << rate;
      EXPECT_GT(score.possible, spheres / 2) << "the stream itself seems broken";
    }
  }
}

TEST(PairingOfStreams, OverlappingFlightsStayPure) {
  stream::Design design;
  design.spheres = 5000;
  design.rate = 3000.0;
  const Paired crowded = run(design);
  EXPECT_GT(crowded.stream.crowding, 4.0) << "flights in the air at once";
  EXPECT_GE(crowded.score.purity(), 0.992);  // reports/pairing.md; times alone do worse
}

TEST(PairingOfStreams, PurityIsEstimatedWithoutTheTruth) {
  stream::Design design;
  design.spheres = 4000;
  design.rate = 10000.0;
  const Paired crowded = run(design);
  const double wrong = static_cast<double>(crowded.score.reported - crowded.score.right);
  const double estimated =
      (1.0 - crowded.result.purity()) * static_cast<double>(crowded.score.reported);
  EXPECT_GT(wrong, 25.0);
  EXPECT_NEAR(estimated, wrong, 0.15 * wrong + 2.0 * std::sqrt(wrong));
}

TEST(PairingOfStreams, HeightIsRefinedWithinItsError) {
  double squares = 0.0;
  int n = 0;
  for (const double estimate : {0.75e-3, 1e-3, 1.5e-3}) {
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
      stream::Design design;
      design.spheres = 800;
      design.seed = seed;
      PairingOptions options;
      options.height = estimate;
      const PairingResult result = run(design, options).result;
      ASSERT_TRUE(result.refined);
      const double pull = (result.height - design.probe_height) / result.height_sd;
      EXPECT_LT(std::abs(pull), 4.5) << estimate << " " << seed;
      squares += pull * pull;
      ++n;
    }
  }
  EXPECT_LT(squares / n, 3.0);
  EXPECT_GT(squares / n, 0.1) << "an error that is far too large";
}

TEST(PairingOfStreams, RestitutionsAreThoseOfTheSpheres) {
  // Without noise every restitution is the one that was drawn: 0.95 sqrt(1 - (V*/V)^2).
  stream::Design design;
  design.spheres = 500;
  design.velocity_sd = design.volume_sd = design.diameter_noise = design.restitution_sd = 0.0;
  design.damaged = design.duplicated = 0.0;
  PairingOptions options;
  options.height = design.probe_height;
  options.refine = false;
  const Paired exact = run(design, options);
  std::size_t compared = 0;
  for (const Impact& impact : exact.result.impacts) {
    const double capture = 0.9 * std::pow(impact.diameter / 20e-6, -1.289);
    const double ratio = capture / impact.incident;
    if (ratio > 0.9) continue;
    EXPECT_NEAR(impact.restitution, 0.95 * std::sqrt(1.0 - ratio * ratio), 4e-4);
    ++compared;
  }
  EXPECT_GT(compared, 300U);
}

TEST(PairingOfStreams, SecondImpactsAreKeptOutOrAnalysed) {
  stream::Design design;
  design.drop_heights = {0.04};
  design.return_time = 1.0;  // most come back
  const Paired kept_out = run(design);
  EXPECT_GE(kept_out.score.first_purity(), 0.99);
  PairingOptions options;
  options.keep_later = true;
  const Paired analysed = run(design, options);
  EXPECT_GT(analysed.score.reported, 2 * kept_out.score.reported);
  EXPECT_GE(analysed.score.purity(), 0.99);
}

TEST(PairingOfStreams, ScatterOfAPreciseVelocimeterIsFound) {
  for (const double velocity_sd : {0.001, 0.003, 0.01}) {
    stream::Design design;
    design.velocity_sd = velocity_sd;
    design.volume_sd = 1e-6;
    design.rate = 100.0;
    const PairingResult result = run(design).result;
    EXPECT_NEAR(result.velocity_spread / velocity_sd, 1.0, 0.1);
    // The narrower the tolerance of a return, the fewer are found by chance, of some 610.
    EXPECT_LT(result.expected_returns, velocity_sd < 0.005 ? 5.0 : 40.0) << velocity_sd;
  }
}

/// What the simulated instrument writes down of slow rebounds: the study rests on it.
TEST(Streams, AReboundIsSeenWhereItClearsTheProbeVolume) {
  for (const auto& [deviations, seen] : {std::pair{3.6, false}, std::pair{4.4, true}}) {
    stream::Design design;
    design.spheres = 50;
    design.drop_heights = {0.02};
    design.capture_at_20um = 1e-12;
    design.restitution_sd = 0.0;
    design.seen = 1.0;
    design.damaged = design.duplicated = 0.0;
    // They rise to e^2 times the drop height: so many deviations of the volume above its middle.
    design.top_restitution =
        std::sqrt((design.probe_height + deviations * design.volume_sd) / design.drop_heights[0]);
    const PassageTable table = stream::read(stream::simulate(design));
    const auto up = std::count_if(table.passages.begin(), table.passages.end(),
                                  [](const Passage& p) { return p.velocity < 0.0; });
    EXPECT_EQ(up, seen ? 50 : 0) << deviations;
  }
}

TEST(PairingOfStreams, WithoutUsableReturnsItSaysSo) {
  stream::Design design;
  design.return_time = 1e-6;
  const Paired run_once = run(design);
  EXPECT_GE(run_once.score.efficiency(), 0.99);
  EXPECT_LT(run_once.result.returns, 10U);
}

TEST(PairingOfStreams, OrderOfTheRowsDoesNotMatter) {
  stream::Design design;
  design.spheres = 300;
  const Paired straight = run(design);
  std::vector<std::string> lines;
  std::string text = straight.stream.csv;
  for (std::size_t at = text.find('\n') + 1; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    lines.push_back(text.substr(at, end - at + 1));
    at = end + 1;
  }
  std::string reversed = text.substr(0, text.find('\n') + 1);
  for (auto it = lines.rbegin(); it != lines.rend(); ++it) reversed += *it;
  stream::Stream other = straight.stream;
  other.csv = reversed;
  const PassageTable table = stream::read(other);
  const PairingResult result = pair_passages(table.passages, {});
  ASSERT_EQ(result.impacts.size(), straight.result.impacts.size());
  EXPECT_EQ(result.height, straight.result.height);
  for (std::size_t i = 0; i < result.impacts.size(); ++i) {
    EXPECT_EQ(result.impacts[i].restitution, straight.result.impacts[i].restitution);
  }
}

TEST(PairingOfStreams, CountsOfTheFile) {
  stream::Design design;
  design.duplicated = 0.05;
  design.damaged = 0.05;
  const Paired run_bad = run(design);
  EXPECT_EQ(run_bad.table.damaged, run_bad.stream.damaged);
  EXPECT_EQ(run_bad.table.duplicated, run_bad.stream.duplicated);
  EXPECT_GE(run_bad.score.purity(), 0.99);
  EXPECT_GE(run_bad.score.efficiency(), 0.95);
}

TEST(PairingOfStreams, TooCrowdedIsAnAnswer) {
  std::vector<Passage> events;
  for (int i = 0; i < 4000; ++i) {
    events.push_back({i * 1e-6, i % 2 == 0 ? 1.0 : -0.01, 0.0, 49e-6, 0, i});
  }
  for (int i = 0; i < 40000; ++i) events.push_back({0.012 + i * 1e-7, -0.02, 0.0, 49e-6, 0, i});
  EXPECT_THROW(pair_passages(events, {}), ComputationError);
}

}  // namespace
