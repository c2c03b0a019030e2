// What ./run makes of the shipped fits, with few replicates: pages that open and say what they are.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

namespace {

namespace fs = std::filesystem;

const char* const shipped[] = {
    "dahneke1975-quartz", "li1999-sst125-silicon", "li1999-sst65-silicon", "wall1990-all",
    "wall1990-mica",      "wall1990-molybdenum",   "wall1990-silicon",
};

std::string read(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

int run(const std::string& command) { return WEXITSTATUS(std::system(command.c_str())); }

TEST(ShippedFits, ReportsOpenInABrowserAndSayReconstruction) {
  const fs::path out =
      fs::temp_directory_path() / ("recoil-shipped-fits-" + std::to_string(getpid()));
  fs::remove_all(out);
  const std::string report = "cd '" RECOIL_SOURCE_DIR "' && '" RECOIL_BINARY
                             "' report --replicates 39 --out '" +
                             out.string() + "' > '" + out.string() + ".log'";
  ASSERT_EQ(run(report), 0);

  std::string pages = "'" + (out / "index.html").string() + "'";
  for (const std::string id : shipped) {
    const fs::path page = out / (id + ".html");
    ASSERT_TRUE(fs::exists(page)) << id;
    EXPECT_LT(fs::file_size(page), 1000000U) << id;
    pages += " '" + page.string() + "'";
    for (const fs::path& file : {page, out / id / "fit.json", out / id / "fit.txt"}) {
      EXPECT_NE(read(file).find("not one of them was measured"), std::string::npos) << file;
    }
    const auto fit = nlohmann::json::parse(read(out / id / "fit.json"));
    EXPECT_EQ(fit["dataset"]["provenance"], "reconstruction") << id;
    EXPECT_EQ(fit["bootstrap"]["failed"], 0) << id;
    EXPECT_TRUE(fit["two_point"]["parameters"].is_object()) << id;
    for (const auto& [name, parameter] : fit["parameters"].items()) {
      if (parameter["free"]) {
        EXPECT_TRUE(parameter["intervals"]["profile"].is_array()) << name;
      }
    }
    for (const auto& capture : fit["derived"]["capture_velocity"]) {
      EXPECT_TRUE(capture["interval"].is_array()) << id;
    }
  }
  EXPECT_LT(fs::file_size(out / "index.html"), 1000000U);
  EXPECT_EQ(run("python3 '" RECOIL_SOURCE_DIR "/tests/report/open_in_chromium.py' " + pages), 0);

  // A second run finds everything current.
  ASSERT_EQ(run(report), 0);
  const std::string log = read(out.string() + ".log");
  EXPECT_EQ(log.find(".html: written"), log.find("index.html: written") + 5) << log;
  fs::remove_all(out);
  fs::remove(out.string() + ".log");
}

/// diagnosis.json of a fit.
nlohmann::json diagnosed(const std::string& fit) {
  const fs::path out =
      fs::temp_directory_path() / ("recoil-shipped-diagnosis-" + std::to_string(getpid()));
  fs::create_directories(out);
  EXPECT_EQ(run("cd '" RECOIL_SOURCE_DIR "' && '" RECOIL_BINARY "' diagnose " + fit + " --out '" +
                out.string() + "' > '" + (out / "log").string() + "' 2>&1"),
            0)
      << read(out / "log");
  auto answer = nlohmann::json::parse(read(out / "diagnosis.json"));
  fs::remove_all(out);
  return answer;
}

// Its recipe put yielding and adhesion hysteresis there: no single mechanism explains it, and the
// search for two has to find them.
TEST(ShippedFits, DiagnosisFindsTheYieldingThatTheRecipeHid) {
  const auto answer = diagnosed("fits/wall1990-molybdenum.toml");
  std::set<std::string> listed;
  for (const char* key : {"named", "rivals"}) {
    for (const std::string id : answer[key]) listed.insert(id);
  }
  EXPECT_TRUE(listed.count("plastic_yield")) << answer["text"];
  EXPECT_TRUE(listed.count("crack_rate") || listed.count("adhesion_hysteresis")) << answer["text"];
  // What took no part in making the points is not accused.
  for (const char* id : {"jkr_hysteresis", "plastic_yield", "crack_rate", "adhesion_hysteresis"}) {
    listed.erase(id);
  }
  EXPECT_TRUE(listed.empty()) << answer["text"];
}

// A second cause must not be invented for what a law, true but not exact, leaves.
TEST(ShippedFits, DiagnosisOfYieldingByAnotherLawInventsNothing) {
  const auto answer = diagnosed("tests/cli/yielding_otherwise/fit.toml");
  for (const std::string id : answer["named"]) EXPECT_EQ(id, "plastic_yield") << answer["text"];
  const std::string text = answer["text"];
  EXPECT_NE(text.find("plastic_yield"), std::string::npos) << text;
}

}  // namespace
