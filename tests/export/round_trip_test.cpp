// From a fit to the same restitution in programs that share no code with recoil. A program that is
// not installed fails these tests; ./run test installs them.
#include "round_trip.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>

#include "jkr_by_time.hpp"
#include "support/hostile_names.hpp"

namespace {

const std::string kRing = R"(dataset = "data"
[parameters]
C_H = { initial = 3e-3, bounds = [0, 1] }
C_A = { initial = 3e-2, bounds = [0, 10] }
f0 = { free = false }
)";

/// Nothing is fitted: these values.
std::string fixed(const std::string& law, const std::string& phase, const std::string& c_a,
                  const std::string& adhesion) {
  return "dataset = \"data\"\n[model]\nadhesion = \"" + law + "\"\nadhesion_damping_phase = \"" +
         phase +
         "\"\n[parameters]\nC_H = { initial = 4e-3, free = true }\nC_A = { initial = " + c_a +
         ", free = false }\n" + adhesion + "\n";
}

/// Where the two differ by more than `allowed` is a failure.
template <class Engine>
void expect_the_same(const RoundTrip& trip, double allowed, const Engine& engine) {
  for (const double v : RoundTrip::velocities) {
    EXPECT_NEAR(engine(v), trip.expected(v), allowed) << "at " << v << " m/s";
  }
}

TEST(RoundTrip, LammpsHoldsTheRingLawAndItsCapture) {
  const RoundTrip trip(kRing);
  const std::string said = trip.write("lammps", "out");
  EXPECT_NE(said.find("capture velocity is kept"), std::string::npos) << said;
  ASSERT_EQ(trip.expected(RoundTrip::velocities.front()), 0.0);
  expect_the_same(trip, 1e-4, [&](double v) { return trip.lammps("out", v); });
}

TEST(RoundTrip, HalfTheTimeStepHalvesTheErrorInLammps) {
  const RoundTrip trip(kRing);
  trip.write("lammps", "out");
  const double dt = number_after(trip.place().read("out/impact.lammps"), "variable dt index ");
  // A step that begins or ends outside the contact adds a little of its own: the mean over some
  // velocities has less of it.
  const auto error_at = [&](double step) {
    double sum = 0.0;
    for (const double v : {1.7, 2.4, 5.0, 8.0, 12.0, 25.0}) {
      sum += trip.lammps("out", v, fmt::format("{}", step)) - trip.expected(v);
    }
    return sum / 6.0;
  };
  const double coarse = error_at(4.0 * dt);
  const double middle = error_at(2.0 * dt);
  const double stated = error_at(dt);
  EXPECT_GT(std::abs(stated), 1e-7);  // far above the last of the nine digits
  EXPECT_NEAR(coarse / middle, 2.0, 0.4);
  EXPECT_NEAR(middle / stated, 2.0, 0.4);
}

TEST(RoundTrip, LammpsHoldsTheOtherLawsOfAdhesionAndBothPhases) {
  for (const char* phase : {"rebound", "both"}) {
    const RoundTrip jkr(fixed("jkr", phase, "0.03", "W = { free = false }"));
    jkr.write("lammps", "out");
    expect_the_same(jkr, 1e-4, [&](double v) { return jkr.lammps("out", v); });
    const RoundTrip dmt(fixed("dmt", phase, "0.2", "W = { free = false }"));
    dmt.write("lammps", "out");
    expect_the_same(dmt, 1e-4, [&](double v) { return dmt.lammps("out", v); });
  }
}

TEST(RoundTrip, LammpsHoldsADashpotOfTheBulk) {
  const RoundTrip trip(R"(dataset = "data"
[model]
mechanisms = ["bulk_viscoelastic"]
[parameters]
C_H = { initial = 3e-3, bounds = [0, 1] }
C_A = { initial = 0.01, free = false }
f0 = { free = false }
bulk_relaxation = { initial = 1e-10, free = false }
)");
  const std::string said = trip.write("lammps", "out");
  EXPECT_NE(said.find("force law is the model's own"), std::string::npos) << said;
  expect_the_same(trip, 1e-4, [&](double v) { return trip.lammps("out", v); });
}

/// The largest |delta e| that the export printed holds, to what the time step leaves and a wall
/// that is only nearly touched at the start.
template <class Engine>
void expect_the_stated_error(const RoundTrip& trip, const std::string& said, const Engine& engine) {
  const double largest = number_after(said, "the largest error is ");
  double found = 0.0;
  for (const double v : RoundTrip::velocities) {
    found = std::max(found, std::abs(engine(v) - trip.expected(v)));
  }
  EXPECT_LE(found, largest + 1e-3) << said;
  EXPECT_GT(found, 0.3 * largest) << said;
}

TEST(RoundTrip, LiggghtsHasTheConstantRestitutionAndItsStatedError) {
  const RoundTrip trip(kRing);
  const std::string said = trip.write("liggghts", "out");
  EXPECT_NE(said.find("capture velocity is LOST"), std::string::npos) << said;
  const double constant = number_after(said, "restitution e = ");
  for (const double v : RoundTrip::velocities) {
    EXPECT_NEAR(trip.liggghts("out", v), constant, 1e-3);
  }
  expect_the_stated_error(trip, said, [&](double v) { return trip.liggghts("out", v); });
}

