// Heights over time: impacts, the parabolas on either side, and whether the errors hold the truth.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "import_folder.hpp"

namespace {

using import_folder::complaint;
using import_folder::Place;
using recoil::Dataset;
using recoil::ImportFormat;
using testing::HasSubstr;

constexpr double kStandardGravity = 9.80665;

/// A ball that is held for a while, dropped from `drop` and bounces `bounces` times with `e`, in
/// vacuum: its height [m] at a time [s], from the closed form of free flight.
struct Ball {
  double drop = 1.0;
  double e = 0.8;
  double held = 0.3;
  int bounces = 6;

  double height(double time) const {
    if (time < held) return drop;
    double begin = held + std::sqrt(2.0 * drop / kStandardGravity);
    if (time < begin) return drop - 0.5 * kStandardGravity * (time - held) * (time - held);
    double speed = std::sqrt(2.0 * kStandardGravity * drop);
    for (int k = 0; k < bounces; ++k) {
      speed *= e;
      const double t = time - begin;
      if (t < 2.0 * speed / kStandardGravity) return speed * t - 0.5 * kStandardGravity * t * t;
      begin += 2.0 * speed / kStandardGravity;
    }
    return 0.0;
  }
  double end() const {
    double time = held + std::sqrt(2.0 * drop / kStandardGravity);
    double speed = std::sqrt(2.0 * kStandardGravity * drop);
    for (int k = 0; k < bounces; ++k) {
      speed *= e;
      time += 2.0 * speed / kStandardGravity;
    }
    return time;
  }
};

/// A ball of 40 mm and 2.7 g that falls from 1 m through air of 1.204735 kg/m3 and 18.12688 uPa s,
/// and leaves each bounce with e times its speed: its heights [m] every `interval` [s], integrated
/// in steps of 10 us with the drag coefficient of Brown & Lawler (2003).
std::vector<double> heights_in_air(double e, double interval, std::size_t bounces) {
  constexpr double step = 1e-5;
  const auto acceleration = [](double v) {
    if (v == 0.0) return -kStandardGravity;
    const double re = 1.204735 * std::abs(v) * 0.04 / 18.12688e-6;
    const double c = 24.0 / re * (1.0 + 0.150 * std::pow(re, 0.681)) + 0.407 / (1.0 + 8710.0 / re);
    return -kStandardGravity - c * 1.204735 * M_PI * 0.02 * 0.02 / 2.0 * v * std::abs(v) / 0.0027;
  };
  std::vector<double> heights;
  double y = 1.0;
  double v = 0.0;
  std::size_t bounced = 0;
  for (std::size_t i = 0; bounced <= bounces; ++i) {
    if (i % static_cast<std::size_t>(std::lround(interval / step)) == 0) heights.push_back(y);
    const double half = v + 0.5 * step * acceleration(v);
    const double a = acceleration(half);
    double next = y + step * half;
    const double speed = v + step * a;
    if (next < 0.0) {  // the rest of the step after the bounce
      const double share = y / (y - next);
      const double hit = v + share * step * a;
      v = -e * hit;
      next = v * (1.0 - share) * step;
      v += (1.0 - share) * step * acceleration(v);
      ++bounced;
    } else {
      v = speed;
    }
    y = next;
  }
  return heights;
}

recoil::ImportRequest table_tennis(const Place& place, const std::string& text) {
  auto request = place.request(text, ImportFormat::track);
  request.diameters = {"40mm"};
  request.particle = "material=celluloid,density=80.5722,youngs_modulus=2e9,poisson_ratio=0.35";
  request.adhesion_energy = 0.0;
  request.conditions = {"ambient_pressure=101325", "temperature=293"};
  return request;
}

TEST(Track, TheDragOfAirIsTakenOut) {
  const std::vector<double> heights = heights_in_air(0.9, 0.005, 4);
  std::string metres = "t,y\n";
  std::string pixels = "t,y\n";  // of 1.5 mm, downward
  for (std::size_t i = 0; i < heights.size(); ++i) {
    metres += fmt::format("{:.4f},{:.7f}\n", 0.005 * static_cast<double>(i), heights[i]);
    pixels +=
        fmt::format("{:.4f},{:.5f}\n", 0.005 * static_cast<double>(i), 900.0 - heights[i] / 1.5e-3);
  }
  for (const bool scaled : {true, false}) {
    const Place place;
    auto request = table_tennis(place, scaled ? metres : pixels);
    request.map = {scaled ? "time=t:s,height=y:m" : "time=t:s,pixel=y"};
    const auto made = recoil::import_points(request);
    ASSERT_EQ(made.dataset.points.size(), 4U);
    for (const auto& point : made.dataset.points) EXPECT_NEAR(point.restitution, 0.9, 2e-4);
    // The fall over 1 m, as in the tests of AirFlight.
    EXPECT_NEAR(made.dataset.points.front().incident_velocity, 4.1875819, 2e-3);
    EXPECT_EQ(
        std::ranges::count(made.notes, recoil::ImportRemark::air_drag, &recoil::ImportNote::remark),
        1);
  }
}

TEST(Track, RepeatedFramesAreLeftOut) {
  // Whole pixels of 375 a metre; the ball is held for 2 s. `shown[i]` is the frame at i.
  const Ball ball{1.7, 0.8, 2.0, 4};
  for (const int again : {5, 2}) {  // one frame of five, one of two
    const double fps = again == 2 ? 120.0 : 24.0;
    std::string text = "t,y\n";
    for (int i = 0; i / fps < ball.end(); ++i) {
      const int shown = i % again == again - 1 ? i - 1 : i;
      text += fmt::format("{:.6f},{:.0f}\n", i / fps, 900.0 - 375.0 * ball.height(shown / fps));
    }
    const Place place;
    auto request = place.request(text, ImportFormat::track);
    request.map = {"time=t:s,pixel=y"};
    const auto made = recoil::import_points(request);
    ASSERT_GE(made.dataset.points.size(), 3U) << again;
    for (const auto& point : made.dataset.points) {
      EXPECT_NEAR(point.restitution, 0.8, 3.0 * *point.restitution_sd) << again;
      EXPECT_LT(*point.restitution_sd, 0.05);
    }
    EXPECT_EQ(std::ranges::count(made.notes, recoil::ImportRemark::frames_repeated,
                                 &recoil::ImportNote::remark),
              1);
  }
}

TEST(Track, RowsCountAsFramesAndLostFramesAreAllowedFor) {
  // No header and no times: x;y; in pixels of 2 mm, with a lost frame in a flight of each launch.
  const Ball ball{0.8, 0.7, 0.2, 3};
  std::string text = "x;y;launch;\n";
  for (const char* const launch : {"one", "two"}) {
    for (int i = 0; i / 100.0 < ball.end(); ++i) {
      if (i == 70) continue;
      text += fmt::format("7.5;{:.4f};{};\n", 900.0 - 500.0 * ball.height(i / 100.0), launch);
    }
  }
  const Place place;
  auto request = place.request(text, ImportFormat::track);
  request.map = {"pixel=y,launch=launch"};
  request.fps = 100.0;
  request.series = "ball";
  const auto made = recoil::import_points(request);
  ASSERT_EQ(made.dataset.points.size(), 6U);
  EXPECT_EQ(made.dataset.series, std::vector<std::string>{"ball"});
  for (const auto& point : made.dataset.points) {
    EXPECT_NEAR(point.restitution, 0.7, 1e-4);
  }
  const auto mended = std::ranges::find(made.notes, recoil::ImportRemark::frames_mended,
                                        &recoil::ImportNote::remark);
  ASSERT_NE(mended, made.notes.end());
  EXPECT_EQ(mended->count, 2U);
}

/// The shipped points are those that the shipped tracks give.
TEST(Track, TheShippedTracksGiveTheShippedPoints) {
  for (const char* const surface : {"table", "floor", "racket"}) {
    const auto folder =
        std::filesystem::path(RECOIL_SOURCE_DIR) / fmt::format("datasets/table-tennis-{}", surface);
    std::vector<std::filesystem::path> tracks;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "tracks")) {
      tracks.push_back(entry.path());
    }
    std::ranges::sort(tracks);
    const Place place;
    auto request = table_tennis(place, "");
    request.file = tracks.front();
    request.more_files.assign(tracks.begin() + 1, tracks.end());
    request.map = {"pixel=2"};
    request.fps = 100.0;
    request.scale = "1.50494mm";
    request.series = fmt::format("ball on {}", surface);
    request.particle = "material=celluloid,density=80.57,youngs_modulus=2e9,poisson_ratio=0.35";
    const Dataset made = recoil::import_points(request).dataset;
    const Dataset shipped = recoil::load_dataset(folder);
    ASSERT_EQ(made.points.size(), shipped.points.size()) << surface;
    for (std::size_t k = 0; k < made.points.size(); ++k) {
      EXPECT_NEAR(made.points[k].restitution, shipped.points[k].restitution, 1e-6);
      EXPECT_NEAR(made.points[k].incident_velocity, shipped.points[k].incident_velocity, 1e-6);
    }
    EXPECT_EQ(shipped.provenance, recoil::Provenance::measured);
  }
}

