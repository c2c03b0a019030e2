#include "estimate/material_constants.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "mechanism/encounter.hpp"

namespace recoil {
namespace {

// Standard deviation of ln(surface energy / Gilman's estimate of it): a factor of two either way
// is one and a half of them [1]. Eq. 11 gives 0.38 J/m2 for the cleavage planes of NaCl and 2.1 for
// MgO (44 and 250 GPa across), where 0.32 and 1.3 are measured (J. Appl. Phys. 36, 2459, 1965, doi
// 10.1063/1.1714511), and 0.022 for polystyrene, which has about 0.04: factors of 1.2, 1.6 and
// 0.55, whose logarithms have the root mean square 0.46.
constexpr double gilman_log_sd = 0.46;

const Material& material_of(const ImpactSystem& system, Body body) {
  return body == Body::surface ? system.surface : system.particle;
}

/// Do two datasets have the same body, so that they share its constants?
bool same_body(const ImpactSystem& a, const ImpactSystem& b, Body body) {
  const auto same = [](const Material& one, const Material& other) {
    return !one.name.empty() && one.name == other.name;
  };
  if (body == Body::pair) {
    return same(a.particle, b.particle) && same(a.surface, b.surface) &&
           a.reference_diameter == b.reference_diameter;
  }
  return same(material_of(a, body), material_of(b, body));
}

}  // namespace

double logarithmic_sd(double value, double sd) {
  return std::sqrt(std::log1p(std::pow(sd / value, 2)));
}

double UncertainConstant::deviation(double value, double stated_value_of_it) const {
  return positive() ? std::log(value / stated_value_of_it) / sd : (value - stated_value_of_it) / sd;
}

double UncertainConstant::moved(double value, double by) const {
  return positive() ? value * std::exp(by * sd) : value + by * sd;
}

double UncertainConstant::deviation_slope(double value) const {
  return positive() ? 1.0 / (value * sd) : 1.0 / sd;
}

std::vector<UncertainConstant> uncertain_constants(const std::vector<Dataset>& datasets) {
  std::vector<UncertainConstant> all;
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    const ImpactSystem& system = datasets[d].system;
    const auto add = [&](Body body, Constant constant, double sd) {
      const double value = *system.value_of(body, constant);
      if (!(sd > 0.0)) return;
      for (UncertainConstant& known : all) {
        const ImpactSystem& other = datasets[known.datasets.front()].system;
        if (known.body != body || known.constant != constant || known.stated != value ||
            known.sd != sd || !same_body(system, other, body)) {
          continue;
        }
        known.datasets.push_back(d);
        return;
      }
      all.push_back({body, constant, value, sd, {d}});
    };
    for (const ConstantError& error : system.errors) {
      const double value = *system.value_of(error.body, error.constant);
      add(error.body, error.constant,
          is_positive(error.constant) ? logarithmic_sd(value, error.sd) : error.sd);
    }
    for (const Body body : {Body::particle, Body::surface}) {
      if (material_of(system, body).surface_energy) continue;
      add(body, Constant::gilman_factor, gilman_log_sd);
    }
  }
  return all;
}

MaterialLaw::MaterialLaw(const ImpactSystem& system, const ContactProperties& contact,
                         const std::vector<UncertainConstant>& all, std::size_t dataset)
    : system_(system), relative_radius_(contact.relative_radius(contact.reference_diameter)) {
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto& its = all[k].datasets;
    if (std::find(its.begin(), its.end(), dataset) == its.end()) continue;
    acting_.push_back({k, all[k].body, all[k].constant});
  }
  if (acting_.empty()) return;
  const Material& surface = system.surface;
  const double nu = surface.poisson_ratio;
  const double density = surface.density > 0.0 ? surface.density : system.particle.density;
  mobility_ = half_space_mobility(surface.youngs_modulus, nu, density);
  // c(nu) costs a thousand times as much as the rest of the evaluation; a parabola in its logarithm
  // has an error of 1e-4 over 0.1 in nu.
  constexpr double step = 0.01;
  const double middle = std::clamp(nu, -0.9, 0.48);
  const double low = std::log(half_space_radiation(middle - step));
  const double here = std::log(half_space_radiation(middle));
  const double high = std::log(half_space_radiation(middle + step));
  radiation_ = {(high - low) / (2.0 * step), (high - 2.0 * here + low) / (step * step)};
}

