// What the generator promises: the wanted strength, the same digits for the same order, and no
// trace of the truth in what the diagnosis reads.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "validation/studies/diagnosis_answer.hpp"
#include "validation/synthetic/case.hpp"

namespace {

using namespace recoil::hidden;
namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

TEST(Generator, TheMisfitThatIsLeftIsTheOneThatWasWanted) {
  for (const char* effect : {"plastic_yield", "gas_film", "series_offset", "dip"}) {
    const Case made = make_case({"wall", {effect}, 10.0, 0});
    EXPECT_TRUE(made.reached) << effect;
    EXPECT_NEAR(made.refit.signal_to_noise, 10.0, 0.3) << effect;
    // The fitter sees the same: its chi2 on data without noise is the square. Velocities are
    // printed with three digits, which adds a little.
    const ScratchFolder scratch;
    const fs::path fit = write_case(without_noise(made), scratch.path());
    EXPECT_NEAR(misfit_left(fit, ""), 10.0, 0.6) << effect;
  }
}

TEST(Generator, NothingHiddenLeavesNothing) {
  for (const std::string_view design : design_ids()) {
    const Case made = make_case({std::string(design), {}, 0.0, 1});
    ASSERT_FALSE(made.points.empty()) << design;
    EXPECT_LT(made.refit.signal_to_noise, 1e-3) << design;
    const ScratchFolder scratch;
    const fs::path fit = write_case(without_noise(made), scratch.path());
    EXPECT_LT(misfit_left(fit, ""), 1.7) << design;
  }
}

// Drops from one height are off together, those from others by themselves.
TEST(Generator, DropsFromOneHeightShareItsError) {
  double together = 0.0;
  double alone = 0.0;
  int settings = 0;
  for (std::uint64_t k = 0; k < 20; ++k) {
    const Case made = make_case({"drops", {"settings"}, 0.0, k});
    ASSERT_EQ(made.points.size(), 60U);
    for (std::size_t first = 0; first < 60; first += 4) {
      double mean = 0.0;
      for (std::size_t i = first; i < first + 4; ++i) {
        ASSERT_EQ(made.points[i].setting, made.points[first].setting);
        mean += 0.25 * (made.readings[i] / made.points[i].restitution - 1.0);
      }
      together += mean * mean;
      const double apart =
          (made.readings[first] - made.readings[first + 1]) / made.points[first].sd;
      alone += 0.5 * apart * apart;
      ++settings;
    }
  }
  // Heights off by 4 %: velocities by 2 %, and e, the quotient of what came back by what was read,
  // by nearly as much.
  EXPECT_NEAR(std::sqrt(together / settings), 0.02, 0.003);
  EXPECT_NEAR(alone / settings, 1.0, 4.0 * std::sqrt(2.0 / settings));
}

// What is marked as misread is, and the others are not.
TEST(Generator, OddPointsAreThoseThatAreMisread) {
  int odd = 0;
  for (std::uint64_t k = 0; k < 20; ++k) {
    const Case made = make_case({"wall", {"odd_points"}, 0.0, k});
    for (std::size_t i = 0; i < made.points.size(); ++i) {
      const Point& p = made.points[i];
      const double away = std::abs(made.readings[i] - p.restitution) / p.sd;
      if (made.odd[i]) {
        EXPECT_GT(away, 2.0);
      } else {
        EXPECT_LT(away, 5.0);
      }
      odd += made.odd[i] ? 1 : 0;
    }
  }
  EXPECT_NEAR(odd / 1200.0, 0.06, 4.0 * std::sqrt(0.06 * 0.94 / 1200.0));
}

// Readings scatter about the expectation as their standard deviations say.
TEST(Generator, NoiseIsAsStated) {
  double sum = 0.0;
  int count = 0;
  for (const char* effect : {"outliers", "rebound_truncation", "series_offset"}) {
    const Case made = make_case({"wall", {effect}, 10.0, 2});
    ASSERT_FALSE(made.points.empty()) << effect;
    for (std::size_t i = 0; i < made.points.size(); ++i) {
      sum += std::pow((made.readings[i] - made.points[i].restitution) / made.points[i].sd, 2);
      ++count;
    }
  }
  EXPECT_NEAR(sum / count, 1.0, 4.0 * std::sqrt(2.0 / count));
}

// The same for spheres that differ: the mean of 40 survivors has the expectation's mean.
TEST(Generator, SurvivorsAreDrawnAsExpected) {
  const Case made = make_case({"wall-one", {"survivor_bias"}, 4.0, 0});
  ASSERT_FALSE(made.points.empty());
  double sum = 0.0;
  double square = 0.0;
  const double count = static_cast<double>(made.points.size());
  for (std::size_t i = 0; i < made.points.size(); ++i) {
    const double z = (made.readings[i] - made.points[i].restitution) / made.points[i].sd;
    sum += z;
    square += z * z;
  }
  EXPECT_NEAR(sum / count, 0.0, 4.0 / std::sqrt(count));
  EXPECT_NEAR(square / count, 1.0, 4.0 * std::sqrt(2.0 / count));
}

TEST(Generator, EqualOrdersGiveEqualDigits) {
  const CaseOrder order{"wall-batches", {"jkr_hysteresis"}, 5.0, 7};
  const ScratchFolder one;
  const ScratchFolder two;
  const fs::path first = write_case(make_case(order), one.path());
  const fs::path second = write_case(make_case(order), two.path());
  const std::string name = neutral_name(order);
  EXPECT_EQ(first.filename(), name + ".toml");
  EXPECT_EQ(text_of(first), text_of(second));
  EXPECT_EQ(text_of(one.path() / name / "points.csv"), text_of(two.path() / name / "points.csv"));
  CaseOrder other = order;
  other.index = 8;
  EXPECT_NE(neutral_name(other), name);
}

TEST(Generator, FilesSayNothingOfWhatIsHidden) {
  std::set<std::string> packages;
  for (const char* effect : {"plastic_yield", "series_offset", "wave"}) {
    const ScratchFolder scratch;
    const Case made = make_case({"wall-batches", {effect}, 10.0, 0});
    const fs::path fit = write_case(made, scratch.path());
    std::set<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(scratch.path())) {
      if (!entry.is_regular_file()) continue;
      files.insert(entry.path().filename().string());
      const std::string text = text_of(entry.path());
      for (const HiddenEffect& known : hidden_effects()) {
        EXPECT_EQ(text.find(known.id), std::string::npos) << entry.path() << " names " << known.id;
      }
    }
    EXPECT_EQ(files, (std::set<std::string>{"datapackage.json", "points.csv",
                                            neutral_name(made.order) + ".toml"}));
  }
}