TEST(Track, TheStatedErrorsHoldTheTruth) {
  int inside_e = 0;
  int inside_v = 0;
  int count = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    recoil::RandomStream random(seed, recoil::RandomPurpose::bootstrap, 0);
    const Ball ball;
    std::string text = "t y\n";
    for (double t = 0.0002 * seed; t < ball.end(); t += 1.0 / 120.0) {
      text += fmt::format("{:.9f} {:.9f}\n", t, ball.height(t) + 1e-3 * random.normal());
    }
    const Place place;
    auto request = place.request(text, ImportFormat::track);
    request.map = {"time=t:s,height=y:m"};
    const Dataset made = recoil::import_points(request).dataset;
    ASSERT_EQ(made.points.size(), 6U) << seed;
    EXPECT_EQ(made.system.method, recoil::Method::video);
    for (std::size_t k = 0; k < made.points.size(); ++k) {
      const auto& point = made.points[k];
      const double v = std::sqrt(2.0 * kStandardGravity) * std::pow(0.8, static_cast<double>(k));
      inside_e += std::abs(point.restitution - 0.8) < 1.96 * *point.restitution_sd ? 1 : 0;
      inside_v += std::abs(point.incident_velocity - v) < 1.96 * *point.velocity_sd ? 1 : 0;
      ++count;
    }
  }
  // 95 % of 240, within three standard deviations of a binomial count (0.014), and a little for
  // points of one track that share a flight.
  EXPECT_NEAR(static_cast<double>(inside_e) / count, 0.95, 0.05);
  EXPECT_NEAR(static_cast<double>(inside_v) / count, 0.95, 0.05);
}

