#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/names.hpp"

namespace recoil {

/// A step of the way from events to points that can be left out.
enum class Correction {
  none_left_out,
  probe_plane,     ///< velocities taken at the measuring plane, not at the surface
  second_impacts,  ///< second and further impacts used like first ones
  survivors,       ///< the captured not counted: means of rebounds taken as means of all
  all_left_out
};

template <>
struct NamesOf<Correction> {
  static constexpr std::array<std::string_view, 5> names = {
      "none_left_out", "probe_plane", "second_impacts", "survivors", "all_left_out"};
};

/// The points and the fit when one correction is left out.
struct CorrectionRow {
  Correction left_out = Correction::none_left_out;
  std::size_t points = 0;
  std::size_t captured = 0;          ///< spheres that the points call captured
  std::optional<double> error_slow;  ///< mean over rebounds of e - truth at the point's own size
                                     ///< and velocity, below `slow_impacts` [1]
  std::optional<double> error_fast;  ///< the same above [1]
  std::vector<std::optional<double>> error;  ///< the same by velocity of the design [1]
  bool usable = false;                       ///< the fit has an answer
  double C_H = 0.0, C_H_sd = 0.0;            ///< [s/m]
  double C_A = 0.0, C_A_sd = 0.0;            ///< [s/m]
  double capture_velocity = 0.0;             ///< at d10 [m/s]
  double rmse = 0.0;                         ///< of e [1]
};

/// What each correction does to e and to the parameters, on one set of events.
struct CorrectionStudy {
  std::size_t passages = 0;
  double rebounds_per_velocity = 0.0;
  std::size_t size_classes = 1;
  std::vector<double> velocities;                       ///< [m/s]
  double diameter = 0.0;                                ///< d10 [m]
  double C_H = 0.0, C_A = 0.0, capture_velocity = 0.0;  ///< the truth [s/m, s/m, m/s]
  std::vector<CorrectionRow> rows;                      ///< in the order of `Correction`
};

/// What `recoil_study corrections FIT` leaves beside the recipe of a dataset, for the report.
inline constexpr const char* correction_studies_name = "corrections.json";

/// All studies of one dataset, and what they were made from.
struct CorrectionStudies {
  std::string inputs;  ///< correction_inputs() of the fit, the dataset and the recipe
  std::vector<CorrectionStudy> studies;
};

/// Changes with the fit file, the dataset or its recipe.
std::string correction_inputs(const std::string& fit_sha256, const std::string& dataset_sha256,
                              const std::string& recipe_text);

/// The same as JSON, and back.
/// @throws InputError naming `file` when the text is not such a JSON
std::string correction_studies_json(const CorrectionStudies& studies);
CorrectionStudies parse_correction_studies(const std::string& text, const std::string& file);
CorrectionStudies read_correction_studies(const std::filesystem::path& file);

/// Below it adhesion shows in the restitution of the paper's steel spheres [m/s].
inline constexpr double slow_impacts = 0.7;

}  // namespace recoil
