// recoil predict as people script against it.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "support/workplace.hpp"

namespace {

using support::Outcome;
using support::Workplace;

const std::vector<std::string> kQuick = {"--replicates", "39", "--threads", "2"};

std::vector<std::string> command(std::vector<std::string> words) {
  words.insert(words.end(), kQuick.begin(), kQuick.end());
  return words;
}

TEST(Predict, WritesThreeConventionsWithBands) {
  const Workplace place;
  place.write("sizes.csv", "diameter,count\n2,30\n3,50\n4,20\n");
  const Outcome run =
      place.run(command({"predict", "fit.toml", "--sizes", "sizes.csv", "--out", "out"}));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(run.err.empty()) << run.err;
  EXPECT_NE(run.out.find("synthetic"), std::string::npos);
  EXPECT_NE(run.out.find("without --height, the 1 mm of"), std::string::npos);
  const auto json = nlohmann::json::parse(place.read("out/predict.json"));
  EXPECT_EQ(json["format_version"], 2);
  EXPECT_NEAR(json["sizes"]["d10_um"].get<double>(), 2.9, 1e-12);
  EXPECT_EQ(json["conventions"].size(), 3U);
  const auto& last = json["curve"].back();
  for (const char* name : {"captured_as_zero", "captured_left_out", "unseen_left_out"}) {
    const auto& at = last[name];
    ASSERT_TRUE(at["band"].is_array()) << name;
    EXPECT_LE(at["band"][0].get<double>(), at["value"].get<double>());
    EXPECT_GE(at["band"][1].get<double>(), at["value"].get<double>());
  }
  const std::string csv = place.read("out/predict.csv");
  EXPECT_EQ(csv.rfind("incident_velocity_m_s,restitution_d10,captured_as_zero,", 0), 0U);
  EXPECT_EQ(csv.find("nan"), std::string::npos);
  EXPECT_EQ(place.read("out/predict-average.svg").rfind("<svg", 0), 0U);
}

TEST(Predict, TheSameBytesAtAnyThreadCount) {
  const Workplace place;
  place.write("sizes.csv", "lower,upper,count\n2,3,30\n3,5,50\n");
  for (const char* threads : {"1", "3"}) {
    const Outcome run = place.run({"predict", "fit.toml", "--sizes", "sizes.csv", "--out", threads,
                                   "--replicates", "39", "--threads", threads, "--height", "2"});
    ASSERT_EQ(run.status, 0) << run.err;
  }
  EXPECT_EQ(place.read("1/predict.json"), place.read("3/predict.json"));
  EXPECT_EQ(place.read("1/predict.csv"), place.read("3/predict.csv"));
}

TEST(Predict, MistakesAreOneLineAndWriteNothing) {
  const Workplace place;
  const auto before = place.listing();
  const Outcome run =
      place.run(command({"predict", "fit.toml", "--sizes", "none.csv", "--out", "out"}));
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1);
  EXPECT_NE(run.err.find("none.csv: no such file"), std::string::npos) << run.err;
  EXPECT_EQ(place.listing(), before);
}

TEST(Predict, SpreadsTheSpheresOfABinUnlessTheyShallBeAtItsMiddle) {
  const Workplace place;
  place.write("sizes.csv", "lower,upper,count\n2,6,30\n");
  // Spheres of one size stay, or they do not; of several sizes the larger ones leave first.
  const auto some_stay = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"predict",   "fit.toml", "--sizes",
                                      "sizes.csv", "--out",    "out"};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(place.run(command(words)).status, 0);
    const auto json = nlohmann::json::parse(place.read("out/predict.json"));
    int some = 0;
    for (const auto& row : json["curve"]) {
      const double captured = row["captured_fraction"]["value"];
      some += captured > 1e-9 && captured < 1.0 - 1e-9 ? 1 : 0;
    }
    return some > 0;
  };
  EXPECT_TRUE(some_stay({}));
  EXPECT_FALSE(some_stay({"--midpoints"}));
}

TEST(Predict, MeasuresAtMostAMetreAboveTheSurface) {
  const Workplace place;
  place.write("sizes.csv", "diameter,count\n2,30\n");
  const auto at = [&](const std::string& height) {
    return place.run(command({"predict", "fit.toml", "--sizes", "sizes.csv", "--height", height}));
  };
  EXPECT_EQ(at("1000").status, 0);
  EXPECT_EQ(at("1001").status, 2);
  EXPECT_EQ(at("-1").status, 2);
}

TEST(Report, ShowsMixtureAndCaptureModels) {
  const Workplace place;
  place.write("data/sizes.csv", "diameter,count\n2,30\n4,20\n");
  const Outcome run = place.run(command({"report", "fit.toml", "--out", "pages"}));
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string page = place.read("pages/fit.html");
  EXPECT_NE(page.find("id=\"mixture-average-1\""), std::string::npos);
  EXPECT_NE(page.find("id=\"capture-models-1\""), std::string::npos);
  EXPECT_LT(page.size(), 1000000U);
  // Other sizes, another page; without the file there is no such section.
  place.write("data/sizes.csv", "diameter,count\n2,30\n4,40\n");
  EXPECT_NE(place.run(command({"report", "fit.toml", "--out", "pages"})).out.find("written"),
            std::string::npos);
  EXPECT_NE(place.read("pages/fit.html"), page);
}

}  // namespace