TEST(Track, FramesAndPixelsOfSeveralBallsAreScaledByTheFall) {
  const Ball a{0.5, 0.7, 0.3, 4};
  const Ball b{0.8, 0.9, 0.1, 4};
  std::string text = "ball;frame;y\n";
  for (const auto& [name, ball] : {std::pair{"a", a}, std::pair{"b", b}}) {
    // 2.5 mm are a pixel, rows count downward, the floor is in row 900.
    for (int i = 0; i / 240.0 < ball.end(); ++i) {
      text += fmt::format("{};{};{:.6f}\n", name, i, 900.0 - 400.0 * ball.height(i / 240.0));
    }
  }
  const Place place;
  auto request = place.request(text, ImportFormat::track);
  request.map = {"series=ball,frame=frame,pixel=y"};
  EXPECT_THAT(complaint(request), HasSubstr("give --fps 240"));
  request.fps = 240.0;
  for (const char* const scale : {"", "2.5mm"}) {
    request.scale = scale;
    request.into = place.folder() / fmt::format("made{}", scale);
    const Dataset made = recoil::import_points(request).dataset;
    ASSERT_EQ(made.points.size(), 8U);
    EXPECT_NEAR(made.points[0].restitution, 0.7, 1e-5);
    EXPECT_NEAR(made.points[0].incident_velocity, std::sqrt(2.0 * kStandardGravity * 0.5), 1e-4);
    EXPECT_NEAR(made.points[7].restitution, 0.9, 1e-5);
    EXPECT_NEAR(made.points[7].incident_velocity,
                std::sqrt(2.0 * kStandardGravity * 0.8) * 0.9 * 0.9 * 0.9, 1e-4);
  }
  // With a scale that is wrong by a tenth the fall is wrong by a tenth, and e is not.
  request.scale = "2.75mm";
  request.into = place.folder() / "wrong";
  const auto result = recoil::import_points(request);
  EXPECT_NEAR(result.dataset.points[0].restitution, 0.7, 1e-5);
  EXPECT_EQ(result.notes.front().remark, recoil::ImportRemark::track_fall);
  EXPECT_NEAR(result.notes.front().fall, 1.1 * kStandardGravity, 1e-3);
}

