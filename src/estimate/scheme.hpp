#pragma once

#include <optional>
#include <string>
#include <vector>

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

/// The name that fit files, the command line and fit.json use: "auto", "parametric", "residual",
/// "wild", "case", "cluster".
std::string to_string(Scheme scheme);

/// Every name, in the order of the enumerators.
const std::vector<std::string>& scheme_names();

std::optional<Scheme> scheme_named(const std::string& name);

}  // namespace recoil
