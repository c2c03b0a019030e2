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
      {"", "dataset", "", "the folder with the points, or a list: they are fitted together"},
      {"", "model", "", "the table [model]"},
      {"", "parameters", "", "the table [parameters]"},
      {"", "noise", "", "the table [noise]"},
      {"", "uncertainty", "", "the table [uncertainty]"},
      {"", "diagnosis", "", "the table [diagnosis]"},

      {"model", "adhesion", quoted(name_of(fit.adhesion)),
       "the law of adhesion: ring (eq. 5, with f0), jkr, dmt, or maugis between these two (all "
       "three with W)"},
      {"model", "separation", fmt::format("{:g}", fit.separation),
       "z0 [m], the distance of the surfaces at rest, which sets the range of adhesion under "
       "maugis"},
      {"model", "adhesion_damping_phase", quoted(name_of(fit.phase)),
       "when the damping of the adhesion acts: while the sphere moves outward (rebound), or in "
       "both "
       "phases"},
      {"model", "loss", "",
       "the loss of the dry contact: hunt_crossley (C_H), viscoelastic (bulk_relaxation), constant "
       "(hysteretic_share), yield (yield_pressure), the last three in place of C_H, or auto: all "
       "are fitted and the points choose; by default auto where there is no adhesion, else "
       "hunt_crossley"},
      {"model", "mechanisms", "[]", "ids of the mechanisms that are added to the base model"},
      {"model", "mixed_sizes", truth_value(fit.mixed_sizes),
       "where a dataset says that its points average over a distribution of sizes, average over "
       "it; "
       "false takes every sphere of a point at the point's diameter"},

      {"parameter", "initial", "", "where the fit starts; the value of a fixed parameter"},
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
       "error of e that the points of one setting share [1]; 0: none, \"estimated\": also where no "
       "column names the settings; by default estimated where one does"},
      {"noise", "velocity_errors", truth_value(noise.velocity_errors),
       "use the column velocity_sd"},
      {"noise", "velocity_relative_sd", fmt::format("{:g}", noise.velocity_relative_sd),
       "relative standard deviation for points that state no velocity_sd"},
      {"noise", "diameter_errors", truth_value(noise.diameter_errors),
       "use the column diameter_sd"},
      {"noise", "diameter_relative_sd", fmt::format("{:g}", noise.diameter_relative_sd),
       "relative standard deviation for points that state no diameter_sd"},

      {"uncertainty", "replicates", fmt::format("{}", uncertainty.replicates),
       "replicates of the bootstrap; 0: none, \"auto\": as many as it takes"},
      {"uncertainty", "scheme", quoted(name_of(uncertainty.scheme)),
       "how the bootstrap draws new data sets"},
      {"uncertainty", "level", fmt::format("{:g}", uncertainty.level), "level of every interval"},
      {"uncertainty", "materials", truth_value(uncertainty.materials != Materials::exact),
       "the errors that the datasets state for their material constants widen every interval; "
       "\"adjust\" lets the points move the constants within their errors, false takes them as "
       "exact"},
      {"uncertainty", "posterior", truth_value(uncertainty.posterior),
       "sample the posterior: one more kind of interval, and joint draws in posterior.csv"},
      {"uncertainty", "own_design", "",
       "simulate the fitted truth anew and count how often the quoted intervals contain it "
       "(`own_design.coverage`): true (200 data sets), false, or how many; by default 200 where "
       "that takes less than about 10 s of one core"},
      {"uncertainty", "seed", fmt::format("{}", uncertainty.seed),
       "seed of the random numbers; fixes every digit of every output"},

      {"diagnosis", "law_error", fmt::format("{:g}", fit.law_error),
       "relative error, smooth in V and d, that a diagnosis allows the law of a mechanism; the "
       "losses of the base model are allowed three tenths of it; 0 takes the laws as exact"},
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
