#include "measure.hpp"

#include <fmt/format.h>
#include <stdlib.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <thread>

namespace recoil::bench {
namespace {

/// What follows `key` and its separator in the first line of `file` that begins with it.
std::string value_in(const std::string& file, const std::string& key, char separator) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    if (line.rfind(key, 0) != 0) continue;
    const std::size_t begin = line.find_first_not_of(" \t\"", line.find(separator) + 1);
    if (begin == std::string::npos) return "";
    return line.substr(begin, line.find_last_not_of(" \t\"") - begin + 1);
  }
  return "";
}

double kilobytes(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

/// The widest vector instructions that the processor offers.
std::string vector_instructions() {
  const std::string flags = " " + value_in("/proc/cpuinfo", "flags", ':') + " ";
  for (const char* name : {"avx512f", "avx2", "avx", "sse2"}) {
    if (flags.find(fmt::format(" {} ", name)) != std::string::npos) return name;
  }
  return "";
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm utc = {};
  gmtime_r(&now, &utc);
  return fmt::format("{:04}-{:02}-{:02}", utc.tm_year + 1900, utc.tm_mon + 1, utc.tm_mday);
}

}  // namespace

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

double growth_exponent(const std::vector<double>& sizes, const std::vector<double>& costs) {
  const double n = static_cast<double>(sizes.size());
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const double u = std::log(sizes[i]);
    const double v = std::log(costs[i]);
    x += u / n;
    y += v / n;
    xx += u * u / n;
    xy += u * v / n;
  }
  return (xy - x * y) / (xx - x * x);
}

double seconds_of(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

double median_seconds(const std::function<void()>& work, double budget, int fewest) {
  std::vector<double> seconds;
  double spent = 0.0;
  while (static_cast<int>(seconds.size()) < fewest || spent < budget) {
    seconds.push_back(seconds_of(work));
    spent += seconds.back();
  }
  return median(seconds);
}

double peak_memory_mb() { return kilobytes(value_in("/proc/self/status", "VmHWM", ':')) / 1024.0; }

Json describe_machine() {
  double load = 0.0;
  getloadavg(&load, 1);
  const std::string model = value_in("/proc/cpuinfo", "model name", ':');
  return {
      {"date", today()},
      {"processor", model.empty() ? "unknown processor" : model},
      {"vector_instructions", vector_instructions()},
      {"cores", std::thread::hardware_concurrency()},
      {"memory_gb", std::round(kilobytes(value_in("/proc/meminfo", "MemTotal", ':')) / 1048576.0)},
      {"system", value_in("/etc/os-release", "PRETTY_NAME", '=')},
      {"compiler", RECOIL_COMPILER},
      {"load_before", load}};
}

}  // namespace recoil::bench
