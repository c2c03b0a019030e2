// WebPlotDigitizer's CSV, and what an error of the reading is worth on each kind of axis.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "import_folder.hpp"

namespace {

using import_folder::complaint;
using import_folder::Place;
using recoil::Dataset;
using recoil::ImportFormat;
using testing::HasSubstr;

constexpr auto kFormat = ImportFormat::webplotdigitizer;

const char* const kTwoSeries =
    "small,,large,\n"
    "X,Y,X,Y\n"
    "2.0, 0.5, 1.0, 0.4\n"
    "10, 0.8, 9.0, 0.9\n"
    ",,80, 0.7\n";

TEST(Digitised, SeveralSeriesOfDifferentLength) {
  const Place place;
  auto request = place.request(kTwoSeries, kFormat);
  request.diameters = {"small=2.58um", "large=4.9 um"};
  request.provenance.reset();
  const Dataset made = recoil::import_points(request).dataset;
  EXPECT_EQ(made.provenance, recoil::Provenance::digitised);
  EXPECT_EQ(made.series, (std::vector<std::string>{"small", "large"}));
  ASSERT_EQ(made.points.size(), 5U);
  EXPECT_DOUBLE_EQ(made.points[0].diameter, 2.58e-6);
  EXPECT_DOUBLE_EQ(made.points[4].diameter, 4.9e-6);
  EXPECT_DOUBLE_EQ(made.points[4].incident_velocity, 80.0);
  EXPECT_DOUBLE_EQ(made.points[4].restitution, 0.7);
  EXPECT_FALSE(made.points[0].restitution_sd.has_value());
  // What was returned is what stands in the folder.
  EXPECT_EQ(recoil::load_dataset(place.folder() / "made").sha256, made.sha256);
}

TEST(Digitised, ErrorsOfAReadingOnBothKindsOfAxis) {
  const Place place;
  auto request = place.request(kTwoSeries, kFormat);
  request.axes = {"x=log,1,100", "y=linear,0,1.2"};
  request.reading_error = "0.5%";
  const Dataset made = recoil::import_points(request).dataset;
  // 0.5 % of two decades is a factor exp(0.005 ln 100); 0.5 % of 1.2 is 0.006.
  EXPECT_NEAR(*made.points[1].velocity_sd, 10.0 * 0.005 * std::log(100.0), 1e-9);
  EXPECT_NEAR(*made.points[1].restitution_sd, 0.006, 1e-12);
  EXPECT_NEAR(*made.points[4].velocity_sd, 80.0 * 0.005 * std::log(100.0), 1e-8);
}

TEST(Digitised, PixelsNeedTheLengthOfTheAxis) {
  const Place place;
  auto request = place.request(kTwoSeries, kFormat);
  request.axes = {"x=linear,0,100,800px", "y=linear,0,1"};
  request.reading_error = "2px";
  EXPECT_THAT(complaint(request), HasSubstr("the length of --axis y in pixels"));
  request.axes[1] = "y=linear,0,1,500px";
  const Dataset made = recoil::import_points(request).dataset;
  EXPECT_NEAR(*made.points[0].velocity_sd, 0.25, 1e-9);
  EXPECT_NEAR(*made.points[0].restitution_sd, 0.004, 1e-12);
}

TEST(Digitised, ScatterOfTheExperimentIsAddedInQuadrature) {
  const Place place;
  auto request = place.request(kTwoSeries, kFormat);
  request.axes = {"x=log,1,100", "y=linear,0,1"};
  request.reading_error = "1%";
  request.scatter = "5%";
  const Dataset made = recoil::import_points(request).dataset;
  EXPECT_NEAR(*made.points[1].restitution_sd, std::hypot(0.01, 0.04), 1e-9);
}

TEST(Digitised, ReboundVelocitiesInOtherUnits) {
  const Place place;
  auto request = place.request("100, 50\n200, 150\n", kFormat);  // no header: one series
  request.map = {"incident_velocity=x:cm/s,rebound_velocity=y:cm/s"};
  request.series = "balls";
  const Dataset made = recoil::import_points(request).dataset;
  EXPECT_EQ(made.series.front(), "balls");
  EXPECT_DOUBLE_EQ(made.points[1].incident_velocity, 2.0);
  EXPECT_DOUBLE_EQ(made.points[1].restitution, 0.75);
}

TEST(Digitised, BallsAreWrittenInMillimetresFromTheFirstOn) {
  const Place place;
  auto request = place.request(kTwoSeries, kFormat);
  for (const auto& [diameters, unit] :
       std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"small=1mm", "large=2mm"}, "mm"}, {{"small=0.99mm", "large=2mm"}, "um"}}) {
    request.diameters = diameters;
    request.into = place.folder() / unit;
    EXPECT_NEAR(recoil::import_points(request).dataset.points[4].diameter, 2e-3, 1e-12);
    EXPECT_THAT(place.read(unit + "/points.csv"),
                HasSubstr(unit == "mm" ? "large,2," : "large,2000,"));
  }
}

