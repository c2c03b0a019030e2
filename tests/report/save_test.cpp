// The pictures of real pages saved by their links in headless Chromium: the files against fit.json
// and points.csv, read by a parser of their own.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "support/command.hpp"
#include "support/temporary_folder.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Columns by their names, as RFC 4180 has them; empty cells are NaN, words 0.
std::map<std::string, std::vector<double>> columns_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows(1, {""});
  bool quoted = false;
  for (std::size_t i = 0; i < csv.size(); ++i) {
    const char c = csv[i];
    if (quoted && c == '"' && i + 1 < csv.size() && csv[i + 1] == '"') {
      rows.back().back() += '"';
      ++i;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      rows.back().emplace_back();
    } else if (c == '\n' && !quoted) {
      if (i + 1 < csv.size()) rows.push_back({""});
    } else {
      rows.back().back() += c;
    }
  }
  EXPECT_FALSE(quoted);
  std::map<std::string, std::vector<double>> columns;
  for (std::size_t r = 1; r < rows.size(); ++r) {
    EXPECT_EQ(rows[r].size(), rows[0].size()) << "row " << r;
    for (std::size_t c = 0; c < std::min(rows[r].size(), rows[0].size()); ++c) {
      columns[rows[0][c]].push_back(rows[r][c].empty() ? NAN : std::atof(rows[r][c].c_str()));
    }
  }
  EXPECT_EQ(columns.size(), rows[0].size()) << "two columns have one name";
  return columns;
}

/// A page of one fit and the files that its links save.
class SavedPictures : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<support::TemporaryFolder>();
    // Under exact laws, so that chi-square is that of the residuals shown.
    const fs::path source = RECOIL_SOURCE_DIR;
    std::ifstream file(source / "fits/dahneke1975-quartz.toml");
    std::string fit{std::istreambuf_iterator<char>(file), {}};
    const std::string dataset = "../datasets";
    fit.replace(fit.find(dataset), dataset.size(), (source / "datasets").string());
    folder_->write("dahneke1975-quartz.toml", fit + "materials = true\n");
    const support::Outcome made = support::run_recoil(
        {"report", "dahneke1975-quartz.toml", "--replicates", "39", "--out", "pages"},
        folder_->path());
    ASSERT_EQ(made.status, 0) << made.err;
    for (const char* page : {"dahneke1975-quartz", "dahneke1975-quartz/diagnosis", "index"}) {
      save(page);
    }
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static void save(const std::string& page) {
    fs::create_directories(*folder_ / "saved" / page);
    // A browser asks before the eleventh download of one gesture, so a pause between them.
    folder_->write("expressions.json", Json({R"js(
        (async () => {
          const names = [];
          for (const link of document.querySelectorAll('.save a[download]')) {
            names.push(link.download);
            link.click();
            await new Promise(resolve => setTimeout(resolve, 120));
          }
          return [document.querySelectorAll('.picture').length, names];
        })())js"})
                                           .dump());
    const support::Outcome saved =
        support::run_command({"python3", RECOIL_SOURCE_DIR "/tests/report/evaluate_in_chromium.py",
                              (*folder_ / "pages" / (page + ".html")).string(), "expressions.json",
                              "--downloads", (*folder_ / "saved" / page).string()},
                             folder_->path());
    ASSERT_EQ(saved.status, 0) << saved.err;
    const Json answer = Json::parse(saved.out).front();
    pictures_[page] = answer[0].get<std::size_t>();
    names_[page] = answer[1].get<std::vector<std::string>>();
  }

  static std::string file_of(const std::string& page, const std::string& name) {
    return folder_->read(fs::path("saved") / page / name);
  }

  static inline std::unique_ptr<support::TemporaryFolder> folder_;
  static inline std::map<std::string, std::size_t> pictures_;
  static inline std::map<std::string, std::vector<std::string>> names_;
};

TEST_F(SavedPictures, AreAllThereUnderNamesOfTheirOwn) {
  for (const auto& [page, names] : names_) {
    EXPECT_GE(pictures_[page], page == "dahneke1975-quartz" ? 3U : 1U) << page;
    EXPECT_EQ(names.size(), 3 * pictures_[page]) << page << ": SVG, PNG and CSV of each picture";
    const std::set<std::string> different(names.begin(), names.end());
    EXPECT_EQ(different.size(), names.size()) << page;
    for (const std::string& name : names) {
      ASSERT_TRUE(folder_->has(fs::path("saved") / page / name)) << page << ": " << name;
      const std::string text = file_of(page, name);
      if (name.ends_with(".svg")) {
        EXPECT_TRUE(text.starts_with("<svg ")) << name;
        EXPECT_TRUE(text.ends_with("</svg>")) << name;
        EXPECT_NE(text.find("xmlns=\"http://www.w3.org/2000/svg\""), std::string::npos) << name;
        EXPECT_NE(text.find(" width=\""), std::string::npos) << name << " has a size of its own";
      } else if (name.ends_with(".png")) {
        EXPECT_TRUE(text.starts_with("\x89PNG")) << name;
      } else {
        EXPECT_TRUE(name.ends_with(".csv")) << name;
        EXPECT_GE(columns_of(text).size(), 2U) << name;
      }
    }
  }
}

