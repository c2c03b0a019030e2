#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <regex>

#include "core/error.hpp"
#include "example_analysis.hpp"
#include "json/fit_file.hpp"
#include "report/result_json.hpp"

namespace recoil {
namespace {

using PlainJson = nlohmann::json;
using testing::HasSubstr;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Every key that people script against, as JSON pointers for the example.
const char* const promised[] = {"/dataset/id",
                                "/dataset/provenance",
                                "/dataset/points",
                                "/dataset/sha256",
                                "/parameters/C_H/value",
                                "/parameters/C_H/unit",
                                "/parameters/C_H/free",
                                "/parameters/C_H/at_bound",
                                "/parameters/C_H/std_error",
                                "/parameters/C_H/intervals/wald",
                                "/parameters/C_H/intervals/profile",
                                "/parameters/C_H/intervals/percentile",
                                "/parameters/C_H/intervals/bca",
                                "/parameters/C_H/intervals/studentized",
                                "/parameters/C_H/recommended/interval",
                                "/parameters/C_H/recommended/why",
                                "/parameters/C_A/value",
                                "/parameters/f0/value",
                                "/derived/capture_velocity/0/diameter_um",
                                "/derived/capture_velocity/0/value",
                                "/derived/capture_velocity/0/interval",
                                "/goodness/chi2",
                                "/goodness/dof",
                                "/goodness/p_value",
                                "/goodness/rmse",
                                "/identifiability/verdict",
                                "/identifiability/text",
                                "/bootstrap/scheme",
                                "/bootstrap/replicates",
                                "/bootstrap/failed",
                                "/bootstrap/seed",
                                "/two_point/low_point/incident_velocity",
                                "/two_point/low_point/restitution",
                                "/two_point/low_point/diameter_um",
                                "/two_point/high_point/incident_velocity",
                                "/two_point/parameters/C_H/value",
                                "/two_point/parameters/C_A/value",
                                "/two_point/rmse",
                                "/two_point/held_out_rmse",
                                "/full/rmse",
                                "/full/held_out_rmse",
                                "/curve/0/series",
                                "/curve/0/diameter_um",
                                "/curve/0/incident_velocity",
                                "/curve/0/restitution",
                                "/curve/0/band",
                                "/format_version",
                                "/recoil_version",
                                "/options/seed",
                                "/datasets/0/id",
                                "/provenance_sentence",
                                "/warnings",
                                "/starts/0/chi2",
                                "/covariance/C_H/C_A",
                                "/correlation/C_H/C_A",
                                "/noise/variance",
                                "/noise/candidates",
                                "/noise/margin",
                                "/noise/event_spread",
                                "/noise/efficiency",
                                "/noise/text",
                                "/residuals/0/sd_used",
                                "/residuals/0/captured_count",
                                "/residuals/0/weighted_residual"};

TEST(JsonReport, HoldsEveryPromisedKey) {
  const std::string text = fit_json(sample::four_diameters());
  EXPECT_EQ(text.back(), '\n');
  const PlainJson fit = PlainJson::parse(text);
  for (const char* key : promised) EXPECT_TRUE(fit.contains(PlainJson::json_pointer(key))) << key;
}

TEST(JsonReport, RepeatsTheNumbersExactly) {
  const Analysis analysis = sample::four_diameters();
  const PlainJson fit = PlainJson::parse(fit_json(analysis));
  EXPECT_EQ(fit["parameters"]["C_H"]["value"], 0.00312);
  EXPECT_EQ(fit["parameters"]["C_H"]["intervals"]["bca"][1], 0.00312 + 2.08 * 0.00021);
  EXPECT_EQ(fit["parameters"]["f0"]["free"], false);
  EXPECT_EQ(fit["goodness"]["chi2"], analysis.fitted.chi2);
  EXPECT_EQ(fit["dataset"]["provenance"], "reconstruction");
  EXPECT_EQ(fit["dataset"]["points"], 32);
  EXPECT_EQ(fit["bootstrap"]["seed"], 20260101);
  EXPECT_EQ(fit["two_point"]["low_point"]["restitution"],
            analysis.fitted.data.points[16].restitution);
  EXPECT_EQ(fit["two_point"]["low_point"]["diameter_um"], 4.90e-6 / 1e-6);
  EXPECT_EQ(fit["curve"].size(), 4U * 81U);
  EXPECT_EQ(fit["residuals"].size(), 32U);
  EXPECT_THAT(fit["provenance_sentence"].get<std::string>(), HasSubstr("reconstruction"));
  EXPECT_NEAR(fit["correlation"]["C_H"]["C_A"].get<double>(), -0.43, 1e-12);
}

TEST(JsonReport, SaysWhereTheModelHolds) {
  Analysis analysis = sample::four_diameters();
  analysis.validity = {{ValidityQuantity::contact_radius, 0.52, 0.3, 0, 4.9e-6, 100.0},
                       {ValidityQuantity::tabor, 13.4, 5.0, 0, 4.9e-6, 100.0}};
  const PlainJson validity = PlainJson::parse(fit_json(analysis))["validity"];
  ASSERT_EQ(validity.size(), 2U);
  EXPECT_EQ(validity[0]["quantity"], "contact_radius_over_sphere_radius");
  EXPECT_EQ(validity[0]["value"], 0.52);
  EXPECT_EQ(validity[0]["limit"], 0.3);
  EXPECT_EQ(validity[0]["limit_is"], "largest");
  EXPECT_EQ(validity[0]["exceeded"], true);
  EXPECT_THAT(validity[0]["text"].get<std::string>(), HasSubstr("0.52 of the sphere's radius"));
  EXPECT_EQ(validity[1]["limit_is"], "least");
  EXPECT_EQ(validity[1]["exceeded"], false);
}

TEST(JsonReport, GivesAReasonForEveryMissingInterval) {
  const PlainJson fit = PlainJson::parse(fit_json(sample::four_diameters()));
  for (const auto& [name, parameter] : fit["parameters"].items()) {
    const PlainJson& intervals = parameter["intervals"];
    for (const char* kind : {"wald", "profile", "percentile", "bca", "studentized"}) {
      if (!intervals[kind].is_null()) continue;
      EXPECT_FALSE(intervals["why"][kind].get<std::string>().empty()) << name << " " << kind;
    }
  }
  EXPECT_EQ(fit["parameters"]["f0"]["recommended"]["interval"], nullptr);
  EXPECT_FALSE(fit["parameters"]["f0"]["recommended"]["why"].get<std::string>().empty());
  EXPECT_FALSE(fit["parameters"]["f0"]["std_error_why"].get<std::string>().empty());
}

/// Collects the pointers of null values.
void collect_nulls(const PlainJson& value, const std::string& where,
                   std::vector<std::string>& nulls) {
  if (value.is_null()) nulls.push_back(where);
  if (!value.is_structured()) return;
  for (const auto& [key, child] : value.items()) collect_nulls(child, where + "/" + key, nulls);
}

TEST(JsonReport, NeverPrintsWhatIsNotANumber) {
  Analysis analysis = sample::four_diameters();
  const double infinity = std::numeric_limits<double>::infinity();
  analysis.fitted.theta[0] = nan;
  analysis.fitted.std_error[0] = infinity;
  analysis.fitted.chi2 = nan;
  analysis.fitted.p_value = nan;
  analysis.fitted.rmse = infinity;
  analysis.fitted.covariance.assign(9, nan);
  analysis.fitted.residuals[3] = nan;
  analysis.fitted.starts[0].chi2 = infinity;
  analysis.fitted.model.slots[0].lower = -infinity;
  analysis.uncertainty.intervals[0][IntervalKind::wald].lower = nan;
  analysis.uncertainty.capture[0].value = nan;
  analysis.uncertainty.capture[1].found = false;
  analysis.uncertainty.capture[1].interval = Interval{};
  analysis.uncertainty.curves[0].restitution[5] = nan;
  analysis.uncertainty.two_point[0].rmse = nan;
  analysis.uncertainty.two_point[0].result.theta[0] = nan;
  const std::string text = fit_json(analysis);
  EXPECT_FALSE(std::regex_search(text, std::regex("[:\\[, ]-?(nan|inf|NaN|Infinity)\\b")));
  const PlainJson fit = PlainJson::parse(text);
  EXPECT_TRUE(fit["goodness"]["chi2"].is_null());
  EXPECT_FALSE(fit["goodness"]["chi2_why"].get<std::string>().empty());
  EXPECT_FALSE(fit["parameters"]["C_H"]["value_why"].get<std::string>().empty());
  EXPECT_FALSE(fit["derived"]["capture_velocity"][1]["why"].get<std::string>().empty());
  EXPECT_FALSE(fit["two_point"]["rmse_why"].get<std::string>().empty());
}

TEST(JsonReport, APValueWithoutStatedDeviationsIsNullAndSaysWhy) {
  const PlainJson fit = PlainJson::parse(fit_json(sample::two_datasets()));
  EXPECT_TRUE(fit["goodness"]["p_value"].is_null());
  EXPECT_THAT(fit["goodness"]["p_value_why"].get<std::string>(), HasSubstr("estimated"));
}

TEST(JsonReport, DescribesAJointFitAsOneAndLists) {
  const PlainJson fit = PlainJson::parse(fit_json(sample::two_datasets()));
  EXPECT_EQ(fit["dataset"]["id"], "example-molybdenum+example-silicon");
  EXPECT_EQ(fit["dataset"]["provenance"], "reconstruction") << "the weaker of the two";
  EXPECT_EQ(fit["dataset"]["points"], 64);
  EXPECT_EQ(fit["dataset"]["sha256"].get<std::string>().size(), 64U);
  EXPECT_EQ(fit["datasets"].size(), 2U);
  EXPECT_TRUE(fit["parameters"].contains("f0[example-silicon]"));
  EXPECT_EQ(fit["two_point"], fit["two_point_by_dataset"]["example-molybdenum"]);
  EXPECT_EQ(fit["two_point_by_dataset"]["example-silicon"]["status"], "no_adhesion_damping");
  std::vector<std::string> warnings = fit["warnings"];
  EXPECT_THAT(warnings, testing::Contains(HasSubstr("stiffness_K = 11.4 GPa")));
}

TEST(JsonReport, HasTheContactOfEveryDataset) {
  const PlainJson fit = PlainJson::parse(fit_json(sample::two_datasets()));
  const PlainJson& contacts = fit["model"]["contacts"];
  ASSERT_EQ(contacts.size(), 2U);
  // By hand: 4/3 over (1 - 0.33^2) / 1.2 GPa + (1 - 0.31^2) / 320 GPa, or 131 GPa.
  EXPECT_EQ(contacts[0]["dataset"], "example-molybdenum");
  EXPECT_NEAR(contacts[0]["stiffness_K_derived_Pa"].get<double>(), 1.7887e9, 1e5);
  EXPECT_EQ(contacts[1]["dataset"], "example-silicon");
  EXPECT_NEAR(contacts[1]["stiffness_K_derived_Pa"].get<double>(), 1.7790e9, 1e5);
}

TEST(JsonReport, WithoutABootstrapStaysWhole) {
  Analysis analysis = sample::four_diameters();
  analysis.uncertainty = UncertaintyResult{};
  const PlainJson fit = PlainJson::parse(fit_json(analysis));
  EXPECT_TRUE(fit["two_point"].is_null());
  EXPECT_FALSE(fit["two_point_why"].get<std::string>().empty());
  EXPECT_TRUE(fit["parameters"]["C_H"]["intervals"]["bca"].is_null());
  EXPECT_TRUE(fit["curve"].empty());
  std::vector<std::string> nulls;
  collect_nulls(fit["goodness"], "", nulls);
  EXPECT_TRUE(nulls.empty());
}

TEST(JsonReport, IsTheSameAfterItWasRead) {
  for (const Analysis& analysis : {sample::four_diameters(), sample::two_datasets()}) {
    const std::string text = fit_json(analysis);
    EXPECT_EQ(text_of(read_fit_file("fit.json", text, "the test"), 1), text);
  }
}

TEST(JsonReport, RefusesAnotherFormatAndWrongTypes) {
  PlainJson fit = PlainJson::parse(fit_json(sample::four_diameters()));
  EXPECT_NO_THROW(read_fit_file("fit.json", fit.dump(), "the test"));
  PlainJson newer = fit;
  newer["format_version"] = format_version + 1;
  EXPECT_THROW(read_fit_file("fit.json", newer.dump(), "the test"), InputError);
  fit["parameters"]["C_H"]["value"] = "large";
  EXPECT_THROW(read_fit_file("fit.json", fit.dump(), "the test"), InputError);
  EXPECT_THROW(read_fit_file("fit.json", "{", "the test"), InputError);
}

TEST(JsonReport, IsTheSameTwice) {
  EXPECT_EQ(fit_json(sample::four_diameters()), fit_json(sample::four_diameters()));
}

TEST(JsonReport, SurvivesWordsThatAreNotUtf8) {
  Analysis analysis = sample::four_diameters();
  analysis.datasets[0].title = "broken \xff\xfe title \"quoted\"\n";
  EXPECT_TRUE(PlainJson::accept(fit_json(analysis)));
}

TEST(FitJson, HasTheAnglesOfThePointsAndTheirFriction) {
  Analysis a = sample::four_diameters();
  EXPECT_TRUE(PlainJson::parse(fit_json(a))["friction"].empty());
  std::size_t i = 0;
  for (ImpactPoint& point : a.datasets[0].points) {
    point.incidence_angle = 0.8 + 0.01 * static_cast<double>(i++);
    if (point.restitution > 0.0) {
      point.tangential_restitution =
          1.0 - 0.05 * (1.0 + point.restitution) / std::tan(point.incidence_angle);
    }
  }
  const PlainJson json = PlainJson::parse(fit_json(a));
  ASSERT_EQ(json["friction"].size(), 1U);
  const PlainJson& friction = json["friction"][0];
  EXPECT_EQ(friction["dataset"], a.datasets[0].id);
  EXPECT_NEAR(friction["mu"], 0.05, 1e-9);
  EXPECT_NEAR(friction["interval"][0], 0.05, 1e-6);
  EXPECT_TRUE(friction["lower_limit"].is_null());
  EXPECT_EQ(friction["sliding"], friction["points"]);
  EXPECT_NEAR(json["residuals"][1]["incidence_angle_deg"], 0.81 * 57.29577951308232, 1e-9);
  for (ImpactPoint& point : a.datasets[0].points) {
    if (point.tangential_restitution) point.tangential_restitution = 5.0 / 7.0;
  }
  const PlainJson rolling = PlainJson::parse(fit_json(a))["friction"][0];
  EXPECT_TRUE(rolling["mu"].is_null());
  EXPECT_EQ(rolling["mu_why"], "all points may roll");
  EXPECT_GT(rolling["lower_limit"], 0.1);
}

TEST(FitJson, SaysWhyAMethodHasNoStandardError) {
  Analysis a = sample::four_diameters();
  std::vector<ComparisonRow>& rows = a.uncertainty.two_point.front().rows;
  rows[1].standard_errors.clear();
  rows[2] = {CalibrationKind::full_f0_free, a.fitted.theta, "", 0.03, 0.04, {0.0, 0.001, 0.0}};
  const PlainJson json = PlainJson::parse(fit_json(a));
  const PlainJson& comparison = json["comparison"];
  EXPECT_EQ(comparison[0]["C_H_standard_error_why"],
            "two points leave nothing to estimate an error from");
  EXPECT_EQ(comparison[1]["C_H_standard_error_why"], "the covariance is singular");
  EXPECT_TRUE(comparison[2]["C_H_standard_error"].is_null());
  EXPECT_EQ(comparison[2]["C_H_standard_error_why"], "the estimate rests on a bound");
  EXPECT_EQ(comparison[2]["C_A_standard_error"], 0.001);
  rows[1].noise_known = false;
  EXPECT_EQ(PlainJson::parse(fit_json(a))["comparison"][1]["C_H_standard_error_why"],
            "the noise is unknown");
}

}  // namespace
}  // namespace recoil
