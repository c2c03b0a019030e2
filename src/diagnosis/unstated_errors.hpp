#pragma once

#include <vector>

#include "core/names.hpp"
#include "diagnosis/candidate_result.hpp"

namespace recoil {

struct SearchBase;

enum class ErrorSource {
  velocity_errors,    ///< every incident velocity is uncertain by the same part of itself
  larger_deviations,  ///< all standard deviations are too small by the same factor
};
template <>
struct NamesOf<ErrorSource> {
  static constexpr std::array<std::string_view, 2> names = {"velocity_errors", "larger_deviations"};
};

/// Errors of the measurement beyond the stated ones that might do in place of a cause.
struct UnstatedErrors {
  ErrorSource source = ErrorSource::velocity_errors;
  double value = 0.0;       ///< relative sd of every velocity [1], or factor on every deviation [1]
  double delta_aicc = 0.0;  ///< criterion less that of the base model as stated
  double remaining_p = 0.0;  ///< of what is systematic, or of heavy tails, under them

  bool leave_nothing() const { return delta_aicc < 0.0 && remaining_p >= tolerated_level; }
};

/// What the stated standard deviations say of the misfit if they are not taken at their word: the
/// base model fitted with larger errors, which is no cause but may do without one. Empty where no
/// standard deviations are stated, as their size then follows the residuals, and under Student's t.
///
/// - velocity_errors: every incident velocity is uncertain by the same part s of itself, which
///   counts most where e is steep, close to capture. Of a grid of s, and the parabola through the
///   best three, the smallest sum 2 ln sd_i + r_i^2. Only where no velocity errors are stated.
/// - larger_deviations: all standard deviations are too small by the same factor,
///   sqrt(chi^2 / dof); the structure is then sought in residuals in units of their own size.
///
/// What is left is judged by the tests of the residuals and by their tails: where a few points are
/// far off, the rest is no worse than stated.
std::vector<UnstatedErrors> unstated_errors(const SearchBase& base);

}  // namespace recoil
