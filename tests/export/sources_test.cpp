// What is written for programs that cannot be had here, or are too large to be, run against
// stand-ins: of their headers on one sphere at an oblique wall, of their names on one that falls
// straight.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "round_trip.hpp"

namespace {

const std::string kCounted = "dataset = \"data\"\n[parameters]\nf0 = { free = false }\n";
const std::string kStubs = std::string(RECOIL_SOURCE_DIR) + "/tests/export/";

void expect_built(const std::vector<std::string>& command, const RoundTrip& trip) {
  const support::Outcome built = support::run_command(command, trip.place().path());
  ASSERT_EQ(built.status, 0) << built.err;
  EXPECT_EQ(built.err, "");
}

/// Both programs look the same table up: e within what the export says between its nodes.
void expect_the_fit(const RoundTrip& trip, const std::string& said, const std::string& moving,
                    const std::string& stuck) {
  const double allowed = number_after(said, "e is within ");
  ASSERT_LE(allowed, 1e-3);
  for (const double v : RoundTrip::velocities) {
    const std::vector<std::string> command = {trip.place().path() / "program", "4e-6",
                                              fmt::format("{}", v)};
    const double e = trip.run(command);
    const double expected = trip.expected(v);
    EXPECT_NEAR(e, expected, 1.5 * allowed + 1e-6) << v;  // printed with one digit
    const std::string out = support::run_command(command, trip.place().path()).out;
    EXPECT_NE(out.find(expected > 0.0 ? moving : stuck), std::string::npos) << v << "\n" << out;
  }
}

TEST(Sources, FluentsFunctionReboundsAndCaptures) {
  const RoundTrip trip(kCounted);
  const std::string said = trip.write("fluent", "out");
  expect_built(
      {"gcc", "-std=c89", "-pedantic", "-Wall", "-Wextra", "-Wno-unused-parameter", "-Werror",
       "-I" + kStubs + "fluent", "-Iout", kStubs + "fluent/main.c", "-o", "program", "-lm"},
      trip);
  expect_the_fit(trip, said, "tangential 3.000000000000 status 1",
                 "tangential 0.000000000000 status 0");
}

TEST(Sources, OpenFoamsClassReboundsAndCaptures) {
  const RoundTrip trip(kCounted);
  const std::string said = trip.write("openfoam", "out");
  expect_built({"g++", "-std=c++11", "-DNoRepository", "-Wall", "-Wextra", "-Werror",
                "-I" + kStubs + "openfoam", "-Iout/recoilRebound", kStubs + "openfoam/main.C", "-o",
                "program"},
               trip);
  expect_the_fit(trip, said, "tangential 3.000000000000 active 1 kept 1",
                 "tangential 0.000000000000 active 0 kept 1");
}

/// The script holds the law itself: what is left is the error of its time step.
void expect_the_fit_in_yade(const std::string& fit) {
  const RoundTrip trip(fit);
  trip.write("yade", "out");
  for (const double v : RoundTrip::velocities) {
    EXPECT_NEAR(
        trip.run({"python3", kStubs + "yade/stand_in.py", "out/impact.py", fmt::format("{}", v)}),
        trip.expected(v), 1e-4)
        << v;
  }
}

std::string under(const std::string& law) {
  return "dataset = \"data\"\n[model]\nadhesion = \"" + law +
         "\"\n[parameters]\nC_H = { initial = 4e-3, free = true }\n"
         "C_A = { initial = 0.05, free = false }\nW = { free = false }\n";
}

TEST(Sources, YadesScriptHoldsTheRing) { expect_the_fit_in_yade(kCounted); }

TEST(Sources, YadesScriptHoldsDmt) { expect_the_fit_in_yade(under("dmt")); }

TEST(Sources, YadesScriptHoldsJkr) { expect_the_fit_in_yade(under("jkr")); }

}  // namespace
