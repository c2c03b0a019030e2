#include "predict/law_choice.hpp"

#include <algorithm>
#include <cmath>

#include "estimate/capture_velocity.hpp"
#include "mechanism/mechanism.hpp"
#include "uncertainty/two_point_comparison.hpp"

namespace recoil {
namespace {

/// Root mean square of the held-out errors over the datasets with more than one diameter.
std::optional<double> held_out(const FitResult& fitted) {
  double sum = 0.0;
  int count = 0;
  for (const TwoPointComparison& comparison : compare_two_points(fitted)) {
    if (!comparison.full_held_out_rmse) continue;
    sum += *comparison.full_held_out_rmse * *comparison.full_held_out_rmse;
    ++count;
  }
  return count > 0 ? std::optional(std::sqrt(sum / count)) : std::nullopt;
}

std::vector<LawCapture> captures_of(const FitResult& fitted, const std::vector<Dataset>& datasets) {
  std::vector<LawCapture> captures;
  const std::size_t p = fitted.theta.size();
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    for (const double diameter : distinct_diameters(datasets[d])) {
      LawCapture& capture = captures.emplace_back(LawCapture{d, diameter, std::nullopt});
      const CaptureVelocity found = capture_velocity(fitted.model, fitted.theta, d, diameter);
      if (!found.found || !(found.value > 0.0)) continue;
      capture.value = found.value;
      if (fitted.covariance.size() != p * p)
        continue;  // the points do not determine all parameters
      double variance = 0.0;
      for (std::size_t a = 0; a < p; ++a) {
        for (std::size_t b = 0; b < p; ++b) {
          variance += found.gradient[a] * fitted.covariance[a * p + b] * found.gradient[b];
        }
      }
      if (variance > 0.0 && std::isfinite(variance)) capture.std_error = std::sqrt(variance);
    }
  }
  return captures;
}

std::string refusal_of(const FitSpec& spec, AdhesionLaw law) {
  for (const std::string& id : spec.mechanisms) {
    const std::string_view why = find_mechanism(id)->refusal(law);
    if (!why.empty()) return id + ": " + std::string(why);
  }
  return {};
}

}  // namespace

FitSpec under_law(const FitSpec& spec, AdhesionLaw law, const std::vector<Dataset>& datasets) {
  FitSpec other = spec;
  other.adhesion = law;
  other.parameters.clear();
  for (const Parameter* parameter : parameters_with(spec.mechanisms, law)) {
    const auto stated =
        std::find_if(spec.parameters.begin(), spec.parameters.end(), [&](const ParameterSpec& one) {
          return one.parameter->name == parameter->name ||
                 (one.parameter->is_adhesion() && parameter->is_adhesion());
        });
    ParameterSpec next = default_of(*parameter);
    if (stated != spec.parameters.end()) {
      const bool same = stated->parameter->name == parameter->name;
      if (same) next = *stated;
      next.parameter = parameter;
      next.free = stated->free;
      next.per_dataset = stated->per_dataset;
      if (!same && stated->initial_stated) {
        const ContactProperties contact = make_model(spec, datasets).contacts.front();
        const double radius = contact.relative_radius(contact.reference_diameter);
        const bool to_energy = parameter->role == ParameterRole::adhesion_energy;
        next.initial = to_energy ? adhesion_energy_for(stated->initial, radius, contact.stiffness)
                                 : adhesion_force_for(stated->initial, radius, contact.stiffness);
        next.initial_stated = true;
      }
    }
    other.parameters.push_back(next);
  }
  return other;
}

std::vector<LawFit> fit_under_every_law(const FitSpec& spec, const std::vector<Dataset>& datasets,
                                        const FitResult& own) {
  std::vector<AdhesionLaw> laws = {spec.adhesion};
  for (const AdhesionLaw law : values_of<AdhesionLaw>()) {
    if (law != spec.adhesion && traits(law).quick_to_fit) laws.push_back(law);
  }
  std::vector<LawFit> fits;
  for (const AdhesionLaw law : laws) {
    LawFit& one = fits.emplace_back();
    one.law = law;
    one.refused = refusal_of(spec, law);
    if (!one.refused.empty()) continue;
    one.spec = law == spec.adhesion ? spec : under_law(spec, law, datasets);
    if (law == spec.adhesion) {
      one.fitted = own;
    } else {
      ImpactModel model = make_model(one.spec, datasets);
      model.solver = own.model.solver;
      one.fitted = fit(model, gather(datasets, one.spec));
    }
    if (!one.fitted->usable) continue;
    one.held_out_rmse = held_out(*one.fitted);
    one.captures = captures_of(*one.fitted, datasets);
  }
  return fits;
}

}  // namespace recoil
