// Flights through air, against integrations of their own: the fall by a classical Runge-Kutta
// method of fourth order in time with fixed steps (8000 to the drop's own time in vacuum), the rise
// by Simpson's rule over the velocity; both in Python, C_d(Re), Sutherland's viscosity, ideal gas
// and slip correction typed in anew. The ball has 2.7 g and 40 mm.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "experiment/flight.hpp"
#include "import_folder.hpp"
#include "support/workplace.hpp"

namespace {

using import_folder::complaint;
using import_folder::Place;
using recoil::Air;
using recoil::AirFlight;
using recoil::ImportFormat;
using recoil::ImportNote;
using recoil::ImportRemark;
using recoil::ImportRequest;
using testing::HasSubstr;
using testing::Not;

constexpr double kBall = 80.572189940272;  // 2.7 g / (pi / 6 (40 mm)^3) [kg/m3]
constexpr double kGravity = 9.80665;

AirFlight ball() { return {Air(), 0.04, kBall, kGravity}; }

void expect_close(double value, double expected, double relative = 1e-8) {
  EXPECT_NEAR(value / expected, 1.0, relative) << value << " instead of " << expected;
}

TEST(AirFlight, TheAirItself) {
  const Air air;
  expect_close(air.density(), 1.204734759);
  expect_close(air.viscosity(), 1.812688004e-5);
  expect_close(air.free_path(), 6.502479e-8, 1e-6);
  expect_close(Air{50000.0, 350.0}.density(), 0.497673377);
  expect_close(Air{50000.0, 350.0}.viscosity(), 2.073596616e-5);
}

TEST(AirFlight, DragFromStokesToNewton) {
  // By hand from Brown & Lawler (2003). At small Re 24 / Re, Stokes' law.
  const auto coefficient = [](double re) {
    return 24.0 / re * recoil::sphere_drag(re).over_stokes;
  };
  expect_close(coefficient(0.1), 247.5041719);
  expect_close(coefficient(100.0), 1.073138805);
  expect_close(coefficient(1e4), 0.4106095720);
  expect_close(coefficient(1e-6), 24e6, 1e-4);
  for (const double re : {0.1, 100.0, 1e5}) {
    const double h = 1e-5 * re;
    expect_close(
        recoil::sphere_drag(re).slope,
        (recoil::sphere_drag(re + h).over_stokes - recoil::sphere_drag(re - h).over_stokes) /
            (2.0 * h),
        1e-6);
  }
}

TEST(AirFlight, ABallFallsAndClimbs) {
  const AirFlight flight = ball();
  const AirFlight::Part fall = flight.fall(1.0);
  expect_close(fall.speed, 4.1875818829);
  expect_close(fall.time, 0.4600928144);
  expect_close(flight.rise(0.9 * fall.speed).height, 0.6707624827);
  expect_close(flight.launch_for_height(0.6707624827), 0.9 * fall.speed);
  expect_close(flight.fall_to_reach(4.1875818829), 1.0);
  expect_close(flight.fall(0.2).speed, 1.9590234136);
  const AirFlight thin(Air{50000.0, 350.0}, 0.04, kBall, kGravity);
  expect_close(thin.fall(1.0).speed, 4.3297798857);
  expect_close(thin.fall(1.0).time, 0.4551508887);
}

TEST(AirFlight, ThereAndBack) {
  const AirFlight flight = ball();
  expect_close(flight.return_speed(3.6), 3.3593339557);
  expect_close(flight.launch_for_duration(0.7089293005), 3.6);
  EXPECT_EQ(flight.launch_for_height(0.0), 0.0);
  EXPECT_TRUE(std::isinf(flight.fall_to_reach(100.0)));  // faster than it can fall
}

TEST(AirFlight, UpToTheTerminalSpeed) {
  // Polystyrene of 0.1 mm: 0.2596 m/s. The last centimetres of the fall add time and no speed.
  const AirFlight flight(Air(), 1e-4, 1050.0, kGravity);
  expect_close(flight.fall(1e-3).speed, 0.1181365880);
  expect_close(flight.fall(1e-3).time, 0.0155206528);
  expect_close(flight.fall(0.02).speed, 0.2557405618);
  expect_close(flight.fall(0.02).time, 0.1015571425);
  expect_close(flight.fall(0.3).speed, 0.2596310799);
  expect_close(flight.fall(0.3).time, 1.1803643961);
  expect_close(flight.rise(2.0).time, 0.0518725494);
  expect_close(flight.rise(2.0).height, 0.031000058588);
}

TEST(AirFlight, VanishesWithThePressure) {
  const AirFlight thin(Air{2e-3, 293.0}, 0.04, kBall, kGravity);
  expect_close(thin.fall(1.0).speed, std::sqrt(2.0 * kGravity), 2e-6);
  expect_close(thin.launch_for_duration(0.7), 0.35 * kGravity, 2e-6);
}

// ---- imports ---------------------------------------------------------------------------------

ImportRequest ball_request(const Place& place, const std::string& text, ImportFormat format,
                           const std::string& map) {
  ImportRequest request = place.request(text, format);
  request.map = {map};
  request.diameters = {"40mm"};
  request.particle =
      "material=celluloid,density=80.572189940272,youngs_modulus=2e9,poisson_ratio=0.35";
  request.conditions.clear();
  return request;
}

const ImportNote* note_of(const std::vector<ImportNote>& notes, ImportRemark remark) {
  for (const ImportNote& note : notes) {
    if (note.remark == remark) return &note;
  }
  return nullptr;
}

TEST(ImportInAir, HeightsOfABallWithARestitutionOfNineTenths) {
  // Read as in vacuum, e would be 0.8190 after 1 m and 0.8826 after 0.2 m.
  const Place place;
  const auto result = recoil::import_points(
      ball_request(place, "h1,h2\n1,0.6707624827\n0.2,0.1557954926\n0.2,0\n", ImportFormat::heights,
                   "drop_height=h1:m,rebound_height=h2:m"));
  const auto& points = result.dataset.points;
  expect_close(points[0].restitution, 0.9);
  expect_close(points[0].incident_velocity, 4.1875818829);
  expect_close(points[1].restitution, 0.9);
  expect_close(points[1].incident_velocity, 1.9590234136);
  EXPECT_EQ(points[2].restitution, 0.0);
  const ImportNote* air = note_of(result.notes, ImportRemark::air_drag);
  ASSERT_NE(air, nullptr);
  EXPECT_NEAR(air->air.fast_share, 1.0 - 0.81900091 / 0.9, 1e-7);
  EXPECT_NEAR(air->air.fast, 4.1875818829, 1e-7);
  EXPECT_EQ(note_of(result.notes, ImportRemark::without_air), nullptr);
}

TEST(ImportInAir, IntervalsOfABallWithARestitutionOfNineTenths) {
  // Launched with 3.6 m/s. Read as in vacuum, e would be 0.8484, 0.8623 and 0.8717.
  const Place place;
  auto request = ball_request(place, "t\n0.7089293005\n0.6014656904\n0.5186680638\n0.4521341448\n",
                              ImportFormat::intervals, "interval=t:s");
  request.time_error = "1ms";
  const auto result = recoil::import_points(request);
  const auto& points = result.dataset.points;
  ASSERT_EQ(points.size(), 3U);
  const double velocities[] = {3.3593339557, 2.8779934273, 2.4976095237};
  for (std::size_t i = 0; i < 3; ++i) {
    expect_close(points[i].restitution, 0.9);
    expect_close(points[i].incident_velocity, velocities[i]);
  }
  // The errors are the same parts of the values as in vacuum.
  const double plain = 0.84841421;
  expect_close(*points[0].restitution_sd / points[0].restitution,
               0.001 / 0.7089293005 * std::sqrt(2.0 * (1.0 + plain + plain * plain)) / plain, 1e-7);
  const ImportNote* air = note_of(result.notes, ImportRemark::air_drag);
  ASSERT_NE(air, nullptr);
  EXPECT_NEAR(air->air.slow_share, 1.0 - 0.87172158 / 0.9, 1e-7);
  EXPECT_NEAR(air->air.fast_share, 1.0 - 0.84841421 / 0.9, 1e-7);
}

TEST(ImportInAir, TheReleaseHeightIsThatOfAFallThroughAir) {
  // From 1 m it hits with 4.18758 m/s; flights after bounces with e = 0.9 take 0.73975 s, 0.62441
  // s.
  const Place place;
  const std::string text = "t,h\n0.7397493000,1\n0.6244119097,1\n";
  const auto result = recoil::import_points(
      ball_request(place, text, ImportFormat::intervals, "interval=t:s,release_height=h:m"));
  const ImportNote* note = note_of(result.notes, ImportRemark::release_heights);
  ASSERT_NE(note, nullptr);
  EXPECT_NEAR(note->releases.at(0).first, 0.9, 1e-8);
  EXPECT_NEAR(note->releases.at(0).second, 0.9, 1e-8);
  EXPECT_NEAR(note->releases.at(0).missing, 0.0, 1e-7);
}

TEST(ImportInAir, VacuumKeepsEveryDigit) {
  const Place place;
  auto request = ball_request(place, "h1,h2\n0.37,0.21\n", ImportFormat::heights,
                              "drop_height=h1:m,rebound_height=h2:m");
  request.conditions = {"ambient_pressure=0"};
  request.drop_error = "1mm";
  request.rebound_error = "2mm";
  const auto result = recoil::import_points(request);
  // As written with twelve digits by the formulas for vacuum.
  EXPECT_EQ(place.read("made/points.csv"),
            "series,diameter,incident_velocity,restitution,restitution_sd,velocity_sd\n"
            "input,40,2.69386729443,0.753370803501,0.00372913886212,0.00364036120869\n");
  EXPECT_NE(note_of(result.notes, ImportRemark::without_air), nullptr);
  EXPECT_EQ(note_of(result.notes, ImportRemark::air_drag), nullptr);
  EXPECT_EQ(result.dataset.system.conditions.of(recoil::Condition::ambient_pressure), 0.0);
}

TEST(ImportInAir, TheMediumStandsInThePackageAndIsKept) {
  const Place place;
  auto request = ball_request(place, "h1,h2\n1,0.6707624827\n", ImportFormat::heights,
                              "drop_height=h1:m,rebound_height=h2:m");
  recoil::import_points(request);
  auto conditions =
      nlohmann::json::parse(place.read("made/datapackage.json"))["recoil"]["conditions"];
  EXPECT_EQ(conditions["ambient_pressure"], 101325.0);
  EXPECT_EQ(conditions["temperature"], 293.0);
  EXPECT_THAT(place.read("made/datapackage.json"), HasSubstr("drag of air at 101325 Pa and 293 K"));
  // What is stated is what the points that replace these are reduced with, too.
  request.replace = true;
  request.conditions = {"ambient_pressure=0"};
  recoil::import_points(request);
  request.conditions.clear();
  const auto again = recoil::import_points(request).dataset;
  expect_close(again.points[0].restitution, std::sqrt(0.6707624827));
  // Another dataset with these materials has its own conditions.
  auto like = ball_request(place, "h1,h2\n1,0.6707624827\n", ImportFormat::heights,
                           "drop_height=h1:m,rebound_height=h2:m");
  like.particle.clear();
  like.surface.clear();
  like.like = place.folder() / "made";
  like.into = place.folder() / "other";
  expect_close(recoil::import_points(like).dataset.points[0].restitution, 0.9);
}

TEST(ImportInAir, WhatNoSphereCanDoIsRefused) {
  // Spheres of 2 um do not rise by 5 cm in air.
  const Place place;
  auto request = place.request("h1,h2\n0.2,0.05\n", ImportFormat::heights);
  request.map = {"drop_height=h1:m,rebound_height=h2:m"};
  request.conditions.clear();
  EXPECT_THAT(complaint(request), HasSubstr("input.csv:2:5: restitution = "));
  EXPECT_THAT(complaint(request), HasSubstr("--ambient-pressure 0 for vacuum"));
  EXPECT_FALSE(place.has("made"));
}

TEST(ImportInAir, BeyondTheLawOfDragANoteSaysSo) {
  // A ball of 0.4 m and 2.7 kg that falls 10 m: 13.1 m/s, Re = 3.5e5.
  const Place place;
  auto request = ball_request(place, "h1,h2\n10,5\n", ImportFormat::heights,
                              "drop_height=h1:m,rebound_height=h2:m");
  request.diameters = {"400mm"};
  const auto result = recoil::import_points(request);
  const ImportNote* note = note_of(result.notes, ImportRemark::turbulent_air);
  ASSERT_NE(note, nullptr);
  EXPECT_GT(note->air.reynolds, 2e5);
}

TEST(ImportInAir, TheCommandSaysHowMuchItWas) {
  const support::Workplace at;
  at.write("b.csv", "t\n0.7089293005\n0.6014656904\n0.5186680638\n0.4521341448\n");
  std::vector<std::string> words = {
      "import",       "b.csv",
      "--format",     "intervals",
      "--into",       "b",
      "--diameter",   "40mm",
      "--map",        "interval=t:s",
      "--provenance", "measured",
      "--particle",   "material=celluloid,density=80.572,youngs_modulus=2e9,poisson_ratio=0.35",
      "--surface",    "material=wood,youngs_modulus=1e10,poisson_ratio=0.3"};
  const support::Outcome air = at.run(words);
  ASSERT_EQ(air.status, 0) << air.err;
  EXPECT_THAT(air.out, HasSubstr("note: the effect of air drag (101325 Pa, 293 K) was removed; it "
                                 "had lowered e by 3.1 % at 2.5 m/s and by 5.7 % at 3.36 m/s"));
  EXPECT_THAT(at.run({"check", "b"}).out,
              HasSubstr("conditions         = ambient pressure 101325 Pa, temperature 293 K"));
  words.insert(words.end(), {"--replace", "--ambient-pressure", "0"});
  const support::Outcome vacuum = at.run(words);
  ASSERT_EQ(vacuum.status, 0) << vacuum.err;
  EXPECT_THAT(vacuum.out, Not(HasSubstr("air drag")));
  EXPECT_THAT(at.run({"check", "b"}).out, HasSubstr("conditions         = vacuum"));
}

}  // namespace
