#include "validation/studies/study_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <string_view>

#include "core/error.hpp"
#include "core/files.hpp"
#include "validation/studies/study.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

Study grid_study(int points, const std::string& noise, int datasets) {
  return {fmt::format("coverage-grid-n{}-{}", points, noise),
          fmt::format("coverage-grid fits/wall1990-molybdenum.toml --designs n{},{} --datasets {} "
                      "--replicates 39",
                      points, noise, datasets)};
}

Study designs_study(const std::string& name, const std::string& options) {
  return {name,
          "coverage-designs fits/wall1990-molybdenum.toml fits/wall1990-silicon.toml "
          "fits/wall1990-mica.toml fits/dahneke1975-quartz.toml fits/li1999-sst65-silicon.toml "
          "fits/li1999-sst125-silicon.toml --datasets 1000 --replicates 99" +
              options};
}

/// The end of the string or character literal that begins at `begin`; one past its last character.
std::size_t end_of_literal(std::string_view source, std::size_t begin) {
  if (source[begin] == '"' && begin > 0 && source[begin - 1] == 'R') {
    const std::size_t open = source.find('(', begin);
    const std::string close = ")" + std::string(source.substr(begin + 1, open - begin - 1)) + "\"";
    const std::size_t end = source.find(close, open);
    return end == std::string_view::npos ? source.size() : end + close.size();
  }
  std::size_t end = begin + 1;
  while (end < source.size() && source[end] != source[begin]) end += source[end] == '\\' ? 2 : 1;
  return std::min(end + 1, source.size());
}

/// The text of a file and its place below `root`, so that neither can change unseen.
std::string digest(const fs::path& root, const fs::path& file) {
  const bool is_code = file.extension() == ".cpp" || file.extension() == ".hpp";
  const std::string text = read_text_file(file);
  return fs::relative(file, root).generic_string() + " " +
         sha256_hex(is_code ? code_of(text) : text) + "\n";
}

bool starts_with_one(const fs::path& source, std::initializer_list<std::string_view> starts) {
  const std::string text = source.generic_string();
  return std::any_of(starts.begin(), starts.end(),
                     [&](std::string_view start) { return text.starts_with(start); });
}

template <class Chosen>
void add_files(std::vector<fs::path>& files, const fs::path& folder, const Chosen& chosen) {
  if (!fs::is_directory(folder)) return;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && chosen(entry.path())) files.push_back(entry.path());
  }
}

}  // namespace

const std::vector<Study>& all_studies() {
  static const std::vector<Study> studies = {
      designs_study("coverage-designs", ""),
      designs_study("coverage-designs-exact", " --exact-materials"),
      grid_study(10, "stated", 1000),
      grid_study(20, "stated", 1000),
      grid_study(60, "stated", 1000),
      grid_study(10, "estimated", 200),
      grid_study(20, "estimated", 200),
      grid_study(60, "estimated", 200),
      {"coverage-laws", "coverage-laws --datasets 200 --replicates 0"},
      {"coverage-noise", "coverage-noise --datasets 200 --replicates 39"},
      {"hidden-effects",
       "hidden-effects --datasets 2 --correct 400 --pairs 1 --outside 1 --single 1 --careless 6 "
       "--impossible 2 --first 900 "
       "--whole single,other_law,other_adhesive,impossible,loop,rounded,odd "
       "--baseline --seed 20261123"},
      {"posterior-ranks", "posterior-ranks --datasets 400"},
      {"pairing", "pairing"},
  };
  return studies;
}

const Study& study_named(const std::string& name) {
  std::vector<std::string> names;
  for (const Study& study : all_studies()) {
    if (study.name == name) return study;
    names.push_back(study.name);
  }
  const std::string near = nearest_word(name, names);
  throw InputError({}, fmt::format("no study is called '{}'", name),
                   "recoil_study list names all of them",
                   near.empty() ? "take one of these" : fmt::format("did you mean '{}'?", near));
}

std::string code_of(std::string_view source) {
  std::string code;
  const auto is_word = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
  };
  bool apart = false;  // white space or a comment stands before the next character
  for (std::size_t i = 0; i < source.size();) {
    const char c = source[i];
    std::size_t end = i + 1;
    if (source.substr(i, 2) == "//") {
      end = std::min(source.find('\n', i), source.size());
      apart = true;
    } else if (std::isspace(static_cast<unsigned char>(c))) {
      apart = true;
    } else {
      const bool separates_digits = c == '\'' && !apart && i > 0 && is_word(source[i - 1]);
      if ((c == '"' || c == '\'') && !separates_digits) end = end_of_literal(source, i);
      if (apart && !code.empty() && is_word(code.back()) && is_word(c)) code += ' ';
      code += source.substr(i, end - i);
      apart = false;
    }
    i = end;
  }
  return code;
}

bool shows_results(const fs::path& source) {
  const std::string name = source.stem().string();
  return starts_with_one(
             source, {"src/document/", "src/plot/", "src/report/", "src/cli/", "src/python/"}) ||
         name.ends_with("_page") || name.ends_with("_pages") || name.ends_with("_picture");
}

bool is_apart(const fs::path& source, const std::string& command) {
  if (starts_with_one(source, {"tests/validation/studies/study_list."})) return true;
  const bool covers = command.starts_with("coverage") || command.starts_with("posterior-ranks");
  return covers && starts_with_one(source, {"src/diagnosis/", "src/json/diagnosis_",
                                            "tests/validation/studies/hidden_",
                                            "tests/validation/studies/diagnosis_"});
}

std::string study_key(const fs::path& root, const std::string& command) {
  std::vector<fs::path> files;
  for (const char* sources : {"src", "tests/validation"}) {
    add_files(files, root / sources, [&](const fs::path& file) {
      const fs::path source = fs::relative(file, root);
      return !shows_results(source) && !is_apart(source, command);
    });
  }
  add_files(files, root / "fits", [](const fs::path& file) { return file.extension() == ".toml"; });
  add_files(files, root / "datasets", [](const fs::path&) { return true; });
  std::sort(files.begin(), files.end());
  std::string text = command + "\n";
  for (const fs::path& file : files) text += digest(root, file);
  return sha256_hex(text).substr(0, 16);
}

StudyState state_of(const fs::path& root, const Study& study) {
  const fs::path file = root / study.result();
  if (!fs::exists(file)) return StudyState::missing;
  const auto json = nlohmann::ordered_json::parse(read_text_file(file), nullptr, false);
  if (json.is_discarded() || !json.is_object()) return StudyState::stale;
  return json.value("key", std::string()) == study_key(root, study.command) ? StudyState::current
                                                                            : StudyState::stale;
}

}  // namespace recoil
