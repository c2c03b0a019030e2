#include "options/useless_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace recoil {
namespace {

enum class Needs {
  any_of,    ///< one of the others
  none_of,   ///< none of the others
  value_of,  ///< one of the values of the other
  another    ///< none of the values of the other
};

/// When an option of a command does something.
struct Usefulness {
  std::string_view commands, option;
  Needs needs;
  std::vector<std::string_view> others;
  std::vector<std::string_view> values = {};
};

const std::vector<Usefulness>& conditions() {
  using enum Needs;
  static const std::vector<Usefulness> rows = {
      {"import", "--axis", value_of, {"--format"}, {"webplotdigitizer"}},
      {"import", "--reading-error", value_of, {"--format"}, {"webplotdigitizer"}},
      {"import", "--error-series", value_of, {"--format"}, {"webplotdigitizer"}},
      {"import", "--sd-of", value_of, {"--format"}, {"csv"}},
      {"import", "--scatter", value_of, {"--format"}, {"webplotdigitizer"}},
      {"import bounce",
       "--captured-below",
       value_of,
       {"--format"},
       {"webplotdigitizer", "heights"}},
      {"import bounce",
       "--drop-error",
       value_of,
       {"--format"},
       {"heights", "intervals", "recording", "rest", "tops"}},
      {"import bounce", "--rebound-error", value_of, {"--format"}, {"heights", "tops"}},
      {"import bounce",
       "--time-error",
       value_of,
       {"--format"},
       {"intervals", "recording", "rest", "blocks"}},
      {"import bounce", "--average", value_of, {"--format"}, {"heights"}},
      {"import",
       "--gravity",
       value_of,
       {"--format"},
       {"heights", "intervals", "track", "recording", "rest", "tops", "blocks"}},
      {"import bounce", "--fps", value_of, {"--format"}, {"track"}},
      {"import bounce", "--scale", value_of, {"--format"}, {"track"}},
      {"import", "--replace", any_of, {"--into"}},
      {"init", "--sheet", any_of, {"--points"}},
      {"init", "--map", any_of, {"--points"}},
      {"init", "--provenance", any_of, {"--points"}},
      {"coverage", "--replicates", none_of, {"--posterior"}},
      {"fit", "--scheme", another, {"--replicates"}, {"0"}},
      {"export", "--stock", value_of, {"--to"}, {"lammps", "liggghts", "yade"}},
      {"export", "--replicates", value_of, {"--to"}, {"table"}},
      {"export", "--replicates", none_of, {"--parameters"}},
      {"export", "--seed", value_of, {"--to"}, {"table"}},
      {"export", "--seed", none_of, {"--parameters"}},
      {"pair", "--provenance", any_of, {"--into"}},
      {"pair", "--replace", any_of, {"--into", "--out", "--impacts", "--histograms"}},
      {"plan", "--replace", any_of, {"--out"}},
      {"merge", "--threads", none_of, {"--missing"}},
      {"cluster", "--time", value_of, {"SYSTEM"}, {"slurm"}},
  };
  return rows;
}

}  // namespace

void refuse_useless_options(const GivenOptions& given) {
  for (const Usefulness& row : conditions()) {
    if (!has_word(row.commands, given.command()) || !given.takes(row.option) ||
        !given.has(row.option)) {
      continue;
    }
    const bool beside = std::ranges::any_of(
        row.others, [&](const std::string_view other) { return given.has(other); });
    const std::string value = given.text(row.others.front());
    const bool listed = std::ranges::find(row.values, value) != row.values.end();
    const std::string_view other = given.name_of(row.others.front());
    const auto refuse = [&](const std::string& circumstance, const std::string& why,
                            const std::string& suggestion) {
      throw InputError({},
                       fmt::format("{} does nothing {}", given.name_of(row.option), circumstance),
                       why, suggestion);
    };
    if (row.needs == Needs::any_of && !beside) {
      refuse(fmt::format("without {}", fmt::join(row.others, " or ")), "",
             fmt::format("leave it out, or give {}", other));
    } else if (row.needs == Needs::none_of && beside) {
      refuse(fmt::format("with {}", other), "", "leave one of them out");
    } else if (row.needs == Needs::another && listed) {
      refuse(fmt::format("with {} {}", other, value), "", "leave one of them out");
    } else if (row.needs == Needs::value_of && !listed && !value.empty()) {
      refuse(fmt::format("with {} {}", other, value),
             fmt::format("it is an option of {}", fmt::join(row.values, " and ")),
             given.command() == "import"
                 ? "leave it out; a column of the file is named by --map, as "
                   "restitution_sd=COLUMN"
                 : "leave it out");
    }
  }
}

}  // namespace recoil
