#include "predict/capture_comparison.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "core/numerics.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "estimate/capture_velocity.hpp"
#include "estimate/observation.hpp"
#include "estimate/predictor.hpp"
#include "predict/capture_models.hpp"
#include "predict/polydisperse.hpp"
#include "uncertainty/interval.hpp"

namespace recoil {

namespace {

using units::um;

constexpr const char* energies = "Energies 2013, 6(8), 4288, doi 10.3390/en6084288";
constexpr const char* arffman = "Arffman et al. (2015), J. Aerosol Sci. 86, 32-43";
constexpr const char* pasha = "quoted in Pasha et al. (2014), doi 10.1007/s10035-013-0476-y";
constexpr const char* li = "Li, Dunn & Brach (1999), section 4.2";

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Does `name` contain `material` as whole words?
bool names(const std::string& name, const std::string& material) {
  const std::string text = lower_case(name);
  const std::string word = lower_case(material);
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    const bool from_start = at == 0 || std::isalnum(static_cast<unsigned char>(text[at - 1])) == 0;
    const bool to_end =
        end == text.size() || std::isalnum(static_cast<unsigned char>(text[end])) == 0;
    if (from_start && to_end) return true;
  }
  return false;
}

}  // namespace

const std::vector<PublishedCapture>& published_captures() {
  // The composition of the fly ash changes with its size, so its three values do not show a law of
  // size.
  static const std::vector<PublishedCapture> all = {
      {"fly ash", "planar surface", 88 * um, 1.92, true, "measured", energies},
      {"fly ash", "planar surface", 96 * um, 1.25, true, "measured", energies},
      {"fly ash", "planar surface", 104 * um, 0.69, true, "measured", energies},
      {"silver", "aluminium", 0.02 * um, 14.0, true, "measured", arffman},
      {"silver", "aluminium", 1.0 * um, 0.022, true, "measured", arffman},
      {"CO2 ice", "CO2 ice", 100 * um, 0.04, true, "measured at 80 K, size approximate",
       "Musiolik et al. (2016), arXiv:1601.04854"},
      {"ammonium fluorescein", "silicon", 4.9 * um, 0.57, false, "JKR", pasha},
      {"ammonium fluorescein", "silicon", 4.9 * um, 1.6, false, "elastoplastic simulation", pasha},
      {"stainless steel", "silicon", 20 * um, 0.9, false, "the paper's simulation", li},
      {"stainless steel", "silicon", 110 * um, 0.1, false, "the paper's simulation", li},
  };
  return all;
}

std::vector<PublishedCapture> published_captures_for(const Material& particle,
                                                     const Material& surface) {
  std::vector<PublishedCapture> found;
  for (const PublishedCapture& one : published_captures()) {
    if (names(particle.name, one.particle) && names(surface.name, one.surface)) {
      found.push_back(one);
    }
  }
  return found;
}

std::optional<PublishedYield> published_yield_pressure(const Material& particle) {
  if (names(particle.name, "ammonium fluorescein")) return PublishedYield{35.3e6, pasha};
  return std::nullopt;
}