TEST_F(SavedPictures, SvgIsReadByAnotherProgram) {
  const std::string page = "dahneke1975-quartz";
  for (const std::string& name : names_[page]) {
    if (!name.ends_with(".svg")) continue;
    const support::Outcome parsed = support::run_command(
        {"python3", "-c",
         "import sys, xml.etree.ElementTree as t; r = t.parse(sys.argv[1]).getroot(); "
         "assert r.tag == '{http://www.w3.org/2000/svg}svg' and len(list(r.iter())) > 20",
         (*folder_ / "saved" / page / name).string()},
        folder_->path());
    EXPECT_EQ(parsed.status, 0) << name << ": " << parsed.err;
  }
}

TEST_F(SavedPictures, CurveAndPointsAreThoseOfTheFit) {
  const std::string page = "dahneke1975-quartz";
  const auto columns =
      columns_of(file_of(page, page + "-restitution-against-incident-velocity-d-1.27-um.csv"));
  const Json fit = Json::parse(folder_->read("pages/dahneke1975-quartz/fit.json"));
  const std::vector<double>& V = columns.at("incident velocity V [m/s]");
  const std::vector<double>& e = columns.at("fit to all points: restitution e");
  const std::vector<double>& lower = columns.at("95 % band: restitution e, lower");
  // Five digits are written: V is off by at most 5e-5 of itself, e by 5e-6.
  int rows = 0;
  for (std::size_t i = 0; i < V.size(); ++i) {
    if (std::isnan(e[i])) continue;
    bool found = false;
    for (const Json& point : fit["curve"]) {
      const double velocity = point["incident_velocity"].get<double>();
      if (std::abs(velocity / V[i] - 1.0) > 6e-5) continue;
      found = std::abs(point["restitution"].get<double>() - e[i]) < 6e-6 &&
              std::abs(point["band"][0].get<double>() - lower[i]) < 6e-6;
      if (found) break;
    }
    EXPECT_TRUE(found) << "V = " << V[i] << " m/s";
    ++rows;
  }
  EXPECT_GT(rows, 30);

  const auto measured =
      columns_of(support::text_of(RECOIL_SOURCE_DIR "/datasets/dahneke1975-quartz/points.csv"));
  std::vector<std::pair<double, double>> points;
  std::vector<std::pair<double, double>> shown;
  for (std::size_t i = 0; i < measured.at("incident_velocity").size(); ++i) {
    if (measured.at("restitution")[i] > 0.0) {
      points.emplace_back(measured.at("incident_velocity")[i], measured.at("restitution")[i]);
    }
  }
  const std::string marks = "reconstruction ± 1 sd: restitution e";
  for (std::size_t i = 0; i < V.size(); ++i) {
    if (!std::isnan(columns.at(marks)[i])) shown.emplace_back(V[i], columns.at(marks)[i]);
  }
  ASSERT_EQ(shown.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(shown[i].first / points[i].first, 1.0, 6e-5);
    EXPECT_NEAR(shown[i].second, points[i].second, 1e-5);
  }
}

TEST_F(SavedPictures, ResidualsAreThoseOfTheFit) {
  const std::string page = "dahneke1975-quartz";
  std::string name;
  for (const std::string& one : names_[page]) {
    if (one.find("residual") != std::string::npos && one.find("velocity") != std::string::npos &&
        one.ends_with(".csv")) {
      name = one;
      break;
    }
  }
  ASSERT_NE(name, "");
  const auto columns = columns_of(file_of(page, name));
  const Json fit = Json::parse(folder_->read("pages/dahneke1975-quartz/fit.json"));
  std::vector<double> shown;
  for (const auto& [title, values] : columns) {
    if (title.find("residual") == std::string::npos) continue;
    for (const double value : values) {
      if (!std::isnan(value)) shown.push_back(value);
    }
  }
  std::vector<double> expected;
  double chi2 = 0.0;
  for (const Json& one : fit["residuals"]) {
    expected.push_back(one["weighted_residual"].get<double>());
    chi2 += expected.back() * expected.back();
  }
  for (const auto& [label, constant] : fit["constants"].items()) {
    chi2 += std::pow(constant["moved_sd"].get<double>(), 2);
  }
  EXPECT_NEAR(chi2, fit["goodness"]["chi2"].get<double>(), 1e-6 * chi2);
  std::sort(shown.begin(), shown.end());
  std::sort(expected.begin(), expected.end());
  ASSERT_EQ(shown.size(), expected.size());
  for (std::size_t i = 0; i < shown.size(); ++i) {
    EXPECT_NEAR(shown[i], expected[i], 1e-4 * std::max(1.0, std::abs(expected[i])));
  }
}

}  // namespace
}  // namespace recoil