ImpactSystem MaterialLaw::with(std::span<const double> values,
                               std::array<double, 2>& gilman) const {
  ImpactSystem system = system_;
  gilman = {1.0, 1.0};
  for (const Acting& acting : acting_) {
    const double value = values[acting.index];
    Material& material = acting.body == Body::surface ? system.surface : system.particle;
    switch (acting.constant) {
      case Constant::density:
        material.density = value;
        break;
      case Constant::youngs_modulus:
        material.youngs_modulus = value;
        break;
      case Constant::poisson_ratio:
        material.poisson_ratio = value;
        break;
      case Constant::surface_energy:
        material.surface_energy = value;
        break;
      case Constant::gilman_factor:
        gilman[acting.body == Body::surface ? 1 : 0] = value;
        break;
      case Constant::stiffness_K:
        system.stiffness_K = value;
        break;
      case Constant::adhesion_energy:
        system.adhesion_energy = value;
        break;
      case Constant::adhesion_force_f0:
        system.adhesion_force_f0 = value;
        break;
    }
  }
  return system;
}

MaterialState MaterialLaw::at(std::span<const double> values) const {
  std::array<double, 2> gilman;
  const ImpactSystem s = with(values, gilman);
  MaterialState state;
  state.density = s.particle.density;
  state.stiffness = s.stiffness_K.value_or(
      hertzian_stiffness(compliance(s.particle.youngs_modulus, s.particle.poisson_ratio),
                         compliance(s.surface.youngs_modulus, s.surface.poisson_ratio)));
  const auto energy = [&](const Material& material, double factor) {
    return material.surface_energy.value_or(factor *
                                            gilman_surface_energy(material.youngs_modulus));
  };
  state.adhesion_energy = s.adhesion_energy.value_or(
      2.0 * std::sqrt(energy(s.particle, gilman[0]) * energy(s.surface, gilman[1])));
  state.adhesion_force = s.adhesion_force_f0.value_or(
      adhesion_force_for(state.adhesion_energy, relative_radius_, state.stiffness));
  const auto waves_in = [](const ImpactSystem& system) {
    return system.surface.density > 0.0 ? system.surface.density : system.particle.density;
  };
  const double nu = s.surface.poisson_ratio;
  const double by = nu - system_.surface.poisson_ratio;
  state.wave_mobility = mobility_ * std::exp(by * (radiation_[0] + 0.5 * by * radiation_[1])) *
                        std::pow((1.0 + nu) / (1.0 + system_.surface.poisson_ratio) *
                                     system_.surface.youngs_modulus / s.surface.youngs_modulus,
                                 1.5) *
                        std::sqrt(waves_in(s) / waves_in(system_));
  return state;
}

std::vector<MaterialSlope> MaterialLaw::slopes(std::span<const double> values) const {
  std::array<double, 2> gilman;
  const ImpactSystem s = with(values, gilman);
  const std::array<double, 2> k = {compliance(s.particle.youngs_modulus, s.particle.poisson_ratio),
                                   compliance(s.surface.youngs_modulus, s.surface.poisson_ratio)};
  const bool derived_stiffness = !s.stiffness_K;
  const bool derived_energy = !s.adhesion_energy;
  std::vector<MaterialSlope> all;
  for (const Acting& acting : acting_) {
    MaterialSlope slope;
    slope.index = acting.index;
    const double value = values[acting.index];
    const bool of_surface = acting.body == Body::surface;
    const Material& material = of_surface ? s.surface : s.particle;
    const double share = k[of_surface ? 1 : 0] / (k[0] + k[1]);
    switch (acting.constant) {
      case Constant::density:
        if (!of_surface) slope.density = 1.0 / value;
        if (of_surface || !(s.surface.density > 0.0)) slope.wave_mobility = 0.5 / value;
        break;
      case Constant::youngs_modulus:
        if (derived_stiffness) slope.stiffness = share / value;
        if (derived_energy && !material.surface_energy) slope.adhesion_energy = 0.5 / value;
        if (of_surface) slope.wave_mobility = -1.5 / value;
        break;
      case Constant::poisson_ratio:
        if (derived_stiffness) slope.stiffness = share * 2.0 * value / (1.0 - value * value);
        if (of_surface) {
          slope.wave_mobility = radiation_[0] +
                                (value - system_.surface.poisson_ratio) * radiation_[1] +
                                1.5 / (1.0 + value);
        }
        break;
      case Constant::surface_energy:
      case Constant::gilman_factor:
        if (derived_energy) slope.adhesion_energy = 0.5 / value;
        break;
      case Constant::stiffness_K:
        slope.stiffness = 1.0 / value;
        break;
      case Constant::adhesion_energy:
        slope.adhesion_energy = 1.0 / value;
        break;
      case Constant::adhesion_force_f0:
        slope.adhesion_force = 1.0 / value;
        break;
    }
    if (!s.adhesion_force_f0) {
      slope.adhesion_force = 2.0 / 3.0 * slope.adhesion_energy + slope.stiffness / 3.0;
    }
    all.push_back(slope);
  }
  return all;
}

}  // namespace recoil