namespace {

/// Capture velocities of the fit [m/s]; NaN without one.
std::vector<double> fitted_velocities(const ImpactModel& model, std::span<const double> theta,
                                      std::size_t dataset, const std::vector<double>& diameters) {
  std::vector<CaptureQuery> queries;
  for (const double diameter : diameters) queries.push_back({dataset, diameter, 0.0});
  std::vector<double> velocities;
  for (const CaptureVelocity& at : capture_velocities(model, theta, queries)) {
    velocities.push_back(at.found ? at.value : std::nan(""));
  }
  return velocities;
}

CaptureCurve fitted_curve(const FitResult& fitted, std::size_t dataset,
                          const std::vector<double>& diameters, const BootstrapResult& bootstrap,
                          const CaptureComparisonOptions& options) {
  CaptureCurve curve;
  curve.velocity = fitted_velocities(fitted.model, fitted.theta, dataset, diameters);
  const std::size_t count =
      std::min(bootstrap.theta.size(), static_cast<std::size_t>(options.replicates));
  if (count < fewest_replicates(options.level)) return curve;
  std::vector<std::vector<double>> values(count);
  parallel_over(count, options.threads, [&](std::size_t i) {
    values[i] = fitted_velocities(fitted.model, bootstrap.theta[i], dataset, diameters);
  });
  for (std::size_t k = 0; k < diameters.size(); ++k) {
    std::vector<double> at;
    for (const auto& row : values) at.push_back(row[k]);
    const BandedValue band = banded(1.0, std::move(at), options.level);
    curve.lower.push_back(band.lower.value_or(NAN));
    curve.upper.push_back(band.upper.value_or(NAN));
  }
  return curve;
}

/// Removes the diameters at which the fit has no capture velocity, or no band although others have
/// one.
void keep_answered(CaptureComparison& comparison, CaptureCurve& fit) {
  std::vector<bool> answered;
  for (std::size_t k = 0; k < fit.velocity.size(); ++k) {
    const bool banded = fit.lower.empty() || std::isfinite(fit.lower[k] + fit.upper[k]);
    answered.push_back(banded && std::isfinite(fit.velocity[k]));
  }
  comparison.unanswered =
      static_cast<std::size_t>(std::count(answered.begin(), answered.end(), false));
  for (auto* values : {&comparison.diameter, &fit.velocity, &fit.lower, &fit.upper}) {
    auto next = answered.begin();
    std::erase_if(*values, [&next](double) { return !*next++; });
  }
}

/// The largest e of the fitted curve at the reference diameter up to the fastest point [1].
double largest_restitution(const FitResult& fitted, std::size_t dataset, double fastest) {
  const double diameter = fitted.model.contacts[dataset].reference_diameter;
  double largest = 0.0;
  for (const double e :
       restitution_curve(fitted.model, fitted.theta, {dataset, diameter},
                         log_spaced(1e-3 * fastest, fastest, 60), Effects::of_nature)) {
    if (std::isfinite(e)) largest = std::max(largest, e);
  }
  return std::min(largest, 1.0);
}

template <class Velocity>
void add_curve(CaptureModel model, const ContactProperties& contact, const Velocity& velocity,
               CaptureComparison& comparison) {
  CaptureCurve curve;
  curve.model = model;
  for (const double diameter : comparison.diameter) {
    curve.velocity.push_back(velocity(capture_contact(contact, diameter)));
  }
  comparison.curves.push_back(std::move(curve));
}

void add_older_models(const ContactProperties& contact, CaptureComparison& comparison) {
  add_curve(
      CaptureModel::jkr, contact, [](const CaptureContact& c) { return jkr_capture_velocity(c); },
      comparison);
  if (comparison.yield) {
    add_curve(
        CaptureModel::thornton_ning, contact,
        [p = comparison.yield->pressure](const CaptureContact& c) {
          return thornton_ning_plastic_velocity(c, p);
        },
        comparison);
  }
  const double e = comparison.restitution;
  if (!(e > 0.0)) return;
  add_curve(
      CaptureModel::dahneke, contact,
      [e](const CaptureContact& c) {
        const JkrEnergies bond = jkr_energies(c);
        return dahneke_capture_velocity(c.mass(), e, bond.incident, bond.rebound);
      },
      comparison);
  add_curve(
      CaptureModel::wall, contact,
      [e](const CaptureContact& c) {
        return wall_capture_velocity(c.mass(), e, -jkr_energies(c).lost());
      },
      comparison);
}

}  // namespace

std::vector<CaptureComparison> compare_captures(const FitResult& fitted,
                                                const std::vector<Dataset>& datasets,
                                                const BootstrapResult& bootstrap,
                                                const CaptureComparisonOptions& options) {
  std::vector<CaptureComparison> all;
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    const ContactProperties& contact = fitted.model.contacts[d];
    if (!(contact.adhesion_energy > 0.0)) continue;
    CaptureComparison comparison;
    comparison.dataset = d;
    comparison.published =
        published_captures_for(datasets[d].system.particle, datasets[d].system.surface);
    std::vector<double> sizes;
    for (const auto& [of, diameter] : options.include) {
      if (of == d) sizes.push_back(diameter);
    }
    for (const PublishedCapture& one : comparison.published) sizes.push_back(one.diameter);
    double fastest = 0.0;
    for (const Observation& point : fitted.data.points) {
      if (point.dataset != d) continue;
      sizes.push_back(point.diameter);
      fastest = std::max(fastest, point.velocity);
    }
    if (!(fastest > 0.0)) continue;
    const auto [smallest, largest] = std::minmax_element(sizes.begin(), sizes.end());
    comparison.diameter = log_spaced(*smallest / options.widened, *largest * options.widened,
                                     static_cast<std::size_t>(options.diameters));
    CaptureCurve fit = fitted_curve(fitted, d, comparison.diameter, bootstrap, options);
    keep_answered(comparison, fit);
    comparison.curves.push_back(std::move(fit));
    comparison.adhesion_energy = contact.adhesion_energy;
    comparison.stiffness = contact.stiffness;
    comparison.yield = published_yield_pressure(datasets[d].system.particle);
    comparison.restitution = largest_restitution(fitted, d, fastest);
    add_older_models(contact, comparison);
    all.push_back(std::move(comparison));
  }
  return all;
}

}  // namespace recoil
