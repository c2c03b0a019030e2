// The dataset loader on arbitrary texts: every input loads soundly or is refused with one clear
// line. An input is datapackage.json and the points, divided by a line "====".
#include "data/dataset.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "check.hpp"
#ifndef RECOIL_READERS
#include "report/dataset_report.hpp"
#endif

namespace {

void require_sound(const recoil::Dataset& dataset) {
  fuzz::require(!dataset.points.empty(), "points");
  fuzz::require(dataset.sha256.size() == 64, "checksum");
  for (const recoil::ImpactPoint& point : dataset.points) {
    fuzz::require(point.series < dataset.series.size(), "series");
    fuzz::require(point.diameter > 0.0 && point.diameter <= 1.0, "diameter");
    fuzz::require(point.incident_velocity > 0.0 && point.incident_velocity <= 1e4, "velocity");
    fuzz::require(point.restitution >= 0.0 && point.restitution <= 1.2, "restitution");
    fuzz::require(point.captured >= 0 && point.captured <= point.events, "captured");
    fuzz::require(!point.all_captured() || point.restitution == 0.0, "captured without rebound");
    fuzz::require(point.restitution_sd.value_or(1.0) > 0.0, "restitution_sd");
    fuzz::require(point.velocity_sd.value_or(1.0) > 0.0, "velocity_sd");
    fuzz::require(point.diameter_sd.value_or(1.0) > 0.0, "diameter_sd");
  }
  for (const recoil::Material* body : {&dataset.system.particle, &dataset.system.surface}) {
    fuzz::require(body->youngs_modulus > 0.0 && std::isfinite(body->youngs_modulus), "modulus");
    fuzz::require(body->poisson_ratio > -1.0 && body->poisson_ratio <= 0.5, "poisson_ratio");
  }
  fuzz::require(dataset.system.particle.density > 0.0, "density");
#ifndef RECOIL_READERS
  fuzz::require(recoil::dataset_text(dataset).find("[um]") != std::string::npos, "description");
#endif
  fuzz::require(recoil::distinct_diameters(dataset).size() <= dataset.points.size(), "diameters");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string input(reinterpret_cast<const char*>(data), size);
  const std::string divider = "\n====\n";
  const std::size_t at = input.find(divider);
  const std::string package = input.substr(0, at);
  const std::string points = at == std::string::npos ? "" : input.substr(at + divider.size());
  try {
    require_sound(recoil::parse_dataset(package, points, "folder"));
  } catch (const recoil::InputError& error) {
    fuzz::require_grammar(error);
  }
  return 0;
}
