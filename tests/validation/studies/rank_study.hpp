#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/names.hpp"
#include "data/dataset.hpp"
#include "document/document.hpp"
#include "plot/plot.hpp"
#include "validation/studies/study.hpp"

namespace recoil {

/// Of what kind the simulated data are.
enum class RankArm { stated_noise, estimated_noise, captures, uncertain_constants };
constexpr auto names_of_values(RankArm) {
  return name_list("stated_noise", "estimated_noise", "captures", "uncertain_constants");
}
inline constexpr std::array rank_arms = values_of<RankArm>();

/// Ammonium fluorescein on molybdenum (Li, Dunn & Brach 1999, Table 1), without points.
Dataset fluorescein_on_molybdenum();

/// Draws of the posterior that one rank is taken among, evenly spaced among all.
inline constexpr int rank_draws = 99;

/// One parameter in the data sets of one arm.
struct RankRow {
  RankArm arm = RankArm::stated_noise;
  std::string parameter;
  int unsettled = 0;       ///< data sets without a posterior
  std::vector<int> ranks;  ///< of the truth among `rank_draws` draws: 0 to 99
  RECOIL_FIELDS(arm, parameter, unsettled, ranks)
};

struct RankStudy {
  StudyStamp stamp;
  int sets = 0;  ///< of every arm
  std::uint64_t seed = 0;
  std::vector<RankRow> rows;
  RECOIL_FIELDS(sets, seed, rows)
};

/// Simulation-based calibration (Talts, Betancourt, Simpson, Vehtari & Gelman 2018,
/// arXiv:1804.06788): where data come from the prior and the model, the ranks are uniform.
/// @param kept a folder for what is finished; empty: nowhere
RankStudy study_ranks(int sets, std::uint64_t seed, int threads, const std::string& kept);

/// How far ranks are from uniform, against simultaneous bands (Saeilynoja, Buerkner & Vehtari 2022,
/// Stat. Comput. 32, 32): at each of the ranks i the number of data sets with a rank of i or less
/// is binomial; the smallest of all two-sided probabilities is compared with that of uniform ranks.
struct RankBand {
  std::vector<double> lower, upper;  ///< 95 % bands of the share with rank i or less, i = 0 to 98
  std::vector<double> least;         ///< ascending: the smallest probabilities of uniform ranks
};
RankBand rank_band(int sets);
/// The share of uniform samples that are as far from uniform.
double rank_p_value(const std::vector<int>& ranks, const RankBand& band);

Document page_of(const RankStudy& study);
plot::Picture picture_of(const RankStudy& study);

}  // namespace recoil