// Of two effects each is as strong as it would be alone.
TEST(Generator, PairsHoldBoth) {
  const Case made = make_case({"wall", {"plastic_yield", "capillary"}, 8.0, 0});
  ASSERT_EQ(made.strengths.size(), 2U);
  EXPECT_TRUE(made.reached);
  EXPECT_GT(made.effects.contact.yield_pressure, 0.0);
  EXPECT_GT(made.effects.bridge_length, 0.0);
}

// Heights and times lie on their steps, and scatter as those who know of it say.
TEST(Generator, RoundedReadingsLieOnTheirSteps) {
  double square = 0.0;
  int count = 0;
  for (const Readout readout : {Readout::five_millimetres, Readout::frame}) {
    for (std::uint64_t k = 0; k < 8; ++k) {
      CaseOrder order{"balls", {}, 0.0, k};
      order.readout = readout;
      const Case made = make_case(order);
      ASSERT_FALSE(made.points.empty());
      for (std::size_t i = 0; i < made.points.size(); ++i) {
        const Point& p = made.points[i];
        const double e = made.readings[i];
        if (readout == Readout::five_millimetres) {
          const double steps = e * e * p.velocity * p.velocity / (2.0 * 9.81) / 5e-3;
          EXPECT_NEAR(steps, std::round(steps), 1e-6 * steps);
        } else {
          const double before = std::round(2.0 * p.velocity / 9.81 * 240.0);
          EXPECT_NEAR(e * before, std::round(e * before), 1e-6 * before);
        }
        if (k % 4 < 2) continue;
        square += std::pow((e - p.restitution) / p.sd, 2);
        ++count;
      }
    }
  }
  // Rounding of four drops from one height is the same: less is known of the mean than it seems.
  EXPECT_NEAR(square / count, 1.0, 0.3);
}

TEST(Generator, WhatNatureDoesNotHaveIsNotReached) {
  // Organic spheres radiate a ten-thousandth of their energy.
  EXPECT_FALSE(make_case({"wall", {"elastic_waves"}, 5.0, 0}).reached);
}

}  // namespace
