// The fit loader on arbitrary texts: every input gives a valid fit or is refused with one clear
// line.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "check.hpp"
#include "estimate/fit_spec.hpp"

namespace {

void require_sound(const recoil::FitSpec& spec) {
  fuzz::require(!spec.datasets.empty(), "datasets");
  const std::vector<const recoil::Parameter*> entries = recoil::parameters_with(spec.mechanisms);
  fuzz::require(spec.parameters.size() == entries.size(), "all parameters");
  for (std::size_t i = 0; i < spec.parameters.size(); ++i) {
    const recoil::ParameterSpec& parameter = spec.parameters[i];
    const recoil::Parameter& entry = *entries[i];
    fuzz::require(parameter.parameter == &entry, "order of the catalogue");
    const double lowest = entry.mechanism == nullptr ? 0.0 : entry.lower;
    fuzz::require(parameter.initial >= lowest && std::isfinite(parameter.initial), "initial");
    fuzz::require(parameter.lower >= lowest && parameter.lower < parameter.upper, "bounds");
    fuzz::require(std::isfinite(parameter.upper), "upper bound");
    fuzz::require(!entry.log_scale || parameter.lower > 0.0, "logarithm");
    const bool inside =
        parameter.initial >= parameter.lower && parameter.initial <= parameter.upper;
    const bool derived = parameter.is_derived();
    fuzz::require(!parameter.free || derived || inside, "initial value within the bounds");
  }
  const recoil::UncertaintySpec& uncertainty = spec.uncertainty;
  fuzz::require(uncertainty.level > 0.0 && uncertainty.level < 1.0, "level");
  fuzz::require(uncertainty.replicates == 0 || uncertainty.replicates >= 19, "replicates");
  const recoil::NoiseSpec& noise = spec.noise;
  fuzz::require(noise.student_dof >= 1.0 && std::isfinite(noise.student_dof), "student_dof");
  for (const double relative : {noise.velocity_relative_sd, noise.diameter_relative_sd}) {
    fuzz::require(relative >= 0.0 && relative <= 0.5, "relative errors");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    require_sound(
        recoil::parse_fit(std::string(reinterpret_cast<const char*>(data), size), "fits/fit.toml"));
  } catch (const recoil::InputError& error) {
    fuzz::require_grammar(error);
  }
  return 0;
}
