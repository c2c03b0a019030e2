// What the line below the headline says of e, with and without adhesion.
#include "report/words_restitution.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "estimate/restitution_summary.hpp"
#include "example_analysis.hpp"
#include "experiment/import.hpp"
#include "report/format.hpp"
#include "support/temporary_folder.hpp"

namespace recoil {
namespace {

using testing::HasSubstr;
using testing::Not;

struct Row {
  std::size_t series;
  double diameter_um, velocity, restitution;
};

Dataset dataset_of(const std::vector<Row>& rows) {
  Dataset data;
  data.id = "made";
  data.series = {"a", "b"};
  for (const Row& row : rows) {
    ImpactPoint point;
    point.series = row.series;
    point.diameter = row.diameter_um * 1e-6;
    point.incident_velocity = row.velocity;
    point.restitution = row.restitution;
    point.restitution_sd = 0.01;
    data.points.push_back(point);
  }
  return data;
}

std::string text_of(const Dataset& data, bool adhesion) {
  FitResult fitted = sample::four_diameters().fitted;
  ImpactModel& model = fitted.model;
  EXPECT_TRUE(adheres_anywhere(model));
  if (!adhesion) {
    model.slots[model.slot_adhesion.front()].free = false;
    model.contacts.front().adhesion_force = 0.0;
    EXPECT_FALSE(adheres_anywhere(model));
  }
  return plain_text(join(restitution_sentences({data}, fitted), " "));
}

TEST(FrictionWords, SayTheCoefficientOrItsLimit) {
  Dataset data = dataset_of({{0, 5.0, 1.0, 0.8}, {0, 5.0, 2.0, 0.8}, {0, 5.0, 3.0, 0.8}});
  EXPECT_TRUE(friction_sentences({data}).empty());
  const auto set = [&](std::size_t i, double tangent, double e_t) {
    data.points[i].incidence_angle = std::atan(tangent);
    data.points[i].tangential_restitution = e_t;
  };
  // 1.8 mu / tan(angle) of mu = 0.1: 0.18, 0.09 and 0.36, which is above 2/7
  set(0, 1.0, 1.0 - 0.18);
  EXPECT_EQ(plain_text(join(friction_sentences({data}), " ")),
            "Friction: mu = 0.100 from the tangential restitutions of 1 point, of which 1 slid to "
            "the end (one point gives no interval).");
  set(1, 2.0, 1.0 - 0.09);
  set(2, 0.5, 5.0 / 7.0);
  EXPECT_EQ(plain_text(join(friction_sentences({data}), " ")),
            "Friction: mu = 0.100 [0.100, 0.100] from the tangential restitutions of 3 points, of "
            "which 2 slid to the end.");
  set(0, 1.0, 5.0 / 7.0);
  set(1, 2.0, 5.0 / 7.0);  // 2/7 tan / 1.8 = 0.317
  EXPECT_EQ(plain_text(join(friction_sentences({data}), " ")),
            "Friction: the tangential restitutions of 3 points agree with rolling, so only a lower "
            "limit is known, mu at least 0.32.");
}

TEST(RestitutionWords, SayWhatWasMeasuredWithAdhesion) {
  Dataset data = dataset_of({{0, 2.0, 1.318, 0.3669},
                             {0, 2.0, 1.0, 0.0},
                             {0, 2.0, 9.947, 0.868},
                             {1, 5.0, 0.4, 0.95},
                             {1, 5.0, 8.0, 0.90}});
  data.points[1].captured = 1;
  const std::string text = text_of(data, true);
  EXPECT_EQ(text,
            "e rises from 0.37 at 1.3 m/s to 0.87 at 9.9 m/s (2 um); falls from 0.95 at 0.4 m/s to "
            "0.90 at 8 m/s (5 um).");
  data.points.push_back(data.points[2]);
  data.points.back().incident_velocity = 27.353;
  data.points.back().restitution = 0.8279;
  EXPECT_THAT(text_of(data, true),
              HasSubstr("to 0.87 at 9.9 m/s and falls to 0.83 at 27 m/s (2 um)"));
}

// Six settings with e = 0.8, and one 0.05 below. A law that follows it too leaves nothing to say.
TEST(RestitutionWords, ASettingThatTheFittedLawFollowsIsNotApart) {
  std::vector<Row> rows;
  FitResult fitted = sample::four_diameters().fitted;
  for (ParameterSlot& slot : fitted.model.slots) slot.free = false;
  fitted.model.contacts.front().adhesion_force = 0.0;
  ASSERT_FALSE(adheres_anywhere(fitted.model));
  fitted.data.points.clear();
  for (int k = 0; k < 7; ++k) {
    for (const double off : {-0.002, 0.002}) {
      rows.push_back({0, 30.0, 1.0 + 0.2 * k, (k == 3 ? 0.75 : 0.8) + off});
    }
  }
  Dataset data = dataset_of(rows);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ImpactPoint& point = data.points[i];
    point.line = static_cast<int>(i) + 2;
    point.restitution_sd = 0.002;
    Observation& seen = fitted.data.points.emplace_back();
    seen.line = point.line;
    seen.restitution = point.restitution;
  }
  fitted.prediction.assign(rows.size(), 0.8);
  const std::size_t all = restitution_sentences({data}, false).size();
  EXPECT_EQ(restitution_sentences({data}, fitted).size(), all);
  for (const std::size_t i : {6U, 7U}) fitted.prediction[i] = 0.76;
  EXPECT_EQ(restitution_sentences({data}, fitted).size(), all - 1);
}

TEST(RestitutionWords, ShowTheSmallestAndTheLargestOfManySizes) {
  std::vector<Row> rows;
  for (const double um : {1.0, 2.0, 3.0, 4.0, 5.0}) {
    rows.push_back({0, um, 1.0, 0.5});
    rows.push_back({0, um, 3.0, 0.8});
  }
  EXPECT_THAT(text_of(dataset_of(rows), true),
              AllOf(HasSubstr("(1 um)"), HasSubstr("(5 um); smallest and largest of 5 sizes."),
                    Not(HasSubstr("(3 um)"))));
}

TEST(RestitutionWords, CallSizesSizesAndSayWhichErrorIsMissing) {
  Dataset data = dataset_of(
      {{0, 2.0, 1.0, 0.80}, {0, 2.0, 3.0, 0.81}, {1, 5.0, 1.0, 0.70}, {1, 5.0, 3.0, 0.70}});
  EXPECT_THAT(text_of(data, false),
              AllOf(HasSubstr("Mean e: a 2 um 0.805"), HasSubstr("b 5 um 0.700"),
                    Not(HasSubstr("differ")), Not(HasSubstr("no error"))));
  data.points[2].restitution_sd.reset();
  EXPECT_THAT(text_of(data, false),
              HasSubstr("1 of 4 points states no error and counts with the median of the others."));
  for (ImpactPoint& point : data.points) point.diameter = 2e-6;
  EXPECT_THAT(text_of(data, false), HasSubstr("The series differ in e"));
}

// In vacuum with e = 0.9, where 120 cm was 114 cm: the summary finds the height in the name of its
// setting, and what it lacks.
TEST(RestitutionSummary, NamesAWrongHeightAsTheFileHasIt) {
  std::string rows = "h1,h2\n";
  for (const double height : {30.0, 50.0, 70.0, 90.0, 105.0, 120.0, 150.0}) {
    for (const double off : {-0.2, 0.0, 0.2}) {
      const double fallen = height == 120.0 ? 114.0 : height;
      rows += fmt::format("{},{}\n", height, 0.81 * fallen + off);
    }
  }
  const support::TemporaryFolder place;
  ImportRequest request;
  request.file = place.path() / "input.csv";
  request.format = ImportFormat::heights;
  support::write_text(request.file, rows);
  request.map = {"drop_height=h1:cm,rebound_height=h2:cm"};
  request.diameters = {"40mm"};
  request.rebound_error = "2mm";
  request.conditions = {"ambient_pressure=0"};
  const auto found = summarise_restitution({read_bounces(request, 80.57).dataset}).outlier;
  ASSERT_TRUE(found && found->height);
  EXPECT_NEAR(*found->height, 1.2, 1e-9);
  EXPECT_NEAR(found->height_error, -0.05, 0.005);
}

}  // namespace
}  // namespace recoil
