// Drop and rebound heights, and times between bounces, with their errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/random.hpp"
#include "import_folder.hpp"

namespace {

using import_folder::complaint;
using import_folder::Place;
using recoil::Dataset;
using recoil::ImportFormat;
using testing::HasSubstr;

TEST(Heights, RestitutionAndVelocity) {
  const Place place;
  auto request = place.request("h1 [cm],h2\n20,5\n", ImportFormat::heights);
  request.map = {"drop_height=h1 [cm],rebound_height=h2:cm"};
  request.drop_error = "2mm";
  request.rebound_error = "1mm";
  request.gravity = "10";
  const Dataset made = recoil::import_points(request).dataset;
  const recoil::ImpactPoint& point = made.points.front();
  EXPECT_DOUBLE_EQ(point.restitution, 0.5);
  EXPECT_DOUBLE_EQ(point.incident_velocity, 2.0);
  // (e/2) sqrt((0.2/20)^2 + (0.1/5)^2), (V/2) (0.2/20)
  EXPECT_NEAR(*point.restitution_sd, 0.25 * std::hypot(0.01, 0.02), 1e-9);
  EXPECT_NEAR(*point.velocity_sd, 0.01, 1e-12);
}

TEST(Heights, ErrorsAreThoseOfASimulation) {
  // The same formulas against the scatter of a thousand noisy drops.
  recoil::RandomStream random(1, recoil::RandomPurpose::bootstrap, 0);
  double sum = 0.0;
  double square = 0.0;
  constexpr int count = 4000;
  for (int i = 0; i < count; ++i) {
    const double h1 = 0.20 + 0.002 * random.normal();
    const double h2 = 0.05 + 0.001 * random.normal();
    const double e = std::sqrt(h2 / h1);
    sum += e;
    square += e * e;
  }
  const double sd = std::sqrt(square / count - sum / count * sum / count);
  EXPECT_NEAR(sd, 0.25 * std::hypot(0.01, 0.02), 0.03 * sd);
}

TEST(Heights, RepeatedDropsAreAveraged) {
  const Place place;
  auto request = place.request("h1,h2\n1,0.64\n1,0.36\n0.5,0.32\n1,0.49\n", ImportFormat::heights);
  request.map = {"drop_height=h1:m,rebound_height=h2:m"};
  request.average = true;
  request.drop_error = "1%";
  const Dataset made = recoil::import_points(request).dataset;
  ASSERT_EQ(made.points.size(), 2U);
  EXPECT_EQ(made.points[0].events, 3);
  EXPECT_NEAR(made.points[0].restitution, 0.7, 1e-12);
  // e = 0.8, 0.6, 0.7: standard error 0.1 / sqrt(3); the drop height's error is shared.
  EXPECT_NEAR(*made.points[0].restitution_sd, std::hypot(0.1 / std::sqrt(3.0), 0.5 * 0.7 * 0.01),
              1e-9);
  EXPECT_EQ(made.points[1].events, 1);
}

TEST(Heights, SpheresThatStayedAreCountedAndInNoMean) {
  const Place place;
  const std::string table = "h1,h2\n1,0\n1,0.64\n1,0.36\n1,0.49\n1,0.0025\n0.5,0\n0.25,0.2025\n";
  auto request = place.request(table, ImportFormat::heights);
  request.map = {"drop_height=h1:m,rebound_height=h2:m"};
  request.rebound_error = "2%";
  request.captured_below = 0.1;  // 0.0025 m is 0.05
  request.average = true;
  const Dataset averaged = recoil::import_points(request).dataset;
  ASSERT_EQ(averaged.points.size(), 3U);
  const auto& mixed = averaged.points[0];
  EXPECT_EQ(mixed.events, 5);
  EXPECT_EQ(mixed.captured, 2);
  EXPECT_NEAR(mixed.restitution, 0.7, 1e-12);
  EXPECT_NEAR(*mixed.restitution_sd, 0.1 / std::sqrt(3.0), 1e-9);
  EXPECT_EQ(averaged.points[1].events, 1);
  EXPECT_EQ(averaged.points[1].captured, 1);
  EXPECT_EQ(averaged.points[2].captured, 0);
  EXPECT_NEAR(*averaged.points[2].restitution_sd, 0.9 * 0.5 * 0.02, 1e-9);

  const Place other;
  auto single = other.request(table, ImportFormat::heights);
  single.map = request.map;
  const Dataset one_by_one = recoil::import_points(single).dataset;
  ASSERT_EQ(one_by_one.points.size(), 7U);
  EXPECT_EQ(one_by_one.points[0].captured, 1);
  EXPECT_EQ(one_by_one.points[0].events, 1);
  EXPECT_TRUE(one_by_one.points[1].counted);
  EXPECT_NEAR(one_by_one.points[4].restitution, 0.05, 1e-12) << "below no limit that was stated";
}

TEST(Intervals, OneRestitutionPerBounce) {
  const Place place;
  auto request =
      place.request("run,t\na,0.4\na,0.32\na,0.24\nb,0.2\nb,0.15\n", ImportFormat::intervals);
  request.map = {"launch=run,interval=t:s"};
  request.time_error = "1ms";
  request.gravity = "10";
  const auto result = recoil::import_points(request);
  const auto& points = result.dataset.points;
  ASSERT_EQ(points.size(), 3U);
  EXPECT_DOUBLE_EQ(points[0].incident_velocity, 2.0);  // g t / 2
  EXPECT_DOUBLE_EQ(points[0].restitution, 0.8);
  EXPECT_DOUBLE_EQ(points[1].restitution, 0.75);
  EXPECT_DOUBLE_EQ(points[2].restitution, 0.75);
  EXPECT_EQ(result.dataset.series, (std::vector<std::string>{"a", "b"}));
  // Times s1, s2, s3 of bounces with independent errors: e = (s3 - s2) / (s2 - s1), so that
  // var e = (tau / t)^2 (1 + (1 + e)^2 + e^2).
  EXPECT_NEAR(*points[0].restitution_sd, 0.001 / 0.4 * std::sqrt(1.0 + 1.8 * 1.8 + 0.64), 1e-9);
  EXPECT_NEAR(*points[0].velocity_sd, 5.0 * 0.001 * std::sqrt(2.0), 1e-9);
}

TEST(Intervals, TimesOfBouncesGiveTheSame) {
  const Place place;
  auto request = place.request("time\n10.0\n10.4\n10.72\n", ImportFormat::intervals);
  request.map = {"time=time:s"};
  request.gravity = "10";
  const Dataset made = recoil::import_points(request).dataset;
  ASSERT_EQ(made.points.size(), 1U);
  EXPECT_NEAR(made.points[0].restitution, 0.8, 1e-9);
  EXPECT_NEAR(made.points[0].incident_velocity, 2.0, 1e-9);
}

TEST(Intervals, AMissingBounceMakesNoRatio) {
  const Place place;
  auto request = place.request("n,t\n1,0.4\n2,0.36\n4,0.3\n5,0.27\n", ImportFormat::intervals);
  request.map = {"bounce=n,interval=t:s"};
  const auto result = recoil::import_points(request);
  ASSERT_EQ(result.dataset.points.size(), 2U);
  EXPECT_NEAR(result.dataset.points[1].restitution, 0.9, 1e-9);
  EXPECT_EQ(result.notes.front().remark, recoil::ImportRemark::bounces_missing);
  EXPECT_EQ(result.notes.front().count, 1U);
  // The same with times: the flight over the gap is no flight.
  const Place other;
  auto times =
      other.request("n,t\n1,0\n2,0.4\n3,0.76\n5,1.3\n6,1.6\n7,1.87\n", ImportFormat::intervals);
  times.map = {"bounce=n,time=t:s"};
  const Dataset made = recoil::import_points(times).dataset;
  ASSERT_EQ(made.points.size(), 2U);
  EXPECT_NEAR(made.points[0].restitution, 0.9, 1e-9);
  EXPECT_NEAR(made.points[1].restitution, 0.9, 1e-9);
}

TEST(Intervals, TwoLaunchesOfOneNameAreNotMixed) {
  const Place place;
  auto request = place.request("h,run,n,t\n8,1,1,0.25\n8,1,2,0.2\n16,1,1,0.36\n16,1,2,0.3\n",
                               ImportFormat::intervals);
  request.map = {"launch=run,bounce=n,interval=t:s"};
  EXPECT_THAT(complaint(request),
              HasSubstr("input.csv:4:6: bounce 1 of launch '1' appears here and on line 2"));
  request.map = {"launch=h+run,bounce=n,interval=t:s"};
  const auto points = recoil::import_points(request).dataset.points;
  ASSERT_EQ(points.size(), 2U);
  EXPECT_DOUBLE_EQ(points[0].restitution, 0.8);
}

TEST(Intervals, TheReleaseHeightIsChecked) {
  // Fall from 0.2 m with g = 10: V = 2. Restitution 0.8 throughout: flights 0.32, 0.256.
  const auto check = [](const std::string& height) {
    const Place place;
    auto request =
        place.request("t,h\n0.32," + height + "\n0.256," + height + "\n", ImportFormat::intervals);
    request.map = {"interval=t:s,release_height=h:m"};
    request.gravity = "10";
    const recoil::ImportNote note = recoil::import_points(request).notes.front();
    EXPECT_EQ(note.remark, recoil::ImportRemark::release_heights);
    return note.releases.at(0);
  };
  const recoil::ReleaseCheck right = check("0.2");
  EXPECT_DOUBLE_EQ(right.height, 0.2);
  EXPECT_NEAR(right.first, 0.8, 1e-12);
  EXPECT_NEAR(right.second, 0.8, 1e-12);
  EXPECT_NEAR(right.missing, 0.0, 1e-12);
  // With 0.16 m stated e^2 of the first bounce is 0.64 x 0.2 / 0.16, and the height lacks 40 mm.
  const recoil::ReleaseCheck wrong = check("0.16");
  EXPECT_NEAR(wrong.first, std::sqrt(0.8), 1e-12);
  EXPECT_NEAR(wrong.missing, 0.04, 1e-12);
}

TEST(Intervals, WhatIsAskedFor) {
  const Place place;
  EXPECT_THAT(complaint(place.request("x\n0.4\n0.3\n", ImportFormat::intervals)),
              HasSubstr("--map interval=COLUMN:s"));
  auto request = place.request("x\n0.4\n0.3\n", ImportFormat::intervals);
  request.map = {"interval=x"};
  EXPECT_THAT(complaint(request), HasSubstr("input.csv:1:1: the unit of 'x' is not stated"));
  request.map = {"interval=x:s"};
  request.gravity = "fast";
  EXPECT_THAT(complaint(request), HasSubstr("--gravity 'fast'"));
  request.gravity = "9.8";
  request.time_error = "3";
  EXPECT_THAT(complaint(request), HasSubstr("--time-error '3' is not a number with a unit"));
  auto doubled = place.request("t\n0.2\n0.4\n", ImportFormat::intervals);
  doubled.map = {"interval=t:s"};
  EXPECT_THAT(complaint(doubled), HasSubstr("input.csv:3:1: restitution = 2"));
  auto negative = place.request("h1,h2\n-1,2\n", ImportFormat::heights);
  negative.map = {"drop_height=h1:m,rebound_height=h2:m"};
  EXPECT_THAT(complaint(negative), HasSubstr("input.csv:2:1: drop_height = -1"));
  EXPECT_FALSE(place.has("made"));
}

}  // namespace
