#include "estimate/fit_keys.hpp"

#include <fmt/format.h>

#include "estimate/fit_spec.hpp"

namespace recoil {
namespace {

std::string quoted(std::string_view word) { return fmt::format("\"{}\"", word); }

std::string truth_value(bool value) { return value ? "true" : "false"; }

std::vector<FitKey> all_keys() {
  const FitSpec fit;
  const NoiseSpec noise;
  const UncertaintySpec uncertainty;
  return {
      {"", "dataset", "", "dataset folder, or a list of folders that are fitted together"},
      {"", "model", "", "the table [model]"},
      {"", "parameters", "", "the table [parameters]"},
      {"", "noise", "", "the table [noise]"},
      {"", "uncertainty", "", "the table [uncertainty]"},
      {"", "diagnosis", "", "the table [diagnosis]"},

      {"model", "adhesion", quoted(name_of(fit.adhesion)),
       "law of adhesion: ring (eq. 5, with f0), jkr, dmt or maugis (between jkr and dmt); the last "
       "three have W instead of f0"},
      {"model", "separation", fmt::format("{:g}", fit.separation),
       "z0 [m], distance of the surfaces in equilibrium, which sets the range of adhesion under "
       "maugis"},
      {"model", "adhesion_damping_phase", quoted(name_of(fit.phase)),
       "when adhesion damping acts: during rebound, or in both phases"},
      {"model", "loss", "",
       "loss law of the dry contact: hunt_crossley (C_H), viscoelastic (bulk_relaxation), constant "
       "(hysteretic_share) or yield (yield_pressure); the last three replace C_H. auto fits all of "
       "them and chooses by AICc. Default: auto without adhesion, else hunt_crossley"},
      {"model", "mechanisms", "[]", "ids of the mechanisms that are added to the base model"},
      {"model", "mixed_sizes", truth_value(fit.mixed_sizes),
       "true: average over the size distribution that a dataset states; false: every sphere has "
       "the diameter of its point"},

      {"parameter", "initial", "", "initial value, or the value of a fixed parameter"},
      {"parameter", "bounds", "", "[lower, upper]"},
      {"parameter", "free", "", "whether it is fitted"},
      {"parameter", "per", "",
       "\"dataset\": one value for each dataset of a joint fit instead of one for all"},

      {"noise", "variance", quoted("auto"), "how the scatter depends on e and V"},
      {"noise", "residuals", quoted(noise.student ? "student" : "normal"),
       "normal, or student, which gives outliers less weight"},
      {"noise", "student_dof", fmt::format("{:g}", noise.student_dof),
       "degrees of freedom of Student's t"},
      {"noise", "setting_sd", "",
       "standard deviation of an error of e that the points of one setting share [1]; 0: none; "
       "\"estimated\": from the points, even if no column names the settings. Default: estimated "
       "if a column does"},
      {"noise", "velocity_errors", truth_value(noise.velocity_errors),
       "use the column velocity_sd"},
      {"noise", "velocity_relative_sd", fmt::format("{:g}", noise.velocity_relative_sd),
       "relative standard deviation for points that state no velocity_sd"},
      {"noise", "diameter_errors", truth_value(noise.diameter_errors),
       "use the column diameter_sd"},
      {"noise", "diameter_relative_sd", fmt::format("{:g}", noise.diameter_relative_sd),
       "relative standard deviation for points that state no diameter_sd"},

      {"uncertainty", "replicates", fmt::format("{}", uncertainty.replicates),
       "number of bootstrap replicates; 0: none; \"auto\": until the intervals are precise enough"},
      {"uncertainty", "scheme", quoted(name_of(uncertainty.scheme)),
       "resampling scheme of the bootstrap"},
      {"uncertainty", "level", fmt::format("{:g}", uncertainty.level), "level of every interval"},
      {"uncertainty", "materials", truth_value(uncertainty.materials != Materials::exact),
       "true: the stated errors of material constants widen every interval; \"adjust\": the "
       "constants are fitted too, with their stated errors as priors; false: the constants are "
       "exact"},
      {"uncertainty", "posterior", truth_value(uncertainty.posterior),
       "sample the posterior; this adds its intervals and writes joint draws to posterior.csv"},
      {"uncertainty", "own_design", "",
       "measure the coverage of the quoted intervals with simulated data sets of this design "
       "(`own_design.coverage`): true (200 data sets), false, or a number. Default: 200 if that "
       "takes less than about 10 s on one core"},
      {"uncertainty", "seed", fmt::format("{}", uncertainty.seed),
       "seed of the random numbers; fixes every digit of every output"},

      {"diagnosis", "law_error", fmt::format("{:g}", fit.law_error),
       "relative error, smooth in V and d, that a diagnosis allows in the law of a mechanism; "
       "three tenths of it in the losses of the base model; 0: the laws are exact"},
  };
}

}  // namespace

const std::vector<FitKey>& fit_keys() {
  static const std::vector<FitKey> keys = all_keys();
  return keys;
}

std::vector<std::string> fit_keys_of(std::string_view table) {
  std::vector<std::string> names;
  for (const FitKey& key : fit_keys()) {
    if (key.table == table) names.emplace_back(key.name);
  }
  return names;
}

}  // namespace recoil
