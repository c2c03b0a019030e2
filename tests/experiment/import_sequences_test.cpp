// Times to rest, successive tops and blocks of bounces of a ball whose e is known: closed forms in
// vacuum, and a simulation of its flights through air, written here.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "import_folder.hpp"

namespace {

using import_folder::Place;
using recoil::ImpactPoint;
using recoil::ImportFormat;

constexpr double standard_gravity = 9.80665;

struct Import {
  ImportFormat format;
  std::string map, text;
  std::string drop_error = "", rebound_error = "", time_error = "";
};

recoil::ImportRequest request_of(const Import& one, bool air, const Place& place) {
  recoil::ImportRequest request = place.request(one.text, one.format);
  request.map = {one.map};
  request.drop_error = one.drop_error;
  request.rebound_error = one.rebound_error;
  request.time_error = one.time_error;
  request.diameters = {"40mm"};
  request.particle = "material=celluloid,density=81,youngs_modulus=2e9,poisson_ratio=0.35";
  request.conditions = {air ? "ambient_pressure=101325" : "ambient_pressure=0"};
  return request;
}

std::vector<ImpactPoint> points_of(const Import& one, bool air) {
  const Place place;
  return recoil::import_points(request_of(one, air, place)).dataset.points;
}

/// A ball that falls from 1 m: times of its impacts, the heights of its tops, and its speeds just
/// before the impacts.
struct SimulatedBall {
  std::vector<double> impacts, tops = {1.0}, speeds;
};

/// The drag of a sphere of 40 mm and 81 kg/m3 in air of 101325 Pa and 293 K over its mass (Brown &
/// Lawler 2003, U.S. Standard Atmosphere 1976).
double drag(double speed) {
  const double diameter = 0.04;
  const double density = 101325.0 / (287.05 * 293.0);
  const double viscosity = 1.458e-6 * std::pow(293.0, 1.5) / (293.0 + 110.4);
  const double reynolds = density * std::abs(speed) * diameter / viscosity;
  if (!(reynolds > 0.0)) return 0.0;
  const double coefficient = 24.0 / reynolds * (1.0 + 0.150 * std::pow(reynolds, 0.681)) +
                             0.407 / (1.0 + 8710.0 / reynolds);
  return 0.75 * coefficient * density / (81.0 * diameter) * speed * std::abs(speed);
}

/// Steps of the midpoint rule, small compared with each flight.
SimulatedBall simulated(double e, bool air, std::size_t bounces) {
  SimulatedBall ball;
  double height = 1.0;
  double velocity = 0.0;
  double time = 0.0;
  double scale = 0.45;
  while (ball.impacts.size() < bounces) {
    const double step = scale / 1500.0;
    const auto slope = [&](double v) { return -standard_gravity - (air ? drag(v) : 0.0); };
    const double middle = velocity + 0.5 * step * slope(velocity);
    const double next = velocity + step * slope(middle);
    const double below = height + step * middle;
    if (velocity > 0.0 && next <= 0.0) {
      ball.tops.push_back(height + 0.5 * velocity * velocity / standard_gravity);
    }
    if (below > 0.0) {
      std::tie(height, velocity, time) = std::tuple(below, next, time + step);
      continue;
    }
    // The impact within this step: height + velocity s - g s^2 / 2 = 0.
    const double a = -slope(middle);
    const double s = (velocity + std::sqrt(velocity * velocity + 2.0 * a * height)) / a;
    ball.impacts.push_back(time + s);
    ball.speeds.push_back(a * s - velocity);
    time += s;
    height = 0.0;
    velocity = e * ball.speeds.back();
    scale = 2.0 * velocity / standard_gravity;
    height = 1e-300;
  }
  return ball;
}

TEST(Sequences, GiveTheRestitutionInVacuumAndInAir) {
  constexpr double e = 0.85;
  for (const bool air : {false, true}) {
    SCOPED_TRACE(air);
    const SimulatedBall ball = simulated(e, air, 60);
    const double last = ball.impacts.back() - ball.impacts[58];
    const double total = ball.impacts.back() + last * e / (1.0 - e);
    const double error = air ? 3e-5 : 1e-6;
    const auto rest = points_of(
        {ImportFormat::rest, "drop_height=1,rest_time=T:s", fmt::format("T\n{:.9f}\n", total)},
        air);
    ASSERT_EQ(rest.size(), 1U);
    EXPECT_NEAR(rest[0].restitution, e, error);
    EXPECT_NEAR(rest[0].incident_velocity, ball.speeds[0], 1e-4);

    std::string tops = "h\n";
    for (std::size_t k = 0; k < 5; ++k) tops += fmt::format("{:.9f}\n", ball.tops[k]);
    const auto of_tops = points_of({ImportFormat::tops, "top=h:m", tops}, air);
    ASSERT_EQ(of_tops.size(), 4U);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(of_tops[k].restitution, e, error);
      EXPECT_NEAR(of_tops[k].incident_velocity, ball.speeds[k], 1e-4);
    }

    // Blocks of 5, 3 and 3 flights after the first impact.
    const std::vector<double>& t = ball.impacts;
    const auto blocks = points_of({ImportFormat::blocks, "block_time=T:s,bounces=n",
                                   fmt::format("T,n\n{:.9f},5\n{:.9f},3\n{:.9f},3\n", t[5] - t[0],
                                               t[8] - t[5], t[11] - t[8])},
                                  air);
    ASSERT_EQ(blocks.size(), 2U);
    EXPECT_NEAR(blocks[0].restitution, e, error);
    EXPECT_NEAR(blocks[0].incident_velocity, ball.speeds[5], 2e-4);
    EXPECT_NEAR(blocks[1].incident_velocity, ball.speeds[8], 2e-4);
  }
}

