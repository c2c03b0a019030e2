#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "core/files.hpp"
#include "plot/draw.hpp"
#include "validation/studies/coverage_page.hpp"
#include "validation/studies/hidden_effects_tally.hpp"
#include "validation/studies/markdown.hpp"
#include "validation/studies/pairing_study.hpp"
#include "validation/studies/rank_study.hpp"
#include "validation/studies/study.hpp"
#include "validation/studies/study_list.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

template <class Result>
constexpr bool has_picture = requires(const Result& study) {
  picture_of(study);
};

void write_page(const fs::path& json, const Document& page) {
  fs::path file = json;
  write_whole_file(file.replace_extension(".md"), markdown_page(page), Replacing::data);
}

void write_picture(const fs::path& json, const plot::Picture& picture) {
  fs::path file = json;
  write_whole_file(file.replace_extension(".svg"), plot::draw_svg(picture) + "\n", Replacing::data);
}

template <class Result>
void render(const fs::path& json, const char* what, const char* required) {
  const auto study = read_study<Result>(json, what, required);
  write_page(json, page_of(study));
  if constexpr (has_picture<Result>) write_picture(json, picture_of(study));
}

}  // namespace

void render_study(const fs::path& json) {
  const std::string name = json.stem().string();
  if (name.starts_with("coverage-")) {
    const CoverageStudy study = read_coverage_study(json);
    write_page(json, page_of(study));
    if (study.grid_of) write_picture(json, coverage_picture(study));
  } else if (name == "pairing") {
    render<PairingStudy>(json, "study of the pairing", "rows");
  } else if (name == "posterior-ranks") {
    render<RankStudy>(json, "study of the posterior", "rows");
  } else if (name == "hidden-effects") {
    render<hidden::StudyTally>(json, "study of hidden effects", "bars");
  } else {
    throw InputError({json.string()}, "no page is made from this file",
                     "its name is that of no study with a page",
                     "name one of reports/*.json as ./run study leaves them");
  }
}

void write_coverage_summary(const fs::path& folder) {
  std::vector<fs::path> files;
  if (fs::is_directory(folder)) {
    for (const auto& entry : fs::directory_iterator(folder)) {
      const fs::path& file = entry.path();
      if (file.extension() == ".json" && file.stem().string().starts_with("coverage-")) {
        files.push_back(file);
      }
    }
  }
  std::sort(files.begin(), files.end());
  if (files.empty()) {
    throw InputError({folder.string()}, "there are no studies of coverage here",
                     "they are files named coverage-*.json", "write them with ./run study");
  }
  std::vector<CoverageStudy> studies;
  std::vector<ParameterCoverage> recommended;
  for (const fs::path& file : files) {
    studies.push_back(read_coverage_study(file));
    for (ParameterCoverage row : studies.back().rows) {
      std::erase_if(row.intervals, [](const auto& at) { return at.first != "recommended"; });
      recommended.push_back(std::move(row));
    }
  }
  const double level = studies.front().level;
  write_page(folder / "coverage", coverage_summary(studies));
  write_picture(folder / "coverage",
                coverage_picture(recommended, level,
                                 fmt::format("Coverage of the recommended {:g} % intervals by kind "
                                             "of data",
                                             100.0 * level),
                                 "made from the studies coverage-*.json"));
}

}  // namespace recoil
