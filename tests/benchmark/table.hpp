#pragma once

#include <string>

#include "measure.hpp"

namespace recoil::bench {

/// The table that stands in the README and at the head of reports/benchmark.md: machine, date and
/// command, and what is a ratio and what is extrapolated. Ends with a line break.
std::string short_table(const Json& results);

/// The rows of `measure_common` under a heading.
std::string common_section(const Json& rows);

/// What an earlier run of `./run bench` measured (tests/benchmark/earlier.json) beside what this
/// one did, where both have a figure.
std::string earlier_section(const Json& results, const Json& earlier);

/// reports/benchmark.md: the short table between its markers, then everything else in `results`.
std::string benchmark_page(const Json& results, const Json& earlier);

/// The lines between the markers of `text`, the markers not included.
/// @throws std::invalid_argument when `text` does not hold both markers, once each and in order.
std::string between_markers(const std::string& text);

/// `text` with the lines between its markers replaced by `block`. @throws as `between_markers`.
std::string with_block(const std::string& text, const std::string& block);

inline constexpr const char* begin_marker = "<!-- benchmark table: written by ./run bench -->\n";
inline constexpr const char* end_marker = "<!-- end of the benchmark table -->\n";

}  // namespace recoil::bench
