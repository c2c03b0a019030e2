#include "export/export_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/quoting.hpp"

namespace recoil {

double rounded(double value, int digits) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - digits + 1);
  return unit < 1.0 ? std::round(value / unit) / std::round(1.0 / unit)
                    : std::round(value / unit) * unit;
}

double time_step(const ExportedImpact& impact) {
  return rounded(impact.shortest_contact / steps_per_contact, 2);
}

double longest_run(const ExportJob& job) {
  constexpr double patience = 2.5;
  const double stock = job.stock ? job.stock->longest_contact : 0.0;
  return rounded(patience * std::max(job.impact.longest_contact, stock), 2);
}

double typical_velocity(const ExportedImpact& impact) {
  return rounded(std::sqrt(impact.request.slowest * impact.request.fastest), 2);
}

std::string shortest(double value) { return fmt::format("{}", value); }

std::string filled(std::string_view text,
                   std::initializer_list<std::pair<std::string_view, std::string>> values) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t open = text.find('@', at);
    out += text.substr(at, open - at);
    if (open == std::string_view::npos) break;
    const std::size_t close = text.find('@', open + 1);
    const std::string_view name = text.substr(open + 1, close - open - 1);
    bool found = false;
    for (const auto& [known, value] : values) {
      if (known != name) continue;
      out += value;
      found = true;
    }
    assert(found && "a place without a value");
    static_cast<void>(found);
    at = close + 1;
  }
  return out;
}

std::string commented(const std::vector<std::string>& lines, std::string_view mark) {
  std::string out;
  for (const std::string& line : lines) {
    out += mark;
    out += comment_text(line);
    while (!out.empty() && out.back() == ' ') out.pop_back();
    out += '\n';
  }
  return out;
}

}  // namespace recoil
