#pragma once

#include <string>
#include <vector>

#include "core/names.hpp"
#include "validation/synthetic/case.hpp"

namespace hidden {

/// How many data sets of each kind.
struct StudySize {
  int per_cell = 4;   ///< of each effect, design and strength
  int correct = 400;  ///< with nothing hidden, in designs of several diameters
  int pairs = 4;      ///< of each pair and design
  int outside = 10;   ///< of each outside effect, design and strength
  int single = 4;     ///< of each effect and strength in designs of one diameter
  int careless = 6;   ///< of each kind of error that is not stated, and design
  int bent = 2;       ///< of each effect, design and visible strength, with laws bent by 10 %
  int other_law = 2;  ///< of each effect that has one, design and visible strength, made by another
                      ///< published law
  int base_bent = 100;  ///< with nothing hidden and the losses of the base model bent by 3 %
  int impossible = 1;   ///< of each effect and design, at three times what nature has
  int conditions = 1;  ///< of each effect that a condition takes away, design and visible strength,
                       ///< with its condition stated, and again varied
  int loop = 1;        ///< of each effect, design and visible strength, asked again after doing
                       ///< what the answer advises
  int dropped = 2;     ///< of each effect that drops by hand may have and visible strength, of each
                       ///< error of a setting; and six times as many with nothing hidden
  int rounded = 4;     ///< of each step of reading, design of drops and effect
  int odd = 6;         ///< of each design, with a few points misread
  std::uint64_t seed = 20260101;
};

inline const std::vector<double>& study_strengths() {
  static const std::vector<double> strengths = {5.0, 10.0, 20.0, 40.0};
  return strengths;
}
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
Arm arm_of(const CaseOrder& order);

/// Shuffled, the same way for equal sizes and seeds: what is done of a study that ends early is a
/// fair sample of all of it.
std::vector<CaseOrder> plan_study(const StudySize& size);

}  // namespace hidden

template <>
struct recoil::NamesOf<hidden::Arm> {
  static constexpr std::array<std::string_view, 19> names = {
      "effect",    "correct",   "pair",           "outside",   "single",     "careless", "bent",
      "bent_more", "other_law", "other_adhesive", "base_bent", "impossible", "stated",   "varied",
      "loop",      "dropped",   "settings",       "rounded",   "odd"};
};
