#include "impact/admissible.hpp"

#include <cmath>

#include "impact/jkr_law.hpp"
#include "impact/maugis_law.hpp"

namespace recoil {
namespace {

bool is_size(double x) { return std::isfinite(x) && x >= 0.0; }

bool vanishes(const ImpactGroups& groups, AdhesionLaw law) {
  switch (law) {
    case AdhesionLaw::ring:
    case AdhesionLaw::dmt:
      return false;
    case AdhesionLaw::maugis:
      return groups.range < MaugisLaw::least_range || groups.beta < MaugisLaw::least_beta;
    case AdhesionLaw::jkr:
      return groups.beta < JkrLaw::least_beta;
  }
  return false;
}

}  // namespace

bool is_admissible(const ImpactGroups& groups, const ImpactOptions& options) {
  const bool base = is_size(groups.alpha) && is_size(groups.beta) && is_size(groups.gamma);
  const bool holds_dashpot = options.adhesion != AdhesionLaw::maugis;
  const bool dashpot =
      options.dashpot ? holds_dashpot && is_size(groups.kappa) : groups.kappa == 0.0;
  const bool range = options.adhesion != AdhesionLaw::maugis ||
                     (is_size(groups.range) && groups.range <= MaugisLaw::largest_range);
  return base && dashpot && range;
}

std::optional<std::pair<ImpactGroups, ImpactOptions>> without_adhesion(
    const ImpactGroups& groups, const ImpactOptions& options) {
  if (!vanishes(groups, options.adhesion)) return std::nullopt;
  std::pair<ImpactGroups, ImpactOptions> simpler(groups, options);
  simpler.first.beta = 0.0;
  simpler.second.adhesion = AdhesionLaw::ring;
  return simpler;
}

}  // namespace recoil
