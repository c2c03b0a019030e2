#pragma once

#include <optional>
#include <utility>

#include "impact/adhesion_law.hpp"
#include "impact/dmt_law.hpp"
#include "impact/force_law.hpp"
#include "impact/impact.hpp"
#include "impact/jkr_law.hpp"
#include "impact/maugis_law.hpp"

namespace recoil {

/// Calls act.template operator()<Law>() with the struct of `law`.
template <class Act>
[[gnu::always_inline]] inline auto with_law(AdhesionLaw law, const Act& act) {
  switch (law) {
#define RECOIL_CASE(name, Law) \
  case AdhesionLaw::name:      \
    return act.template operator()<Law>();
    RECOIL_ADHESION_LAWS(RECOIL_CASE)
#undef RECOIL_CASE
  }
  __builtin_unreachable();
}

/// The traits that the struct of a law states.
template <class Law>
constexpr AdhesionLawTraits traits_of() {
  return {.equation = Law::equation,
          .description = Law::description,
          .elastic_part = Law::elastic_part,
          .adhesive_part = Law::adhesive_part,
          .undamped_loss = Law::undamped_loss,
          .by_force = Law::by_force,
          .jumps = Law::jumps,
          .has_range = Law::has_range,
          .attracts_at_distance = Law::attracts_at_distance,
          .has_dashpot = Law::has_dashpot,
          .exportable = Law::exportable,
          .quick_to_fit = Law::quick_to_fit,
          .capture_square = Law::capture_square};
}

/// True if these groups can be simulated under `options`. For an optimiser, an inadmissible trial
/// point is a failed impact.
bool is_admissible(const ImpactGroups& groups, const ImpactOptions& options);

/// The impact without adhesion (a Hertz contact), if the adhesion is negligible and too weak for
/// the integration of its law; otherwise nullopt.
std::optional<std::pair<ImpactGroups, ImpactOptions>> without_adhesion(
    const ImpactGroups& groups, const ImpactOptions& options);

}  // namespace recoil
