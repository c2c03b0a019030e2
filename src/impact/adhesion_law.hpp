#pragma once

#include <string_view>

#include "core/names.hpp"

namespace recoil {

/// Every law of adhesion: its name in files and its struct. A new law is a header like jkr_law.hpp,
/// which laws.hpp includes, and a line here. It does not compile without one of the traits below.
#define RECOIL_ADHESION_LAWS(LAW) \
  LAW(ring, RingAdhesionLaw)      \
  LAW(jkr, JkrLaw)                \
  LAW(dmt, DmtLaw)                \
  LAW(maugis, MaugisLaw)

/// The law of adhesion.
enum class AdhesionLaw {
#define RECOIL_ENUMERATOR(name, Law) name,
  RECOIL_ADHESION_LAWS(RECOIL_ENUMERATOR)
#undef RECOIL_ENUMERATOR
};

constexpr auto names_of_values(AdhesionLaw) {
#define RECOIL_NAME(name, Law) std::string_view(#name),
  return std::array{RECOIL_ADHESION_LAWS(RECOIL_NAME)};
#undef RECOIL_NAME
}

/// The properties of a law that other code uses. The struct of the law has static members of these
/// names.
struct AdhesionLawTraits {
  std::string_view equation;       ///< "Maugis (1992), damped": model.equation of fit.json
  std::string_view description;    ///< one sentence for `say`, with {C_H} and so on for symbols
  std::string_view elastic_part;   ///< of the force, for the manual
  std::string_view adhesive_part;  ///< of the force, for the manual
  std::string_view undamped_loss;  ///< "loses nothing", for the manual
  bool by_force;                   ///< the parameter is f0 [N/m]; otherwise it is W [J/m2]
  bool jumps;                      ///< an undamped impact loses energy and can be captured
  bool has_range;             ///< depends on ImpactGroups::range, and holds at any Tabor parameter
  bool attracts_at_distance;  ///< includes the attraction before contact
  bool has_dashpot;           ///< can be combined with WithDashpot
  bool exportable;            ///< other programs can compute its force (ContactForce)
  bool quick_to_fit;          ///< in seconds; comparisons of all laws omit the others
  /// V*^2 [m2/s2] to first order in the dampings [s/m], `scale` being V_a [m/s].
  double (*capture_square)(double C_H, double C_A, bool both_phases, double scale);
};
const AdhesionLawTraits& traits(AdhesionLaw law);

}  // namespace recoil
