// Drop and rebound heights, and times between bounces, with their errors.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

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
  request.gravity = 10.0;
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

TEST(Heights, DropsFromOneHeightShareItsError) {
  const Place place;
  auto request = place.request("h1,h2\n1,0.64\n1,0.5625\n0.5,0.32\n", ImportFormat::heights);
  request.map = {"drop_height=h1:m,rebound_height=h2:m"};
  request.drop_error = "10mm";
  request.rebound_error = "1mm";
  const Dataset made = recoil::import_points(request).dataset;
  const double velocity = std::sqrt(2.0 * 9.80665);
  EXPECT_NEAR(*made.points[0].setting_velocity_sd, velocity * 0.005, 1e-8);
  EXPECT_FALSE(made.points[0].velocity_sd.has_value());
  EXPECT_NEAR(*made.points[0].restitution_sd, 0.8 * 0.5 * 0.001 / 0.64, 1e-9);
  // A height from which one drop was made has errors of its own.
  EXPECT_FALSE(made.points[2].setting_velocity_sd.has_value());
  EXPECT_NEAR(*made.points[2].velocity_sd, velocity * std::sqrt(0.5) * 0.01, 1e-8);
}

TEST(Intervals, OneRestitutionPerBounce) {
  const Place place;
  auto request =
      place.request("run,t\na,0.4\na,0.32\na,0.24\nb,0.2\nb,0.15\n", ImportFormat::intervals);
  request.map = {"launch=run,interval=t:s"};
  request.time_error = "1ms";
  request.gravity = 10.0;
  const auto result = recoil::import_points(request);
  const auto& points = result.dataset.points;
  ASSERT_EQ(points.size(), 3U);
  EXPECT_DOUBLE_EQ(points[0].incident_velocity, 2.0);  // g t / 2
  EXPECT_DOUBLE_EQ(points[0].restitution, 0.8);
  EXPECT_DOUBLE_EQ(points[1].restitution, 0.75);
  EXPECT_DOUBLE_EQ(points[2].restitution, 0.75);
  EXPECT_EQ(result.dataset.series.size(), 1U);  // a launch is no series
  EXPECT_EQ(points[1].launch, "a");
  EXPECT_EQ(points[2].launch, "b");
  // Times s1, s2, s3 of bounces with independent errors: e = (s3 - s2) / (s2 - s1), so that
  // var e = (tau / t)^2 (1 + (1 + e)^2 + e^2).
  EXPECT_NEAR(*points[0].restitution_sd, 0.001 / 0.4 * std::sqrt(1.0 + 1.8 * 1.8 + 0.64), 1e-9);
  EXPECT_NEAR(*points[0].velocity_sd, 5.0 * 0.001 * std::sqrt(2.0), 1e-9);
}