TEST(Digitised, OnlyTheSeriesWhoseNameWasReadIsSaidToBe) {
  const Place place;
  auto request = place.request("4.90um,,large,\nX,Y,X,Y\n2,0.5,1,0.4\n3,0.6,2,0.5\n", kFormat);
  request.diameters = {"large=8um"};
  const auto result = recoil::import_points(request);
  std::vector<std::string> named;
  for (const auto& note : result.notes) {
    if (note.remark == recoil::ImportRemark::diameters_from_names) named = note.names;
  }
  EXPECT_EQ(named, std::vector<std::string>{"4.90um"});
}

TEST(Digitised, DiametersMayStandInTheNames) {
  const Place place;
  auto request = place.request("d = 2.58 um,,4.90um,\nX,Y,X,Y\n2,0.5,1,0.4\n", kFormat);
  request.diameters.clear();
  const auto result = recoil::import_points(request);
  EXPECT_DOUBLE_EQ(result.dataset.points[0].diameter, 2.58e-6);
  EXPECT_DOUBLE_EQ(result.dataset.points[1].diameter, 4.9e-6);
  EXPECT_TRUE(std::any_of(result.notes.begin(), result.notes.end(), [](const auto& note) {
    return note.remark == recoil::ImportRemark::diameters_from_names && !note.names.empty();
  }));
}

TEST(Digitised, MarksOnTheAxisAreCapturesWhenAskedFor) {
  const Place place;
  auto request = place.request("1,-0.002\n2,0.5\n", kFormat);
  EXPECT_THAT(complaint(request), HasSubstr("input.csv:1:3: restitution = -0.002"));
  request.captured_below = 0.01;
  const Dataset made = recoil::import_points(request).dataset;
  EXPECT_TRUE(made.points[0].all_captured());
  EXPECT_FALSE(made.points[1].all_captured());
}

TEST(Digitised, SemicolonsAndMistakes) {
  const Place place;
  EXPECT_EQ(complaint(place.request("s;\nX;Y\n2;0.5\n", kFormat)), "no error");
  const Place other;
  EXPECT_THAT(complaint(other.request("s,\nX,Y\n2,abc\n", kFormat)),
              HasSubstr("input.csv:3:3: 'abc' is not a number"));
  EXPECT_THAT(complaint(other.request("V,e\n2,0.5\n", kFormat)),
              HasSubstr("this is not WebPlotDigitizer's CSV"));
  EXPECT_THAT(complaint(other.request("s,\nX,Y\n2,\n", kFormat)),
              HasSubstr("a point of 's' lacks x or y"));
  auto request = other.request("2,0.5\n", kFormat);
  request.reading_error = "0.5%";
  EXPECT_THAT(complaint(request), HasSubstr("--reading-error without --axis x"));
  request.axes = {"x=log,0,100", "y=linear,0,1"};
  EXPECT_THAT(complaint(request), HasSubstr("a logarithmic axis begins above zero"));
  // A restitution that is too large is told where the point came from.
  EXPECT_THAT(complaint(other.request("s,\nX,Y\n2,0.5\n3,1.5\n", kFormat)),
              HasSubstr("input.csv:4:1: restitution = 1.5"));
  EXPECT_FALSE(other.has("made"));
}

TEST(Digitised, ErrorBarsAreASecondSeries) {
  const Place place;
  const std::string text =
      "balls,,upper,,lower,\nX,Y,X,Y,X,Y\n2,0.5,4.01,0.85,2,0.48\n4,0.8,2.01,0.54,4,0.77\n";
  auto request = place.request(text, kFormat);
  request.error_series = {"balls=upper,lower"};
  const Dataset made = recoil::import_points(request).dataset;
  ASSERT_EQ(made.points.size(), 2U);
  EXPECT_NEAR(*made.points[0].restitution_sd, 0.5 * (0.04 + 0.02), 1e-12);
  EXPECT_NEAR(*made.points[1].restitution_sd, 0.5 * (0.05 + 0.03), 1e-12);
  request.error_series = {"balls=top"};
  request.into = place.folder() / "other";
  EXPECT_THAT(complaint(request), HasSubstr("there is no series 'top'"));
}

}  // namespace