TEST(Track, AnAxisThatPointsDownIsNoticed) {
  // Video of a slow camera, heights of an image: three bounces of exactly 0.8, as up as down.
  const Ball ball{1.0, 0.8, 0.0, 3};
  for (const double direction : {1.0, -1.0}) {
    std::string text = "t,y\n";
    for (int i = 0; i / 120.0 < ball.end(); ++i) {
      text += fmt::format("{:.6f},{:.5f}\n", i / 120.0, 0.1 + direction * ball.height(i / 120.0));
    }
    const Place place;
    auto request = place.request(text, ImportFormat::track);
    request.map = {"time=t:s,height=y:m"};
    const auto made = recoil::import_points(request);
    ASSERT_EQ(made.dataset.points.size(), 3U) << direction;
    double v = std::sqrt(2.0 * kStandardGravity);
    for (const auto& point : made.dataset.points) {
      EXPECT_NEAR(point.restitution, 0.8, 1e-3);
      EXPECT_NEAR(point.incident_velocity, v, 2e-3);
      v *= 0.8;
    }
    const auto said = std::ranges::count(made.notes, recoil::ImportRemark::axis_points_down,
                                         &recoil::ImportNote::remark);
    EXPECT_EQ(said, direction < 0.0 ? 1 : 0);
  }
}

TEST(Track, TheDirectionIsFoundInNoise) {
  // The second differences of 1000 frames/s are 10 um, those of the noise 250 times as large.
  recoil::RandomStream random(1, recoil::RandomPurpose::bootstrap, 0);
  const Ball ball{1.0, 0.8, 0.1, 3};
  std::string text = "t,y\n";
  for (int i = 0; i / 1000.0 < ball.end(); ++i) {
    text += fmt::format("{:.6f},{:.6f}\n", i / 1000.0,
                        1.1 - ball.height(i / 1000.0) + 1e-3 * random.normal());
  }
  const Place place;
  auto request = place.request(text, ImportFormat::track);
  request.map = {"time=t:s,height=y:m"};
  const auto made = recoil::import_points(request);
  ASSERT_EQ(made.dataset.points.size(), 3U);
  for (const auto& point : made.dataset.points) {
    EXPECT_NEAR(point.restitution, 0.8, 4.0 * *point.restitution_sd);
  }
}

TEST(Track, LostSamplesRestAndTitlesDoNoHarm) {
  const Ball ball{1.0, 0.6, 0.2, 3};
  std::string text = "mass A\t\t\nt\tx\ty\n";
  for (int i = 0; i / 240.0 < ball.end() + 0.5; ++i) {  // it lies still at the end
    const double t = i / 240.0;
    text += i % 7 == 3 ? fmt::format("{:.6f}\t0\t\n", t)
                       : fmt::format("{:.6f}\t0\t{:.6f}\n", t, ball.height(t));
  }
  const Place place;
  auto request = place.request(text, ImportFormat::track);
  request.map = {"time=t:s,height=y:m"};
  const Dataset made = recoil::import_points(request).dataset;
  ASSERT_GE(made.points.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(made.points[k].restitution, 0.6, 1e-4) << k;
}

TEST(Track, WhatIsAskedFor) {
  const Place place;
  auto request = place.request("s,z\n0,1\n0.1,0.9\n0.2,0.8\n", ImportFormat::track);
  EXPECT_THAT(complaint(request), HasSubstr("--map time=COLUMN:s, or give --fps"));
  request.map = {"time=s:s"};
  EXPECT_THAT(complaint(request), HasSubstr("--map height=COLUMN:m, or pixel=COLUMN"));
  request.map = {"time=s:s,height=z:m"};
  EXPECT_THAT(complaint(request), HasSubstr("no impact was found in these tracks"));
  request.scale = "1mm";
  EXPECT_THAT(complaint(request), HasSubstr("--scale without pixels"));
  auto back = place.request("s,z\n0,1\n0.1,0.9\n0,1\n", ImportFormat::track);
  back.map = request.map;
  EXPECT_THAT(complaint(back), HasSubstr("input.csv:4:1: a time of 0 s"));
}

}  // namespace
