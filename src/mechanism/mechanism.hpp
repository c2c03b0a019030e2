#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/names.hpp"
#include "data/system.hpp"
#include "mechanism/encounter.hpp"
#include "mechanism/parameter.hpp"

namespace recoil {

/// What a mechanism is a statement about. A description fits and explains nothing: it is never
/// named as a cause.
enum class MechanismKind { physics, measurement, description };

template <>
struct NamesOf<MechanismKind> {
  static constexpr std::array<std::string_view, 3> names = {"physics", "measurement",
                                                            "description"};
};

/// Where on the way of a sphere a mechanism acts, from the outside in. On the way in mechanisms act
/// in this order, on the way out in the reverse one; those at the same place in the order of their
/// ids. The last three act on what a point shows, in this order.
enum class MechanismPlace {
  size,        ///< which sphere it is
  spread,      ///< how the spheres of one point differ
  instrument,  ///< what the velocimeter reads
  height,      ///< between the measuring plane and the surface
  gas,
  field,
  contact,
  selection,  ///< which rebounds are seen
  pairing,    ///< which rebound belongs to which impact
  batch,      ///< what all points of a series share
};

/// A change of a condition under which a mechanism does nothing.
struct TakenAway {
  Condition condition = Condition::ambient_pressure;
  double value = 0.0;      ///< in the unit of the condition
  std::string_view doing;  ///< in a laboratory: "pump the chamber"
  /// The least value that does it for one impact, where that depends on the impact; `value` is then
  /// an example. Null: `value` always does.
  double (*least)(const Encounter<double>& sphere) = nullptr;
};

/// An entry states what differs from the defaults.
struct MechanismInfo {
  std::string_view id;
  std::string_view title;
  /// By which `[model] loss` of a fit file knows it: the loss of a dry contact, which captures
  /// nothing by itself. Empty: it is no such law.
  std::string_view dry_loss = {};
  std::string_view cause = {};  ///< shared with other laws of the same; empty where it stands alone
  MechanismKind kind = MechanismKind::physics;
  MechanismPlace place = MechanismPlace::contact;
  bool needs_flat = false;  ///< its law does not hold between two spheres
  std::string_view formula;
  std::string_view source;
  std::string_view
      fingerprint;  ///< what it leaves in the data when the base model is fitted without it
  std::vector<Parameter> parameters = {};
  /// Does it say that the spheres of one point differ in size?
  bool mixes_sizes = false;
  /// Is its strength a multiple of the dataset's own work of adhesion? Where that is 0 it does
  /// nothing.
  bool needs_adhesion = false;
  bool needs_flow = false;  ///< a body has to flow: nothing happens to an elastomer
  /// The ways of measuring that can have it; empty: all.
  std::vector<Method> methods = {};
  std::optional<TakenAway> taken_away = {};  ///< by what, where a condition does it
  /// Why it makes no sense beside a law of adhesion; empty when it does. Null: beside none it is
  /// refused.
  std::string_view (*refused)(AdhesionLaw law) = nullptr;
};

/// The law of a mechanism for one number type; null where it does nothing. `own` holds its
/// parameters in the order of `MechanismInfo::parameters`.
template <class T>
struct MechanismLaw {
  void (*before)(Encounter<T>&, std::span<const T> own) = nullptr;  ///< on the way in
  void (*after)(Encounter<T>&, std::span<const T> own) = nullptr;   ///< on the way out
  void (*observe)(Observed<T>&, std::span<const T> own) = nullptr;
  /// The sphere that lies z standard deviations from the typical one of its point.
  void (*vary)(Encounter<T>&, std::span<const T> own, double z) = nullptr;
};

/// Directions that a dual number carries: V, D, C_H, C_A, f0, then the mechanisms' parameters.
inline constexpr std::size_t base_directions = 5;
/// And where the materials are uncertain, last of all: density, K, W_A and mobility.
inline constexpr std::size_t material_directions = 4;
// How many parameters of mechanisms fit in, without and beside uncertain materials:
using FewDirections = Dual<8>;       ///< three; none
using SomeDirections = Dual<12>;     ///< seven; three: one mechanism
using SeveralDirections = Dual<16>;  ///< eleven; seven: two or three mechanisms
using ManyDirections = Dual<48>;     ///< more than the whole catalogue has

struct Mechanism {
  MechanismInfo info;
  std::tuple<MechanismLaw<double>, MechanismLaw<FewDirections>, MechanismLaw<SomeDirections>,
             MechanismLaw<SeveralDirections>, MechanismLaw<ManyDirections>>
      laws;
  bool dashpot = false;  ///< sets Encounter::relaxation: refused where the law has no dashpot

