// Intervals where two sources of error meet, by way of the command line.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "support/workplace.hpp"

namespace {

using Result = nlohmann::json;
using support::Workplace;

class CombinedErrors : public testing::Test, public Workplace {
 public:
  /// fit.json of `points` of polystyrene on silicon.
  /// @param materials "true" holds the constants where they are stated
  Result fitted(const std::string& points, const std::string& replicates,
                const std::string& materials = "\"auto\"") {
    const std::string folder = materials == "true" ? "held" : "here";
    write("points.csv", points);
    EXPECT_EQ(run({"init", folder, "--points", "points.csv", "--particle", "polystyrene",
                   "--surface", "silicon", "--diameter", "4.9", "--provenance", "measured"})
                  .status,
              0);
    write(folder + "/fit.toml",
          read(folder + "/fit.toml") + "\n[uncertainty]\nmaterials = " + materials + "\n");
    EXPECT_EQ(run({"fit", folder + "/fit.toml", "--replicates", replicates, "--out", "out"}).status,
              0);
    return Result::parse(read("out/fit.json"));
  }
};

// The spread of the impacts rests on two captures, one degree of freedom; most of the error comes
// from the materials, whose errors are stated. With ln(1.73 / 1.03) / 12.7 = 0.041 of ln(10.5 /
// 1.03) / 12.7 = 0.183 from the spread, 400 degrees of freedom: 1.03 times or over exp(1.97 x
// 0.183).
//
// The points are those of the paper's model with C_H = 0.003 s/m, C_A = 0.03 s/m and V* = 1.27 m/s,
// rounded to 0.001: if the constants may move, the points find them under exact laws.
TEST_F(CombinedErrors, OfASpreadFromTwoCapturesAndOfMaterials) {
  const std::string points =
      "incident_velocity,restitution,restitution_sd,captured\n"
      "0.7,0,0.01,1\n1.0,0,0.01,1\n1.6,0.522,0.01,0\n2.4,0.725,0.01,0\n4.0,0.829,0.01,0\n"
      "7.0,0.866,0.01,0\n12,0.868,0.01,0\n20,0.852,0.01,0\n";
  const Result held = fitted(points, "0", "true");
  const Result& of_held = held.at("/derived/capture_velocity/0"_json_pointer);
  EXPECT_NEAR(of_held.at("value").get<double>(), 1.03, 0.02);
  EXPECT_NEAR(of_held.at("interval").at(0).get<double>(), 0.72, 0.02);
  EXPECT_NEAR(of_held.at("interval").at(1).get<double>(), 1.48, 0.02);
  const Result fit = fitted(points, "0");
  const Result& capture = fit.at("/derived/capture_velocity/0"_json_pointer);
  EXPECT_NEAR(capture.at("value").get<double>(), 1.27, 0.02);
  EXPECT_LT(capture.at("interval").at(0).get<double>(), 1.27);
  EXPECT_GT(capture.at("interval").at(1).get<double>(), 1.27);
  EXPECT_LT(capture.at("interval").at(1).get<double>(), 1.6) << "a sphere rebounds there";
  const Result& damping = fit.at("/parameters/C_A"_json_pointer);
  EXPECT_NEAR(damping.at("laws_exact").at("value").get<double>(), 0.03, 0.01);
  EXPECT_LT(damping.at("intervals").at("profile").at(0).get<double>(), 0.03);
  EXPECT_GT(damping.at("intervals").at("profile").at(1).get<double>(), 0.03);
}

// The error that settings share is estimated from three of them, one degree of freedom.
TEST_F(CombinedErrors, OfThreeSettingsAndOfMaterials) {
  const Result fit = fitted(
      "incident_velocity,restitution,restitution_sd,setting\n"
      "1.8,0.8372,0.005,s0\n1.8,0.8425,0.005,s0\n1.8,0.8413,0.005,s0\n1.8,0.8447,0.005,s0\n"
      "1.8,0.8335,0.005,s0\n1.8,0.8385,0.005,s0\n4,0.8841,0.005,s1\n4,0.8853,0.005,s1\n"
      "4,0.8869,0.005,s1\n4,0.8881,0.005,s1\n4,0.8850,0.005,s1\n4,0.8916,0.005,s1\n"
      "13,0.8795,0.005,s2\n13,0.9015,0.005,s2\n13,0.8936,0.005,s2\n13,0.8918,0.005,s2\n"
      "13,0.8969,0.005,s2\n13,0.8967,0.005,s2\n",
      "0", "true");
  const Result& capture = fit.at("/derived/capture_velocity/0"_json_pointer);
  EXPECT_NEAR(capture.at("interval").at(0).get<double>(), 0.56, 0.01);
  EXPECT_NEAR(capture.at("interval").at(1).get<double>(), 0.92, 0.01);
  EXPECT_NEAR(fit.at("/parameters/C_A/intervals/wald/1"_json_pointer).get<double>(), 0.073, 0.001);
}

// Bounces of launches whose sphere has one error of its size: replicates scatter as the fit states.
TEST_F(CombinedErrors, OfInstantsAndOfTheSizeOfASeries) {
  std::string points =
      "incident_velocity,restitution,restitution_sd,series,launch,diameter [um],"
      "series_diameter_sd [um]\n";
  for (int k = 0; k < 8; ++k) {
    double velocity = 3.0 + 0.1 * k;
    for (int bounce = 0; bounce < 4; ++bounce) {
      const double e = 0.89 + 0.008 * ((7 * k + 5 * bounce) % 5 - 2) / 2.0;
      points += std::to_string(velocity) + "," + std::to_string(e) + ",0.008,a,a" +
                std::to_string(k) + ",5000,400\n";
      velocity *= e;
    }
  }
  write("ball.csv", points);
  ASSERT_EQ(run({"init", "ball", "--points", "ball.csv", "--particle", "steel", "--surface",
                 "glass", "--provenance", "measured"})
                .status,
            0);
  write("ball/fit.toml",
        "dataset = \".\"\n[uncertainty]\nmaterials = false\nreplicates = 999\nseed = 1\n");
  ASSERT_EQ(run({"fit", "ball/fit.toml", "--out", "out"}).status, 0);
  for (const auto& [name, parameter] :
       Result::parse(read("out/fit.json")).at("parameters").items()) {
    if (!parameter.at("free").get<bool>()) continue;
    const Result& intervals = parameter.at("intervals");
    const auto width = [&](const char* kind) {
      return intervals.at(kind).at(1).get<double>() - intervals.at(kind).at(0).get<double>();
    };
    // The ends of 999 replicates have a relative error of a few per cent.
    EXPECT_NEAR(width("percentile") / width("wald"), 1.0, 0.15) << name;
    EXPECT_NEAR(width("bca") / width("wald"), 1.0, 0.2) << name;
  }
}

}  // namespace
