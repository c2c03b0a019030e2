#include "options/option_type.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/numbers.hpp"
#include "core/quoting.hpp"
#include "core/resumable.hpp"
#include "data/quantity.hpp"
#include "data/text.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

// Slurm may send its signal up to a minute early, and a shard needs time for its work.
constexpr std::int64_t shortest_time = 600;  // [s]

std::string check_file(const std::string& file) {
  std::error_code failed;
  if (descriptor_named(file) || fs::exists(fs::status(file, failed))) return "";
  const fs::path folder = fs::path(file).parent_path();
  std::vector<std::string> beside;
  for (const fs::path& fit : files_in(folder.empty() ? "." : folder, ".toml")) {
    beside.push_back(fit.filename().string());
  }
  const std::string near = nearest_word(fs::path(file).filename().string(), beside);
  throw InputError({file}, "no such file", "",
                   near.empty() ? "check the path"
                                : fmt::format("did you mean '{}'?", (folder / near).string()));
}

/// "from 0 to 1"; only "from 0" where the upper limit is that of the machine.
std::string range_words(const OptionType& type) {
  if (type.highest > 1e12) return fmt::format("from {}", type.lowest);
  return fmt::format("from {} to {}", type.lowest, type.highest);
}

std::string expected_number(const OptionType& type) {
  const std::string number =
      fmt::format("{} {}", type.whole ? "a whole number" : "a number", range_words(type));
  if (!type.dimension || type.unit == "1") return number;
  return fmt::format("{} {} (units: {})", number, type.unit, join(unit_names(*type.dimension)));
}

bool is_in_range(const OptionType& type, const std::string& text) {
  if (type.whole) {
    const auto value = parse_whole_number(text);
    return value && static_cast<double>(*value) >= type.lowest &&
           static_cast<double>(*value) <= type.highest;
  }
  const auto stated = number_and_unit(text);
  if (!stated) return false;
  const std::string& unit = stated->second.empty() ? type.unit : stated->second;
  if (!unit_factor(*type.dimension, unit)) return false;
  const Scale usual = known_scale(*type.dimension, type.unit, "", {});
  const double value = number_of(type, text);
  return value >= usual(type.lowest) && value <= usual(type.highest);
}

}  // namespace

namespace takes {

OptionType nothing() { return {.value = "", .python = "bool"}; }

OptionType text(const std::string& value) { return {.value = value, .python = "str"}; }

OptionType path(const std::string& value) { return {.value = value, .python = "PathLike"}; }

OptionType one_of(const std::vector<std::string>& words) {
  return {.value = "WORD", .python = "str", .words = words};
}

OptionType whole(double lowest, double highest) {
  return {.value = "N", .python = "int", .whole = true, .lowest = lowest, .highest = highest};
}

OptionType quantity(Dimension dimension, const std::string& unit, double lowest, double highest) {
  return {.value = "NUMBER",
          .python = "Quantity",
          .dimension = dimension,
          .unit = unit,
          .lowest = lowest,
          .highest = highest};
}

OptionType number(double lowest, double highest) {
  return quantity(Dimension::ratio, "1", lowest, highest);
}

OptionType fit_file() {
  OptionType type = path("FIT");
  type.check = check_file;
  return type;
}

OptionType shard() {
  OptionType type = text("K/N");
  type.check = [](const std::string& word) {
    return shard_named(word) ? ""
                             : fmt::format("K/N with K from 1 to N and N up to {}", most_shards);
  };
  return type;
}

OptionType clock_time() {
  OptionType type = text("HH:MM:SS");
  type.check = [](const std::string& word) -> std::string {
    return parse_clock_time(word).value_or(0) >= shortest_time
               ? ""
               : "hours:minutes:seconds, at least 00:10:00";
  };
  return type;
}

OptionType assignments(const std::string& value) {
  OptionType type = list(text(value), value, 1, many);
  type.python = "Mapping[str, str]";
  type.check = [value](const std::string& word) {
    const std::size_t equals = word.find('=');
    const bool both = equals != std::string::npos && equals > 0 && equals + 1 < word.size();
    return both ? "" : value;
  };
  return type;
}

OptionType list(OptionType type, const std::string& value, std::size_t least, std::size_t most) {
  type.commas = true;
  type.value = value;
  return repeated(std::move(type), least, most);
}

OptionType repeated(OptionType type, std::size_t least, std::size_t most) {
  type.python = fmt::format("Sequence[{}]", type.python);
  type.least = least;
  type.most = most;
  return type;
}

OptionType or_word(OptionType type, const std::string& word) {
  type.words = {word};
  type.python = fmt::format("Union[{}, str]", type.python);
  return type;
}

}  // namespace takes

std::string value_words(const OptionType& type) {
  std::string words;
  for (const std::string& word : type.words) {
    words += fmt::format("{}`{}`", words.empty() ? "" : ", ", word);
  }
  if (!type.is_number()) return words.empty() ? type.value : words;
  const std::string unit = type.unit.empty() || type.unit == "1" ? "" : " " + type.unit;
  return fmt::format("{} {}{}{}", type.value, range_words(type), unit,
                     words.empty() ? "" : ", or " + words);
}

std::string expected_instead(const OptionType& type, const std::string& text) {
  if (std::ranges::find(type.words, text) != type.words.end()) return "";
  if (type.is_number()) {
    if (is_in_range(type, text)) return "";
    const std::string also = type.words.empty() ? "" : fmt::format(", or {}", type.words.front());
    return expected_number(type) + also;
  }
  if (!type.words.empty()) return fmt::format("one of {}", join(type.words));
  if (text.empty()) return fmt::format("{}, which is not empty", type.value);
  return type.check ? type.check(text) : "";
}

double number_of(const OptionType& type, const std::string& text) {
  return parse_quantity(text, *type.dimension, type.unit, "a value");
}

}  // namespace recoil