  template <class T>
  const MechanismLaw<T>& law() const {
    return std::get<MechanismLaw<T>>(laws);
  }
  bool acts_at(const Surroundings& at) const {
    if (info.needs_adhesion && !(at.adhesion_energy > 0.0)) return false;
    if (info.needs_flat && at.surface_diameter > 0.0) return false;
    if (info.needs_flow && at.elastomer) return false;
    return at.method == Method::unknown || can_be_of(at.method);
  }
  /// Can velocities that were measured so have it?
  bool can_be_of(Method method) const {
    return info.methods.empty() ||
           std::find(info.methods.begin(), info.methods.end(), method) != info.methods.end();
  }
  bool spreads() const { return law<double>().vary != nullptr; }
  /// Why it cannot stand beside this law of adhesion; empty when it can.
  std::string_view refusal(AdhesionLaw adhesion) const {
    if (dashpot && !traits(adhesion).has_dashpot) {
      return "its force does not vanish where that contact separates, and no solution for this is "
             "implemented";
    }
    return info.refused == nullptr ? std::string_view() : info.refused(adhesion);
  }
  bool works_with(AdhesionLaw adhesion) const { return refusal(adhesion).empty(); }
  bool is_batch() const { return info.place == MechanismPlace::batch; }
};

namespace mechanism_detail {

template <class Law, class T>
MechanismLaw<T> law_for() {
  using Own = std::span<const T>;
  MechanismLaw<T> law;
  if constexpr (requires(Encounter<T> & e, Own own) { Law::before(e, own); }) {
    law.before = [](Encounter<T>& e, Own own) { Law::before(e, own); };
  }
  if constexpr (requires(Encounter<T> & e, Own own) { Law::after(e, own); }) {
    law.after = [](Encounter<T>& e, Own own) { Law::after(e, own); };
  }
  if constexpr (requires(Observed<T> & s, Own own) { Law::observe(s, own); }) {
    law.observe = [](Observed<T>& s, Own own) { Law::observe(s, own); };
  }
  if constexpr (requires(Encounter<T> & e, Own own) { Law::vary(e, own, 0.0); }) {
    law.vary = [](Encounter<T>& e, Own own, double z) { Law::vary(e, own, z); };
  }
  return law;
}

}  // namespace mechanism_detail

/// `Law` has any of the functions of MechanismLaw as static templates over the number type. Each
/// mechanism is one file, named like its id, which defines a function of that name that returns
/// make_mechanism<Law>(...), and its line in CMakeLists.txt. Nothing else knows it: whatever is
/// special about a mechanism is a field of its entry.
template <class Law>
Mechanism make_mechanism(MechanismInfo info) {
  Mechanism m;
  m.info = std::move(info);
  m.laws = {mechanism_detail::law_for<Law, double>(),
            mechanism_detail::law_for<Law, FewDirections>(),
            mechanism_detail::law_for<Law, SomeDirections>(),
            mechanism_detail::law_for<Law, SeveralDirections>(),
            mechanism_detail::law_for<Law, ManyDirections>()};
  if constexpr (requires { Law::dashpot; }) m.dashpot = Law::dashpot;
  return m;
}

/// A force that draws the sphere on before it touches: what it gains on the way in it pays back on
/// the way out. `Well::gained(e, own)` is 2 U / m, U the energy of the well [m2/s2].
template <class Well>
struct Attraction {
  template <class T>
  static void before(Encounter<T>& e, std::span<const T> own) {
    e.velocity = sqrt(e.velocity * e.velocity + Well::template gained<T>(e, own));
  }
  template <class T>
  static void after(Encounter<T>& e, std::span<const T> own) {
    e.square -= Well::template gained<T>(e, own);
  }
};

/// Every mechanism, in the order in which they act.
const std::vector<Mechanism>& mechanism_catalogue();

/// The mechanism `id`; null when there is none.
const Mechanism* find_mechanism(std::string_view id);

/// The mechanisms `ids`, in the order in which they act. @pre all of them exist
std::vector<const Mechanism*> chain_of(const std::vector<std::string>& ids);

/// The values of one parameter that matter, or a careful experiment, can have in given impacts.
struct AllowedValues {
  double lower = 0.0;  ///< in the parameter's unit
  double upper = 0.0;
  bool lower_by_limit = false;  ///< set by `Parameter::limit`, not by `Parameter::plausible`
  bool upper_by_limit = false;
  double quantity = 0.0;  ///< that is limited, at the value in `own` [1]; 0 where nothing is
};

/// `parameter.plausible`, narrowed to where the largest value that its limit's quantity takes among
/// `spheres` lies within the limit. Where no value does, lower equals upper.
/// @param k the place of `parameter` among `own`, the parameters of its mechanism
AllowedValues allowed_values(const Parameter& parameter, std::size_t k, std::span<const double> own,
                             std::span<const Encounter<double>> spheres);

/// A sphere that arrives as the dataset has it, with the adhesion and damping left out.
Encounter<double> plain_sphere(const Surroundings& at, double diameter, double velocity,
                               std::size_t series);

}  // namespace recoil
