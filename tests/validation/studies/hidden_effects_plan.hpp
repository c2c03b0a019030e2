#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/names.hpp"
#include "validation/synthetic/case.hpp"

namespace recoil::hidden {

/// How many data sets of each kind; `study_parts` says of what.
struct StudySize {
  int per_cell = 4, correct = 400, pairs = 4, outside = 10, single = 4, careless = 6, bent = 2;
  int other_law = 2, base_bent = 100, impossible = 1, conditions = 1, loop = 1, dropped = 2;
  int rounded = 4, odd = 6;
  std::uint64_t seed = 20260101;
};

/// A kind of data sets, as an option of the study.
struct StudyPart {
  const char* option;
  int StudySize::*count;
  const char* words;  ///< of what there are so many
};
const std::vector<StudyPart>& study_parts();

/// Signal-to-noise of one effect [1].
inline constexpr std::array study_strengths = {5.0, 10.0, 20.0, 40.0};
inline constexpr double visible = 10.0;  ///< signal-to-noise from which on the bars count

/// What a data set is in the study for.
enum class Arm {
  effect,
  correct,
  pair,
  outside,
  single,
  careless,
  bent,            ///< an effect whose law is wrong by 10 %
  bent_more,       ///< by 20 %
  other_law,       ///< an effect by another published law
  other_adhesive,  ///< by one of dry contacts, where adhesion acts as well
  base_bent,       ///< nothing hidden, the losses of the base model wrong by 3 %
  impossible,      ///< an effect beyond what nature has
  stated,          ///< an effect whose condition is stated
  varied,          ///< an effect whose condition is changed for half of the points
  loop,            ///< an effect that is asked for again after doing what the answer advises
  dropped,         ///< an effect in drops of spheres of millimetres
  settings,        ///< heights that were set wrong, each by itself
  rounded,         ///< drops of which heights or times of flight are read to a finite step
  odd              ///< a few points are misread
};
constexpr auto names_of_values(Arm) {
  return name_list("effect", "correct", "pair", "outside", "single", "careless", "bent",
                   "bent_more", "other_law", "other_adhesive", "base_bent", "impossible", "stated",
                   "varied", "loop", "dropped", "settings", "rounded", "odd");
}
Arm arm_of(const CaseOrder& order);

/// Shuffled, the same way for equal sizes and seeds: what is done of a study that ends early is a
/// fair sample of all of it.
std::vector<CaseOrder> plan_study(const StudySize& size);

}  // namespace recoil::hidden