TEST(Intervals, TimesOfBouncesGiveTheSame) {
  const Place place;
  auto request = place.request("time\n10.0\n10.4\n10.72\n", ImportFormat::intervals);
  request.map = {"time=time:s"};
  request.gravity = 10.0;
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

TEST(Intervals, ASeriesIsWhatTheUserCompares) {
  const Place place;
  auto request =
      place.request("ball,run,t\nA,1,0.4\nA,1,0.32\nB,1,0.2\nB,1,0.15\n", ImportFormat::intervals);
  request.map = {"series=ball,launch=run,interval=t:s"};
  const Dataset two = recoil::import_points(request).dataset;
  EXPECT_EQ(two.series, (std::vector<std::string>{"A", "B"}));
  const Place other;
  auto named = other.request("run,t\n1,0.4\n1,0.32\n2,0.2\n2,0.15\n", ImportFormat::intervals);
  named.map = {"launch=run,interval=t:s"};
  named.series = "ball";
  EXPECT_EQ(recoil::import_points(named).dataset.series, (std::vector<std::string>{"ball"}));
}

// Three launches from one height, e = 0.8: in columns the rows are level.
TEST(Intervals, LaunchesInColumnsAreRefusedWithTheMapThatReadsThem) {
  const std::string labelled =
      "Data,T 1,T 2,T 3\nBounce 1,400,401,399.5\nBounce 2,320,320.5,321\nBounce 3,256,256,256.5\n";
  const std::string bare = "T 1,T 2,T 3\n400,401,399.5\n320,320.5,321\n256,256,256.5\n";
  for (const std::string& text : {labelled, bare}) {
    const Place place;
    auto request = place.request(text, ImportFormat::intervals);
    request.map = {"interval=T 1+T 2+T 3:ms"};
    const std::string said = complaint(request);
    const std::string before = "--map ";
    const std::size_t at = said.find(before);
    ASSERT_NE(at, std::string::npos) << said;
    const std::size_t quoted = at + before.size();
    const bool in_quotes = said[quoted] == '\'';  // where the shell needs them
    const std::size_t first = in_quotes ? quoted + 1 : quoted;
    const std::size_t end = in_quotes ? said.find('\'', first) : said.find_first_of(" ;)", first);
    request.map = {said.substr(first, end - first)};
    request.transpose = true;
    const Dataset made = recoil::import_points(request).dataset;
    ASSERT_EQ(made.points.size(), 6U);
    EXPECT_EQ(made.series.size(), 1U);
    EXPECT_NEAR(made.points[0].restitution, 0.8, 1e-9);
    EXPECT_NEAR(made.points[1].restitution, 0.8, 1e-9);
    EXPECT_EQ(made.points[2].launch, "T 2");
  }
  // Launches in rows, from heights in any order, are read.
  const Place place;
  auto rows = place.request(
      "run,t1,t2,t3\n1,0.40,0.32,0.256\n2,0.39,0.312,0.25\n"
      "3,0.38,0.304,0.243\n",
      ImportFormat::intervals);
  rows.map = {"interval=t1+t2+t3:s"};
  EXPECT_EQ(recoil::import_points(rows).dataset.points.size(), 6U);
}

// In vacuum e = sqrt(0.5), 0.8 and 0.7; a ball of 2.7 g and 40 mm loses more to the air than one of
// 1140 kg/m3.
TEST(Bounces, NeedNoMaterials) {
  const Place place;
  auto request = place.request("ball,h1,h2\na,1,0.5\nb,1,0.64\na,1,0.49\n", ImportFormat::heights);
  request.map = {"series=ball,drop_height=h1:m,rebound_height=h2:m"};
  request.diameters = {"40mm"};
  request.particle.clear();
  request.surface.clear();
  request.conditions = {"ambient_pressure=0"};
  const Dataset vacuum = recoil::read_bounces(request, 1140.0).dataset;
  ASSERT_EQ(vacuum.points.size(), 3U);
  EXPECT_EQ(vacuum.series, (std::vector<std::string>{"a", "b"}));
  EXPECT_NEAR(vacuum.points[0].restitution, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(vacuum.points[1].restitution, 0.8, 1e-12);
  EXPECT_EQ(vacuum.points[2].series, 0U);
  request.conditions = {"ambient_pressure=101325"};
  const double heavy = recoil::read_bounces(request, 1140.0).dataset.points[1].restitution;
  const double light = recoil::read_bounces(request, 80.57).dataset.points[1].restitution;
  EXPECT_GT(heavy, 0.8);
  EXPECT_GT(light, heavy + 0.01);
  EXPECT_FALSE(std::filesystem::exists(request.into));
}

TEST(Flights, OneImpossibleImpactIsLeftOutAndMostOfThemAreRefused) {
  const auto heights = [](const std::string& text) {
    const Place place;
    auto request = place.request(text, ImportFormat::heights);
    request.map = {"drop_height=a:m,rebound_height=b:m"};
    try {
      return recoil::import_points(request).dataset.points.size();
    } catch (const recoil::InputError& error) {
      EXPECT_EQ(error.where().line, 2);
      return std::size_t{0};
    }
  };
  EXPECT_EQ(heights("a,b\n1,0.5\n1,1.6\n1,0.52\n1,0.49\n"), 3U);
  EXPECT_EQ(heights("a,b\n1,1.1\n1,1.12\n1,0.9\n"), 0U);
  EXPECT_EQ(heights("a,b\n0.8,1\n0.5,1\n0.7,1\n"), 0U);  // exchanged
  const Place place;
  auto timed =
      place.request("run,t\n1,0.4\n1,0.32\n1,0.5\n1,0.4\n2,0.3\n2,0.24\n", ImportFormat::intervals);
  timed.map = {"launch=run,interval=t:s"};
  const auto result = recoil::import_points(timed);
  EXPECT_EQ(result.dataset.points.size(), 2U);
  EXPECT_TRUE(std::ranges::any_of(result.notes, [](const recoil::ImportNote& note) {
    return note.remark == recoil::ImportRemark::impossible_left_out && note.names.size() == 1;
  }));
}

TEST(Intervals, TheReleaseHeightIsChecked) {
  // Fall from 0.2 m with g = 10: V = 2. Restitution 0.8 throughout: flights 0.32, 0.256.
  const auto check = [](const std::string& height) {
    const Place place;
    auto request =
        place.request("t,h\n0.32," + height + "\n0.256," + height + "\n", ImportFormat::intervals);
    request.map = {"interval=t:s,release_height=h:m"};
    request.gravity = 10.0;
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
  request.time_error = "3 kg";
  EXPECT_THAT(complaint(request), HasSubstr("unknown unit 'kg' of --time-error"));
  request.time_error = "soon";
  EXPECT_THAT(complaint(request), HasSubstr("--time-error 'soon' is not a number"));
  auto doubled = place.request("t\n0.2\n0.4\n", ImportFormat::intervals);
  doubled.map = {"interval=t:s"};
  EXPECT_THAT(complaint(doubled), HasSubstr("input.csv:3:1: restitution = 2"));
  auto negative = place.request("h1,h2\n-1,2\n", ImportFormat::heights);
  negative.map = {"drop_height=h1:m,rebound_height=h2:m"};
  EXPECT_THAT(complaint(negative), HasSubstr("input.csv:2:1: drop_height = -1"));
  EXPECT_FALSE(place.has("made"));
}

/// One launch with e = 0.9 at every bounce, of which one interval is not known.
std::vector<recoil::ImportNote> import_launch(const Place& place, const std::string& text,
                                              const std::string& map, Dataset& made,
                                              const std::string& drop_error = "") {
  auto request = place.request(text, ImportFormat::intervals);
  request.map = {map};
  request.time_error = "1ms";
  request.drop_error = drop_error;
  const auto result = recoil::import_points(request);
  made = result.dataset;
  return result.notes;
}

std::vector<double> restitutions(const Dataset& dataset) {
  std::vector<double> e;
  for (const auto& point : dataset.points) e.push_back(point.restitution);
  return e;
}

TEST(Intervals, AMissingIntervalSplitsTheLaunch) {
  const auto near = [](std::vector<double> e) {
    return testing::Pointwise(testing::DoubleNear(1e-6), e);
  };
  Dataset made;
  const Place place;
  import_launch(place, "run,t\n1,0.600\n1,0.540\n1,\n1,0.4374\n1,0.39366\n",
                "launch=run,interval=t:s", made);
  EXPECT_THAT(restitutions(made), near({0.9, 0.9}));
  const Place numbered;
  import_launch(numbered, "run,b,t\n1,1,0.600\n1,2,0.540\n1,4,0.4374\n1,5,0.39366\n",
                "launch=run,bounce=b,interval=t:s", made);
  EXPECT_THAT(restitutions(made), near({0.9, 0.9}));
  const Place times;
  import_launch(times, "run,t\n1,0\n1,0.600\n1,1.140\n1,\n1,2.0634\n1,2.45706\n1,2.811354\n",
                "launch=run,time=t:s", made);
  EXPECT_THAT(restitutions(made), near({0.9, 0.9}));
}

TEST(Intervals, AMissingBounceIsCalledOne) {
  const Place place;
  auto request =
      place.request("x,t\n1,0\n1,0.600\n1,1.140\n1,2.0634\n1,2.45706\n", ImportFormat::intervals);
  request.map = {"time=t:s"};
  EXPECT_THAT(complaint(request), testing::AllOf(HasSubstr("input.csv:5:3: restitution = 1.71"),
                                                 HasSubstr("a bounce between them is missing"),
                                                 HasSubstr("put a row with an empty time")));
  // In a launch that is known, the two ratios of the long flight are left out: 0.9 stays.
  const Place known;
  Dataset rest;
  import_launch(known, "run,t\n1,0\n1,0.600\n1,1.140\n1,2.0634\n1,2.45706\n", "launch=run,time=t:s",
                rest);
  ASSERT_EQ(rest.points.size(), 1U);
  EXPECT_NEAR(rest.points[0].restitution, 0.9, 1e-9);
  // An interval that is not in the table cannot be known, but its e is the square of the others.
  Dataset made;
  const Place gap;
  const auto notes = import_launch(gap, "run,t\n1,0.600\n1,0.540\n1,0.4374\n1,0.39366\n",
                                   "launch=run,interval=t:s", made);
  const auto suspected = [](const std::vector<recoil::ImportNote>& all) {
    return std::count_if(all.begin(), all.end(), [](const recoil::ImportNote& note) {
      return note.remark == recoil::ImportRemark::bounces_suspected;
    });
  };
  EXPECT_EQ(suspected(notes), 1);
  // e that falls with the velocity, as of a real ball, is no gap.
  const Place real;
  EXPECT_EQ(suspected(import_launch(real, "t\n0.6\n0.48\n0.39\n0.33\n0.29\n0.26\n", "interval=t:s",
                                    made)),
            0);
}

TEST(Intervals, ReleaseHeightsArePointsUnlessBouncesBeforeTheFirstAreMissing) {
  // e = 0.81, dropped from 2 m and from 1.2 m in vacuum, g = 9.80665: times of the bounces; the
  // second recording begins after two bounces.
  const double g = 9.80665;
  const auto times = [&](const std::string& run, double height, int skipped) {
    std::string text;
    double time = std::sqrt(2.0 * height / g);
    double speed = 0.81 * std::sqrt(2.0 * g * height);
    for (int k = 0; k < 6; ++k) {
      if (k >= skipped) text += fmt::format("{},{:.9f},{}\n", run, time, height);
      time += 2.0 * speed / g;
      speed *= 0.81;
    }
    return text;
  };
  const std::string table = "run,t,h\n" + times("a", 2.0, 0) + times("b", 1.2, 2);
  Dataset made;
  const Place place;
  const auto notes =
      import_launch(place, table, "launch=run,time=t:s,release_height=h:m", made, "4mm");
  ASSERT_EQ(made.points.size(), 5U + 2U);
  EXPECT_NEAR(made.points[0].incident_velocity, std::sqrt(2.0 * g * 2.0), 1e-8);
  EXPECT_NEAR(made.points[0].restitution, 0.81, 1e-7);
  // sd(V) / V = sd(h) / (2 h); e = g t / (2 V) with the flight t of two instants of 1 ms / each.
  const double flight = 2.0 * 0.81 * std::sqrt(2.0 * g * 2.0) / g;
  EXPECT_NEAR(*made.points[0].velocity_sd, 0.001 * std::sqrt(2.0 * g * 2.0), 1e-8);
  EXPECT_NEAR(*made.points[0].restitution_sd,
              0.81 * std::hypot(0.001, 0.001 * std::sqrt(2.0) / flight), 1e-8);
  const auto missed = std::find_if(notes.begin(), notes.end(), [](const recoil::ImportNote& note) {
    return note.remark == recoil::ImportRemark::first_bounces_missed;
  });
  ASSERT_NE(missed, notes.end());
  EXPECT_EQ(missed->names, std::vector<std::string>{"b (2)"});
  // Without an error of the height the release is no point beside those that have errors.
  const Place unstated;
  import_launch(unstated, table, "launch=run,time=t:s,release_height=h:m", made);
  EXPECT_EQ(made.points.size(), 4U + 2U);
}

}  // namespace
