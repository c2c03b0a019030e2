#include "impact/laws.hpp"

#include <array>
#include <cmath>

namespace recoil {
namespace {

bool is_size(double x) { return std::isfinite(x) && x >= 0.0; }

}  // namespace

const AdhesionLawTraits& traits(AdhesionLaw law) {
#define RECOIL_TRAITS(name, Law) traits_of<Law>(),
  static constexpr std::array all = {RECOIL_ADHESION_LAWS(RECOIL_TRAITS)};
#undef RECOIL_TRAITS
  return all.at(static_cast<std::size_t>(law));
}

bool is_admissible(const ImpactGroups& groups, const ImpactOptions& options) {
  if (!is_size(groups.alpha) || !is_size(groups.beta) || !is_size(groups.gamma)) return false;
  const bool dashpot = options.dashpot
                           ? traits(options.adhesion).has_dashpot && is_size(groups.kappa)
                           : groups.kappa == 0.0;
  return dashpot && with_law(options.adhesion, [&]<class Law>() { return Law::admits(groups); });
}

std::optional<std::pair<ImpactGroups, ImpactOptions>> without_adhesion(
    const ImpactGroups& groups, const ImpactOptions& options) {
  if (!with_law(options.adhesion, [&]<class Law>() { return Law::vanishes(groups); })) {
    return std::nullopt;
  }
  std::pair<ImpactGroups, ImpactOptions> simpler(groups, options);
  simpler.first.beta = 0.0;
  simpler.second.adhesion = AdhesionLaw::ring;
  return simpler;
}

}  // namespace recoil
