#pragma once

#include <array>
#include <string_view>

#include "core/names.hpp"

namespace recoil {

/// How the bootstrap makes a new data set from the fit and the points.
enum class Scheme {
  automatic,   ///< "auto": chosen by the rule of `plan_resampling`
  parametric,  ///< new noise of the fit's size about the fitted curve
  residual,    ///< the residuals, scaled for leverage and centred, exchanged among the points
  wild,        ///< each point keeps its own residual, with a random sign
  cases,       ///< "case": whole points drawn with replacement
  cluster,     ///< whole series drawn with replacement
};

/// As fit files, the command line and fit.json have it.
template <>
struct NamesOf<Scheme> {
  static constexpr std::array<std::string_view, 6> names = {"auto", "parametric", "residual",
                                                            "wild", "case",       "cluster"};
};

}  // namespace recoil
