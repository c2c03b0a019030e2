#include "report/posterior_report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/units.hpp"

namespace recoil {

std::string posterior_csv(const Analysis& a) {
  const std::optional<PosteriorResult>& found = a.uncertainty.posterior;
  std::string text;
  if (!found || !found->available()) return text;
  std::vector<std::size_t> moving;
  for (std::size_t j = 0; j < a.fitted.model.slots.size(); ++j) {
    if (!a.fitted.model.slots[j].moves()) continue;
    text += fmt::format("{}\"{}\"", moving.empty() ? "" : ",", a.fitted.model.slots[j].label());
    moving.push_back(j);
  }
  for (const CaptureEstimate& at : a.uncertainty.capture) {
    text += fmt::format(",\"V*({:.4g} um{})\"", at.diameter / units::um,
                        a.datasets.size() > 1 ? ", " + a.datasets[at.dataset].id : "");
  }
  text += "\n";
  for (std::size_t k = 0; k < found->draws.size(); ++k) {
    for (const std::size_t j : moving) {
      text += fmt::format("{}{:.9g}", j == moving.front() ? "" : ",", found->draws[k][j]);
    }
    for (const double v : found->capture_draws[k]) {
      text += std::isfinite(v) ? fmt::format(",{:.9g}", v) : ",";
    }
    text += "\n";
  }
  return text;
}

}  // namespace recoil
