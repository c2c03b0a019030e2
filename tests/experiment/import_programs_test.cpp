// Files as programs write them, without --map: phyphox, Tracker, Logger Pro and Graphical Analysis.
// Names of columns: phyphox-experiments (inelastic_collision.phyphox, acoustic_stopwatch.phyphox).
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "import_folder.hpp"

namespace {

using import_folder::Place;
using recoil::ImportFormat;
using recoil::ImportResult;

constexpr double gravity = 9.80665;

/// Heights of a ball that falls from 1 m and bounces with e = 0.8 in vacuum, at 120 per second.
double height(double time) {
  double speed = std::sqrt(2.0 * gravity);
  double start = -speed / gravity;  // of a flight that would end in the first impact
  while (time > start + 2.0 * speed / gravity) {
    start += 2.0 * speed / gravity;
    speed *= 0.8;
  }
  const double since = time - start;
  return speed * since - 0.5 * gravity * since * since;
}

ImportResult import_text(const std::string& text, ImportFormat format, bool comma = false) {
  const Place place;
  recoil::ImportRequest request = place.request(text, format);
  request.decimal_comma = comma;
  request.diameters = {"40mm"};
  request.conditions = {"ambient_pressure=0"};
  return recoil::import_points(request);
}

void expect_restitution(const ImportResult& result, std::size_t count, double e, double error) {
  ASSERT_EQ(result.dataset.points.size(), count);
  for (const recoil::ImpactPoint& point : result.dataset.points) {
    EXPECT_NEAR(point.restitution, e, error);
  }
}

std::string track(const std::string& head, const std::string& row) {
  std::string text = head;
  for (int k = 0; k < 260; ++k) {
    const double t = k / 120.0;
    text += fmt::format(fmt::runtime(row), fmt::arg("t", t), fmt::arg("y", height(t)));
  }
  return text;
}

TEST(Programs, TracksOfTrackerAndVernierNeedNoMap) {
  struct Case {
    const char *head, *row;
  };
  const Case cases[] = {
      {"mass_A\nt\tx\ty\n", "{t:.6E}\t0\t{y:.9E}\n"},
      {"mass_A,,\nt,x,y\n", "{t},0,{y:.9f}\n"},
      {"Latest: Time (s),Latest: Position (m)\n", "{t},{y:.9f}\n"},
      {"Data Set 1:Time(s),Data Set 1:Distance(m),Data Set 1:Velocity(m/s)\n", "{t},{y:.9f},0\n"},
      {"Vernier Format 2\nball.cmbl 11/27/2023 12:00:00 .\nRun 1\nTime\tPosition\nt\tx\ns\tm\n\n",
       "{t}\t{y:.9f}\n"},
      {"Vernier Format 2\nball.cmbl 11/27/2023 12:00:00 .\nRun 1\nTime\tPosition\ns\tm\n\n",
       "{t}\t{y:.9f}\n"}};
  for (const Case& one : cases) {
    SCOPED_TRACE(one.head);
    expect_restitution(import_text(track(one.head, one.row), ImportFormat::track), 3, 0.8, 1e-6);
  }
}

TEST(Programs, RunsSideBySideAreLaunches) {
  const ImportResult result =
      import_text(track("Run 1: Time (s),Run 1: Position (m),Run 2: Time (s),Run 2: Position (m)\n",
                        "{t},{y:.9f},{t},{y:.9f}\n"),
                  ImportFormat::track);
  expect_restitution(result, 6, 0.8, 1e-6);
}

TEST(Programs, TimesOfPhyphoxNeedNoMap) {
  // Flights of 0.6 s, 0.54 s, ... (e = 0.9). The sixth impact was not heard: phyphox writes 0.
  const std::string collision =
      "\"Bounce 0 (s)\",\"Height 0 (m)\",\"Bounce 1 (s)\",\"Height 1 (m)\",\"Energy 1\","
      "\"Bounce 2 (s)\",\"Height 2 (m)\",\"Energy 2\",\"Bounce 3 (s)\",\"Height 3 (m)\","
      "\"Energy 3\",\"Bounce 4 (s)\",\"Height 4 (m)\",\"Energy 4\",\"Bounce 5 (s)\","
      "\"Height 5 (m)\",\"Energy 5\"\n"
      "1,0,1.6,0,1,2.14,0,0,2.626,0,0,3.0634,0,0,0,0,0\n";
  expect_restitution(import_text(collision, ImportFormat::intervals), 3, 0.9, 1e-9);
  const std::string stopwatch =
      "Start (s);Stop 1 (s);Stop 2 (s);Stop 3 (s);Stop 4 (s);Stop 5 (s)\n"
      "1,0;1,6;2,14;2,626;3,0634;3,45706\n";
  expect_restitution(import_text(stopwatch, ImportFormat::intervals, true), 4, 0.9, 1e-9);
  const std::string all =
      "Event time (s)\tInterval (s)\n1.0\t0.6\n1.6\t0.54\n2.14\t0.486\n2.626\tNaN\n";
  expect_restitution(import_text(all, ImportFormat::intervals), 2, 0.9, 1e-9);
}

TEST(Programs, SeveralFilesAreLaunches) {
  const Place place;
  recoil::ImportRequest request =
      place.request("t\n1\n1.6\n2.14\n2.626\n", ImportFormat::intervals);
  place.write("b.csv", "t\n0\n0.5\n0.9\n");
  request.more_files = {place / "b.csv"};
  request.map = {"time=t:s"};
  const ImportResult result = recoil::import_points(request);
  std::vector<std::string> launches;
  for (const recoil::ImpactPoint& point : result.dataset.points) launches.push_back(point.launch);
  EXPECT_THAT(launches, testing::ElementsAre("input", "input", "b"));
  EXPECT_NEAR(result.dataset.points.back().restitution, 0.8, 1e-9);
  place.write("b.csv", "t\n0\n0.5\n0.3\n");
  request.replace = true;
  EXPECT_THAT(import_folder::complaint(request), testing::HasSubstr("b.csv:4:"));
}

}  // namespace
