#include "data/material_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "core/units.hpp"
#include "data/text.hpp"

namespace recoil {
namespace {

using units::GPa;
constexpr double MPa = 1e-3 * GPa;

constexpr std::string_view stainless_source =
    "Callister, W. D. & Rethwisch, D. G. (2008), tables B.1 to B.3; yield strength: the minimum in "
    "the ASTM specifications of annealed wrought products, such as A 213";

constexpr TabledMaterial materials[] = {
    {"alumina", "99.9 % pure", 3980.0, 380.0 * GPa, 380.0 * GPa, 0.22},
    {"aluminium", "alloy 6061, T6", 2700.0, 69.0 * GPa, 69.0 * GPa, 0.33, 0.01, 276.0 * MPa},
    {.name = "ammonium-fluorescein",
     .density = 1350.0,
     .lowest_modulus = 1.2 * GPa,
     .highest_modulus = 1.2 * GPa,
     .poisson_ratio = 0.33,
     .source = "Li, X., Dunn, P. F. & Brach, R. M. (1999). J. Aerosol Sci. 30, 439-449, table 1, "
               "whose K and W_A these constants give; density after Pasha, M. et al. (2014). "
               "Granular Matter, doi 10.1007/s10035-013-0476-y"},
    {"borosilicate", "Pyrex glass", 2230.0, 70.0 * GPa, 70.0 * GPa, 0.20},
    {.name = "brass",
     .what = "C26000, annealed",
     .density = 8530.0,
     .lowest_modulus = 110.0 * GPa,
     .highest_modulus = 110.0 * GPa,
     .poisson_ratio = 0.35,
     .yield_strength = 110.0 * MPa,
     .source =
         "Callister, W. D. & Rethwisch, D. G. (2008), tables B.1 to B.3; yield strength: the "
         "middle of 75 MPa (table 7.2 of a later edition) and 145 MPa (Olin Brass, data sheet)"},
    {"concrete", "of all strengths", 2400.0, 25.4 * GPa, 36.6 * GPa, 0.20},
    {"copper", "C11000, hot rolled", 8890.0, 115.0 * GPa, 115.0 * GPa, 0.33, 0.01, 69.0 * MPa},
    {"fused-silica", "", 2200.0, 73.0 * GPa, 73.0 * GPa, 0.17},
    {"glass", "soda-lime", 2500.0, 69.0 * GPa, 69.0 * GPa, 0.23},
    {.name = "granite",
     .what = "of floors and walls",
     .density = 2700.0,
     .lowest_modulus = 30.0 * GPa,
     .highest_modulus = 70.0 * GPa,
     .poisson_ratio = 0.25,
     .poisson_ratio_sd = 0.05,
     .source = "National Research Council (1982). Conservation of Historic Stone Buildings and "
               "Monuments, National Academy Press, p. 64 (30 to 60 GPa); MakeItFrom.com, Granite "
               "(70 GPa, Poisson's ratio)"},
    {.name = "ice",
     .what = "polycrystal at 257 K",
     .density = 920.0,
     .lowest_modulus = 9.33 * GPa,
     .highest_modulus = 9.33 * GPa,
     .poisson_ratio = 0.325,
     .source = "Gammon, P. H., Kiefte, H., Clouter, M. J. & Denner, W. W. (1983). J. Glaciol. 29, "
               "433-460; density at 257 K after the CRC Handbook of Chemistry and Physics, "
               "properties of ice and supercooled water"},
    {"molybdenum", "commercially pure, no state named", 10220.0, 320.0 * GPa, 320.0 * GPa, 0.32,
     0.01, 500.0 * MPa},
    {"nickel", "alloy 200, annealed", 8890.0, 204.0 * GPa, 204.0 * GPa, 0.31, 0.01, 148.0 * MPa},
    {"nylon", "6,6, dry to moist", 1140.0, 1.59 * GPa, 3.79 * GPa, 0.39, 0.01, 63.8 * MPa},
    {"pmma", "acrylic glass", 1190.0, 2.24 * GPa, 3.24 * GPa, 0.405, 0.02, 63.45 * MPa},
    {"polycarbonate", "", 1200.0, 2.38 * GPa, 2.38 * GPa, 0.36, 0.01, 62.1 * MPa},
    {"polyethylene", "of high density", 959.0, 1.08 * GPa, 1.08 * GPa, 0.46, 0.01, 29.65 * MPa},
    {"polystyrene", "", 1050.0, 2.28 * GPa, 3.28 * GPa, 0.33, 0.01, 47.0 * MPa},
    {"ptfe", "", 2170.0, 0.40 * GPa, 0.55 * GPa, 0.46, 0.01, 14.5 * MPa},
    {.name = "rubber",
     .what = "natural to styrene-butadiene, vulcanised",
     .density = 950.0,
     .lowest_modulus = 1.5 * MPa,
     .highest_modulus = 10.0 * MPa,
     .poisson_ratio = 0.49,
     .source = "MatWeb, data sheet of natural rubber, vulcanized (density; the lowest Young's "
               "modulus, three times the shear modulus); Callister, W. D. & Rethwisch, D. G. "
               "(2008), table B.2 (the highest, of styrene-butadiene); rubber is almost "
               "incompressible"},
    // Elastic constants [GPa]: c11 496.8, c33 498.1, c44 147.4, c12 163.6, c13 110.9, c14 -23.5.
    // Young's modulus is 461 GPa along c, 425 GPa along a.
    {.name = "sapphire",
     .what = "single crystal, along any direction",
     .density = 3980.0,
     .lowest_modulus = 336.0 * GPa,
     .highest_modulus = 461.0 * GPa,
     .poisson_ratio = 0.23,
     .poisson_ratio_sd = 0.02,
     .source = "Aggarwal, R. & Ramdas, A. (2019). Physical Properties of Diamond and Sapphire, CRC "
               "Press, chapter 4: the elastic constants of Wachtman et al., from which follow the "
               "smallest and the largest Young's modulus of all directions and the mean Poisson's "
               "ratio; density after Roditi International, Sapphire Properties"},
    {"silicon", "single crystal, along [100]", 2330.0, 129.0 * GPa, 129.0 * GPa, 0.28},
    {"silicon-carbide", "sintered", 3200.0, 207.0 * GPa, 483.0 * GPa, 0.16},
    {.name = "stainless",
     .what = "alloy 304, annealed",
     .density = 8000.0,
     .lowest_modulus = 193.0 * GPa,
     .highest_modulus = 193.0 * GPa,
     .poisson_ratio = 0.30,
     .yield_strength = 205.0 * MPa,
     .source = stainless_source},
    {.name = "stainless-316",
     .what = "alloy 316, annealed",
     .density = 8000.0,
     .lowest_modulus = 193.0 * GPa,
     .highest_modulus = 193.0 * GPa,
     .poisson_ratio = 0.30,
     .yield_strength = 205.0 * MPa,
     .source = stainless_source},
    {"stainless-440", "alloy 440A, of balls, tempered at 315 C", 7800.0, 200.0 * GPa, 200.0 * GPa,
     0.30, 0.01, 1650.0 * MPa},
    {"steel", "alloy 4140, normalised", 7850.0, 207.0 * GPa, 207.0 * GPa, 0.30, 0.01, 655.0 * MPa},
    {"titanium", "Ti-6Al-4V, annealed", 4430.0, 114.0 * GPa, 114.0 * GPa, 0.34, 0.01, 830.0 * MPa},
    {.name = "tungsten-carbide",
     .what = "cemented, 6 % cobalt",
     .density = 14900.0,
     .lowest_modulus = 624.0 * GPa,
     .highest_modulus = 624.0 * GPa,
     .poisson_ratio = 0.21,
     .source =
         "Foote, K. G. & MacLennan, D. N. (1984). J. Acoust. Soc. Am. 75, 612-616: density "
         "and speeds of sound (6864 and 4161.2 m/s) of calibration spheres, from which follow "
         "Young's modulus and Poisson's ratio"},
    {.name = "wood",
     .what = "oak or maple, across the grain",
     .density = 700.0,
     .lowest_modulus = 0.90 * GPa,
     .highest_modulus = 2.2 * GPa,
     .poisson_ratio = 0.4,
     .poisson_ratio_sd = 0.1,
     .source = "Forest Products Laboratory (1999). Wood Handbook, FPL-GTR-113, chapter 4: modulus "
               "along the grain 1.1 times that in bending, times the elastic ratios, tangential of "
               "sugar maple to radial of white oak, at 12 % moisture"},
    {"zirconia", "3 mol% yttria", 6000.0, 205.0 * GPa, 205.0 * GPa, 0.31},
};

struct OtherName {
  std::string_view other;  ///< as `plain_word` writes it
  std::string_view name;
};

/// Names that mean the same material.
constexpr OtherName other_names[] = {
    {"acrylic", "pmma"},
    {"acrylicglass", "pmma"},
    {"aluminiumoxide", "alumina"},
    {"aluminum", "aluminium"},
    {"aluminumoxide", "alumina"},
    {"fusedquartz", "fused-silica"},
    {"hdpe", "polyethylene"},
    {"perspex", "pmma"},
    {"plexiglas", "pmma"},
    {"plexiglass", "pmma"},
    {"polymethylmethacrylate", "pmma"},
    {"polystyrenelatex", "polystyrene"},
    {"polytetrafluoroethylene", "ptfe"},
    {"psl", "polystyrene"},
    {"pyrex", "borosilicate"},
    {"silica", "fused-silica"},
    {"sodalime", "glass"},
    {"sodalimeglass", "glass"},
    {"stainless304", "stainless"},
    {"stainlesssteel", "stainless"},
    {"stainlesssteel304", "stainless"},
    {"stainlesssteel316", "stainless-316"},
    {"stainlesssteel440", "stainless-440"},
    {"stone", "granite"},
    {"teflon", "ptfe"},
    {"vitreoussilica", "fused-silica"},
    {"woodfloor", "wood"},
};

/// The material with this name, or with another one that means the same; null for an unknown name.
const TabledMaterial* find_material(std::string_view name) {
  std::string plain = plain_word(name);
  const auto* const other = std::ranges::find(other_names, plain, &OtherName::other);
  if (other != std::end(other_names)) plain = plain_word(other->name);
  const auto* const found = std::ranges::find_if(
      materials, [&](const TabledMaterial& one) { return plain_word(one.name) == plain; });
  return found == std::end(materials) ? nullptr : found;
}

}  // namespace

double TabledMaterial::youngs_modulus_sd() const {
  constexpr double of_one_value = 0.02;
  return highest_modulus > lowest_modulus ? (highest_modulus - lowest_modulus) / std::sqrt(12.0)
                                          : of_one_value * lowest_modulus;
}

std::span<const TabledMaterial> tabled_materials() { return materials; }

std::string_view source_of_tabled(std::string_view name) {
  const TabledMaterial* const found = find_material(name);
  return found == nullptr ? std::string_view() : found->source;
}

Json tabled_material(const std::string& name, const std::string& option) {
  const TabledMaterial* const found = find_material(name);
  if (found == nullptr) {
    std::vector<std::string> names;
    for (const TabledMaterial& one : materials) names.emplace_back(one.name);
    throw InputError(
        {}, fmt::format("{} {} is no file and no material of the table", option, quote(name)),
        "recoil materials lists them", did_you_mean(name, names));
  }
  Json json = {
      {"material", found->name},
      {"density", {{"value", found->density}, {"relative_sd", tabled_density_error}}},
      {"youngs_modulus", {{"value", found->youngs_modulus()}, {"sd", found->youngs_modulus_sd()}}},
      {"poisson_ratio", {{"value", found->poisson_ratio}, {"sd", found->poisson_ratio_sd}}}};
  if (found->yield_strength > 0.0) json["yield_strength"] = found->yield_strength;
  return json;
}

}  // namespace recoil
