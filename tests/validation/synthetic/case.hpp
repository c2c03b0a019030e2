#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/names.hpp"
#include "validation/synthetic/hidden_effect.hpp"
#include "validation/synthetic/strength.hpp"

namespace recoil::hidden {

/// What the table says of the conditions.
enum class Circumstances {
  unstated,
  stated,  ///< of all points, those behind the effects
  varied  ///< not of these, but the same rows again under a change that takes the first effect away
};
constexpr auto names_of_values(Circumstances) { return name_list("unstated", "stated", "varied"); }

/// What to make. Equal orders give equal digits.
struct CaseOrder {
  std::string design = {};
  std::vector<std::string> effects = {};  ///< none, one, or several together
  double signal_to_noise = 0.0;           ///< that each of them alone would leave
  std::uint64_t index = 0;                ///< which of the data sets of this kind
  std::uint64_t seed = 20260101;
  double law_bend = 0.0;   ///< the effects' laws are wrong by a smooth factor of this size [1]
  double base_bend = 0.0;  ///< the losses of the base model likewise
  /// Above 0: the one effect at so many times the largest strength that nature has.
  double beyond = 0.0;
  Circumstances circumstances = Circumstances::unstated;
  bool other_law = false;  ///< the effects follow second published laws (sphere.hpp)
  int rounds = 0;  ///< how often the first of what the answer advises is done, and asked again
  /// Of drops. The deviations of two data sets in four state what it does.
  Readout readout = Readout::exact;
  RECOIL_FIELDS(design, effects, signal_to_noise, index, seed, law_bend, base_bend, beyond,
                circumstances, other_law, rounds, readout)

  /// wall+plastic_yield+probe_plane@10#3; bent by 10 % and 3 %: wall+plastic_yield~10%~base3%@20#0;
  /// by another published law: wall+plastic_yield:other@20#0;
  /// three times what is possible: wall+velocity_offset*3@0#0; with its condition varied, and asked
  /// again up to three times: wall+gas_film|varied@10#0^3; heights read to 1 mm:
  /// drops/millimetre@0#0
  std::string key() const;
  /// The same for all strengths of one experiment, so that these differ in strength only.
  std::uint64_t experiment_seed() const;
};
/// Do its standard deviations include the rounding of what is read?
bool states_rounding(const CaseOrder& order);

struct Case {
  CaseOrder order;
  Design design;
  bool reached = false;           ///< all strengths lie within what nature has
  std::vector<double> strengths;  ///< one per effect, with sign
  Effects effects;
  std::vector<StatedCondition> conditions;  ///< of all points
  std::vector<Point> points;                ///< without noise
  Refit refit;                              ///< of the base to them, all effects at work
  std::vector<double> readings;             ///< the mean of the events of each point, with noise
  std::vector<bool> odd;                    ///< misread by more than 5 standard deviations [points]
};

/// Draws the experiment and its nuisances, tunes every effect by itself to the wanted misfit, and
/// takes the readings.
/// @throws std::invalid_argument for an unknown design or effect
Case make_case(const CaseOrder& order);

/// A name that is different for every order and says nothing.
std::string neutral_name(const CaseOrder& order);

/// Impacts of one size at one velocity that are measured after a first answer.
struct FurtherImpacts {
  double diameter = 0.0;    ///< [m]
  double velocity = 0.0;    ///< [m/s]
  int events = 0;           ///< all of them
  StatedCondition changed;  ///< the condition that differs; its name is empty if none does
  RECOIL_FIELDS(diameter, velocity, events, changed)
};

/// Measures them: one point with their mean, its noise drawn by `round`. A diameter that no row has
/// makes a row.
void take_further(Case& made, const FurtherImpacts& further, std::uint64_t round);

/// Writes what the diagnosis may see into `folder`: the dataset NAME/ and the fit NAME.toml beside
/// it; NAME says nothing. @return the path of the fit
std::filesystem::path write_case(const Case& made, const std::filesystem::path& folder);

/// A folder of its own below the system's temporary one, removed at the end.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace recoil::hidden