TEST(Sequences, CarryTheStatedErrors) {
  // Each measured value moved by its standard deviation, one after the other.
  struct Case {
    ImportFormat format;
    std::string map;
    std::vector<double> values, errors;
    std::string (*text)(const std::vector<double>&);
    std::string drop_error, rebound_error, time_error;
  };
  const std::vector<Case> cases = {{ImportFormat::rest,
                                    "drop_height=h:m,rest_time=T:s",
                                    {1.0, 4.0},
                                    {1e-4, 1e-4},
                                    [](const std::vector<double>& v) {
                                      return fmt::format("h,T\n{:.12f},{:.12f}\n", v[0], v[1]);
                                    },
                                    "0.1mm",
                                    "",
                                    "0.1ms"},
                                   {ImportFormat::tops,
                                    "top=h:m",
                                    {1.0, 0.7},
                                    {2e-4, 1e-4},
                                    [](const std::vector<double>& v) {
                                      return fmt::format("h\n{:.12f}\n{:.12f}\n", v[0], v[1]);
                                    },
                                    "0.2mm",
                                    "0.1mm",
                                    ""},
                                   {ImportFormat::blocks,
                                    "block_time=T:s,bounces=n",
                                    {0.5, 3.0, 4.0},  // instants at the ends of the blocks
                                    {1e-5, 1e-5, 1e-5},
                                    [](const std::vector<double>& v) {
                                      return fmt::format("T,n\n{:.12f},5\n{:.12f},3\n", v[1] - v[0],
                                                         v[2] - v[1]);
                                    },
                                    "",
                                    "",
                                    "0.01ms"}};
  for (const Case& one : cases) {
    SCOPED_TRACE(static_cast<int>(one.format));
    const auto point_at = [&](const std::vector<double>& values) {
      return points_of({one.format, one.map, one.text(values), one.drop_error, one.rebound_error,
                        one.time_error},
                       false)
          .at(0);
    };
    const ImpactPoint point = point_at(one.values);
    double e_squares = 0.0;
    double v_squares = 0.0;
    for (std::size_t k = 0; k < one.values.size(); ++k) {
      std::vector<double> moved = one.values;
      moved[k] += one.errors[k];
      const ImpactPoint other = point_at(moved);
      e_squares += std::pow(other.restitution - point.restitution, 2);
      v_squares += std::pow(other.incident_velocity - point.incident_velocity, 2);
    }
    ASSERT_TRUE(point.restitution_sd && point.velocity_sd);
    EXPECT_NEAR(*point.restitution_sd / std::sqrt(e_squares), 1.0, 0.01);
    EXPECT_NEAR(*point.velocity_sd / std::sqrt(v_squares), 1.0, 0.01);
  }
}

TEST(Sequences, AnEmptyCellSplitsALaunchAndNonsenseIsRefused) {
  EXPECT_EQ(points_of({ImportFormat::tops, "launch=n,top=h:cm",
                       "n,h\na,100\nb,90\na,80\nb,72\na,\na,40\na,32\n"},
                      false)
                .size(),
            3U);
  const std::vector<std::pair<Import, std::string>> refused = {
      {{ImportFormat::rest, "drop_height=h:m,rest_time=T:s", "h,T\n1,0.4\n"}, "input.csv:2:3:"},
      {{ImportFormat::rest, "drop_height=h:m,rest_time=T:s", "h,T\n0,0.4\n"}, "input.csv:2:1:"},
      {{ImportFormat::tops, "top=h:m", "h\n1\n1.6\n"}, "input.csv:3:1:"},
      {{ImportFormat::tops, "top=h:m", "h\n1\n"}, "input.csv:1:1:"},
      {{ImportFormat::blocks, "block_time=T:s,bounces=5", "T\n1\n9\n"}, "input.csv:3:1:"},
      {{ImportFormat::blocks, "block_time=T:s,bounces=n", "T,n\n1,5\n0.5,2.5\n"}, "input.csv:3:5:"},
      {{ImportFormat::blocks, "block_time=T:s,bounces=n", "T,n\n1,5\n0.5,1e9\n"},
       "input.csv:3:5:"}};
  for (const auto& [one, place_of_it] : refused) {
    const Place place;
    EXPECT_THAT(import_folder::complaint(request_of(one, false, place)),
                testing::HasSubstr(place_of_it));
  }
}

}  // namespace