// Headings name the files that the values are from.
TEST(RoundTrip, HostileNamesRunNothingInLammpsAndLiggghts) {
  const RoundTrip trip(kRing);
  const support::Workplace& place = trip.place();
  const double e = trip.expected(2.4);
  for (const std::string& name : support::hostile_names()) {
    if (name.find('/') != std::string::npos) continue;
    std::filesystem::create_directory(place / name);
    std::filesystem::copy(place / "data", place / name / "data");
    std::filesystem::copy_file(place / "fit.toml", place / name / "fit.toml");
    for (const char* target : {"lammps", "liggghts"}) {
      const support::Outcome run =
          place.run({"export", "./" + name + "/fit.toml", "--parameters", "fitted/fit.json", "--to",
                     target, "--diameter", "4", "--velocity", "0.5,25", "--out", "out"});
      ASSERT_EQ(run.status, 0) << name << run.err;
    }
    EXPECT_NEAR(trip.lammps("out", 2.4), e, 1e-4) << name;
    EXPECT_GT(trip.liggghts("out", 2.4), 0.0) << name;
    EXPECT_FALSE(place.has("PWNED")) << name;
    std::filesystem::remove_all(place / name);
  }
}

TEST(RoundTrip, TwoLikeBodiesInLiggghtsAreAsStiffAsTheTwoUnlike) {
  const RoundTrip trip(kRing);
  trip.write("liggghts", "out");
  // By hand: 1 / E* = (1 - 0.35^2) / 2.56 GPa + (1 - 0.28^2) / 131 GPa, and E* = E / (2 (1 -
  // nu^2)).
  const double E =
      number_after(trip.place().read("out/impact.liggghts"), "youngsModulus peratomtype ");
  EXPECT_NEAR(E, 2.0 * (1.0 - 0.25 * 0.25) * 2.858707e9, 1e6);
}

/// R, m, E*, eta and gamma of a stock file, from "diameter D density RHO" and "jkr E eta 0 gamma"
/// in um, us and pg.
JkrByTime jkr_in(const std::string& file) {
  const double R = 0.5e-6 * number_after(file, "set atom 1 diameter ");
  const double density = 1e3 * number_after(file, " density ");
  std::istringstream words(file.substr(file.find("pair_coeff * * jkr ") + 19));
  double E = 0.0;
  double eta = 0.0;
  double nu = 1.0;
  double gamma = 0.0;
  words >> E >> eta >> nu >> gamma;
  EXPECT_EQ(nu, 0.0);
  return {R, 4.0 / 3.0 * M_PI * R * R * R * density, 0.5e3 * E, 1e12 * eta, 1e-3 * gamma};
}

TEST(RoundTrip, TheStockJkrOfLammpsHasItsStatedErrorAndCapture) {
  const RoundTrip trip(kRing);
  const std::string said = trip.write("lammps", "lammps", "0.5,25", {"--stock"});
  expect_the_stated_error(trip, said, [&](double v) { return trip.lammps("lammps", v); });
  const JkrByTime contact = jkr_in(trip.place().read("lammps/impact.lammps"));
  for (const double v : RoundTrip::velocities) {
    EXPECT_NEAR(trip.lammps("lammps", v), contact.restitution(v), 1e-3) << v;
  }
  const double capture = number_after(said, "Captures are kept, with V* = ");
  EXPECT_EQ(trip.lammps("lammps", 0.99 * capture), 0.0);
  EXPECT_GT(trip.lammps("lammps", 1.01 * capture), 0.0);
}

TEST(RoundTrip, WithoutAdhesionTheStockModelOfLammpsIsHertzWithItsStatedError) {
  const RoundTrip trip("dataset = \"data\"\n[parameters]\nC_H = { initial = 3e-3 }\n", false);
  const std::string said = trip.write("lammps", "lammps", "0.5,25", {"--stock"});
  EXPECT_NE(trip.place().read("lammps/impact.lammps").find("hertz/material"), std::string::npos);
  expect_the_stated_error(trip, said, [&](double v) { return trip.lammps("lammps", v); });
}

TEST(RoundTrip, ARefittedForceHasItsStatedErrorAndCapture) {
  const RoundTrip trip(R"(dataset = "data"
[model]
mechanisms = ["plastic_yield"]
[parameters]
C_H = { initial = 3e-3, bounds = [0, 1] }
C_A = { initial = 0.03, free = false }
f0 = { free = false }
yield_pressure = { initial = 400e6, free = false }
)");
  const std::string said = trip.write("lammps", "out");
  EXPECT_NE(said.find("plastic_yield is no force"), std::string::npos) << said;
  EXPECT_LT(number_after(said, "same e up to "), 0.05);
  expect_the_stated_error(trip, said, [&](double v) { return trip.lammps("out", v); });
  const double capture = number_after(said, "Captures are kept, with V* = ");
  EXPECT_EQ(trip.lammps("out", 0.99 * capture), 0.0);
  EXPECT_GT(trip.lammps("out", 1.01 * capture), 0.0);
}

}  // namespace
