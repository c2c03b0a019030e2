#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "validation/studies/coverage_study.hpp"

namespace recoil {

/// Data as people have them, whose noise is hard to know: one target (or two), spheres of one size
/// (or three), and velocities evenly in ln V. `truth` code makes them, which shares none with the
/// fitter.
struct NoiseDesign {
  std::string_view name = {};
  bool stated = true;    ///< is `restitution_sd` given?
  int sizes = 1;         ///< 1 or 3
  int targets = 1;       ///< the second has three times the noise
  int velocities = 20;   ///< of each size
  int rows = 1;          ///< at each velocity
  double slowest = 1.1;  ///< times V*
  double fastest = 40.0;
  int fewest_events = 1, most_events = 1;  ///< impacts that a row averages, even in the logarithm
  double sd = 0.02;                        ///< of one reading of e [1]
  double growth = 1.0;                     ///< sd at V* over sd far above it [1]
  double spread = 0.0;         ///< relative sd of V* from impact to impact; captures are counted
  bool of_sample = false;      ///< `restitution_sd` is that of the row's own impacts
  double setting_sd = 0.0;     ///< of e, shared by the rows of one velocity; `setting` names them
  double height_sd = 0.0;      ///< relative, of the drop height of the rows of one velocity
  bool height_stated = false;  ///< as `setting_velocity_sd`
  double batch_sd = 0.0;  ///< relative, of the diameter of a size; stated as series_diameter_sd
  bool jkr = false;       ///< data of that law, fitted with the ring law
  std::string_view warning = {};  ///< what a warning that names the trouble says
};
const std::vector<NoiseDesign>& noise_designs();

/// `measure_coverage` of a design. A parameter counts as poorly determined also in data sets whose
/// fit carries the warning of the design, and so does V* without an interval.
CoverageResult measure_noise(const NoiseDesign& design, const CoverageOptions& options);

/// All designs, kept as those of a grid.
CoverageStudy study_noise(const CoverageOptions& options, const std::filesystem::path& kept);

}  // namespace recoil
