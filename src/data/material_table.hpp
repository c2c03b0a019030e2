#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/json.hpp"

namespace recoil {

/// Callister, W. D. & Rethwisch, D. G. (2008), tables B.1 (density), B.2 (Young's modulus), B.3
/// (Poisson's ratio) and B.4 (yield strength: the middle of a range; of titanium the stated
/// minimum), which compile the ASM Handbooks and manufacturers' data.
inline constexpr std::string_view tabled_materials_source =
    "Callister, W. D. & Rethwisch, D. G. (2008). Fundamentals of Materials Science and "
    "Engineering, 3rd ed., Wiley, tables B.1 to B.4";

/// A common material of spheres and surfaces, with one standard deviation of each constant.
struct TabledMaterial {
  std::string_view name;
  std::string_view what = {};      ///< grade or composition
  double density = 0.0;            ///< [kg/m3], with the error `tabled_density_error`
  double lowest_modulus = 0.0;     ///< Young's modulus [Pa]: lower end of the source's range
  double highest_modulus = 0.0;    ///< [Pa]; equal to the lowest if the source gives one value
  double poisson_ratio = 0.0;      ///< [1]
  double poisson_ratio_sd = 0.01;  ///< [1]
  double yield_strength = 0.0;  ///< in tension [Pa]; 0: it is not in the source, or does not yield
  std::string_view source = tabled_materials_source;

  double youngs_modulus() const { return 0.5 * (lowest_modulus + highest_modulus); }
  /// The standard deviation of a uniform distribution over the range; 2 % of a single value [Pa].
  double youngs_modulus_sd() const;
};

/// The relative standard deviation of every density in the table [1]; the source states none.
inline constexpr double tabled_density_error = 0.01;

std::span<const TabledMaterial> tabled_materials();

// Names of materials: blanks, hyphens and case do not count, and "silica" is "fused-silica".

/// The source of the material `name`; empty for an unknown name.
std::string_view source_of_tabled(std::string_view name);

/// The material as an object of datapackage.json. @param option for messages: "--particle"
/// @throws InputError for an unknown name
Json tabled_material(const std::string& name, const std::string& option);

}  // namespace recoil
