#include "report/posterior_report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/units.hpp"

namespace recoil {

std::string posterior_csv(const Analysis& a) {
  const std::optional<PosteriorResult>& found = a.uncertainty.posterior;
  std::string text;
  if (!found || !found->available()) return text;
  text += "chain,draw";
  std::vector<std::size_t> moving;
  for (std::size_t j = 0; j < a.fitted.model.slots.size(); ++j) {
    if (!a.fitted.model.slots[j].moves()) continue;
    text += fmt::format(",\"{}\"", a.fitted.model.slots[j].label());
    moving.push_back(j);
  }
  for (const CaptureEstimate& at : a.uncertainty.capture) {
    text += fmt::format(",\"V*({:.4g} um{})\"", at.diameter / units::um,
                        a.datasets.size() > 1 ? ", " + a.datasets[at.dataset].id : "");
  }
  text += found->scale.empty() ? "" : ",noise_scale";
  text += ",log_likelihood,log_prior\n";
  for (std::size_t k = 0; k < found->draws.size(); ++k) {
    text += fmt::format("{},{}", k / found->length + 1, k % found->length + 1);
    for (const std::size_t j : moving) text += fmt::format(",{:.9g}", found->draws[k][j]);
    for (const double v : found->capture_draws[k]) {
      text += std::isfinite(v) ? fmt::format(",{:.9g}", v) : ",";
    }
    if (!found->scale.empty()) text += fmt::format(",{:.9g}", found->scale[k]);
    text += fmt::format(",{:.9g},{:.9g}\n", found->log_likelihood[k], found->log_prior[k]);
  }
  return text;
}

}  // namespace recoil
