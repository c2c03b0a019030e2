#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace recoil::bench {

using Json = nlohmann::ordered_json;

/// The middle value, or the mean of the two middle ones. @pre not empty
double median(std::vector<double> values);

/// The slope of a straight line through ln(cost) over ln(size) by least squares: cost ~ size^slope.
/// @pre at least two different sizes, all positive
double growth_exponent(const std::vector<double>& sizes, const std::vector<double>& costs);

/// Wall-clock seconds of one call.
double seconds_of(const std::function<void()>& work);

/// The median of the wall-clock seconds of as many calls as fit into `budget` seconds, at least
/// `fewest`.
double median_seconds(const std::function<void()>& work, double budget, int fewest = 1);

/// Largest resident memory of this process so far [MB]: VmHWM of Linux. (ru_maxrss of getrusage
/// would count what the parent had before it started this program.)
double peak_memory_mb();

/// Processor, cores, memory, system, compiler, load before the start, and today's date (UTC).
Json describe_machine();

}  // namespace recoil::bench
