#include "data/material_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "core/units.hpp"
#include "data/text.hpp"

namespace recoil {
namespace {

using units::GPa;

constexpr std::array<TabledMaterial, 20> materials = {{
    {"alumina", "99.9 % pure", 3980.0, 380.0 * GPa, 380.0 * GPa, 0.22},
    {"aluminium", "alloy 6061", 2700.0, 69.0 * GPa, 69.0 * GPa, 0.33},
    {"borosilicate", "Pyrex glass", 2230.0, 70.0 * GPa, 70.0 * GPa, 0.20},
    {"brass", "C26000", 8530.0, 110.0 * GPa, 110.0 * GPa, 0.35},
    {"concrete", "of all strengths", 2400.0, 25.4 * GPa, 36.6 * GPa, 0.20},
    {"copper", "C11000", 8890.0, 115.0 * GPa, 115.0 * GPa, 0.33},
    {"fused-silica", "", 2200.0, 73.0 * GPa, 73.0 * GPa, 0.17},
    {"glass", "soda-lime", 2500.0, 69.0 * GPa, 69.0 * GPa, 0.23},
    {"nylon", "6,6, dry to moist", 1140.0, 1.59 * GPa, 3.79 * GPa, 0.39},
    {"pmma", "acrylic glass", 1190.0, 2.24 * GPa, 3.24 * GPa, 0.405, 0.02},
    {"polycarbonate", "", 1200.0, 2.38 * GPa, 2.38 * GPa, 0.36},
    {"polystyrene", "", 1050.0, 2.28 * GPa, 3.28 * GPa, 0.33},
    {"ptfe", "", 2170.0, 0.40 * GPa, 0.55 * GPa, 0.46},
    {"silicon", "single crystal, along [100]", 2330.0, 129.0 * GPa, 129.0 * GPa, 0.28},
    {"silicon-carbide", "sintered", 3200.0, 207.0 * GPa, 483.0 * GPa, 0.16},
    {"stainless", "alloy 304", 8000.0, 193.0 * GPa, 193.0 * GPa, 0.30},
    {"stainless-440", "alloy 440A, of balls", 7800.0, 200.0 * GPa, 200.0 * GPa, 0.30},
    {"steel", "alloy 4140", 7850.0, 207.0 * GPa, 207.0 * GPa, 0.30},
    {"titanium", "Ti-6Al-4V", 4430.0, 114.0 * GPa, 114.0 * GPa, 0.34},
    {"zirconia", "3 mol% yttria", 6000.0, 205.0 * GPa, 205.0 * GPa, 0.31},
}};

}  // namespace

double TabledMaterial::youngs_modulus_sd() const {
  constexpr double of_one_value = 0.02;
  return highest_modulus > lowest_modulus ? (highest_modulus - lowest_modulus) / std::sqrt(12.0)
                                          : of_one_value * lowest_modulus;
}

std::span<const TabledMaterial> tabled_materials() { return materials; }

Json tabled_material(const std::string& name, const std::string& option) {
  const auto found = std::ranges::find(materials, name, &TabledMaterial::name);
  if (found == materials.end()) {
    std::vector<std::string> names;
    for (const TabledMaterial& one : materials) names.emplace_back(one.name);
    throw InputError(
        {}, fmt::format("{} {} is no file and no material of the table", option, quote(name)),
        "recoil materials lists them", did_you_mean(name, names));
  }
  return {
      {"material", name},
      {"density", {{"value", found->density}, {"relative_sd", tabled_density_error}}},
      {"youngs_modulus", {{"value", found->youngs_modulus()}, {"sd", found->youngs_modulus_sd()}}},
      {"poisson_ratio", {{"value", found->poisson_ratio}, {"sd", found->poisson_ratio_sd}}}};
}

}  // namespace recoil
