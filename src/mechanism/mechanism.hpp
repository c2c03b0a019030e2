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

/// The subject of a mechanism: the impact, or its measurement. A description only fits the data and
/// is never named as a cause.
enum class MechanismKind { physics, measurement, description };

constexpr auto names_of_values(MechanismKind) {
  return name_list("physics", "measurement", "description");
}

/// The place on the way of a sphere where a mechanism acts, from the outside in. On the way in,
/// mechanisms act in this order, on the way out in the reverse order, and those at one place in the
/// order of their ids. The last three act, in this order, on the average of a point.
enum class MechanismPlace {
  size,        ///< the size of the sphere
  spread,      ///< differences between the spheres of one point
  instrument,  ///< errors of the velocimeter
  height,      ///< between the measuring plane and the surface
  gas,
  field,
  contact,
  selection,  ///< which rebounds are detected
  pairing,    ///< which rebound belongs to which impact
  batch,      ///< an error that all points of a series share
};

/// A value of a condition at which a mechanism has no effect.
struct TakenAway {
  Condition condition = Condition::ambient_pressure;
  double value = 0.0;      ///< in the unit of the condition
  std::string_view doing;  ///< how to set it in a laboratory: "pump the chamber"
  /// The least sufficient value for one impact, if it depends on the impact; `value` is then an
  /// example. Null: `value` is always sufficient.
  double (*least)(const Encounter<double>& sphere) = nullptr;
};

/// The description of a mechanism: one member for each statement that its file may make. Most have
/// a default.
struct MechanismInfo {
  std::string_view id;
  std::string_view title;
  /// Its name in `[model] loss` of a fit file, if it is a loss of the dry contact. Such a loss does
  /// not capture by itself. Empty: it is none.
  std::string_view dry_loss = {};
  std::string_view cause = {};  ///< a cause that several mechanisms describe; empty: only this one
  MechanismKind kind = MechanismKind::physics;
  MechanismPlace place = MechanismPlace::contact;
  bool needs_flat = false;  ///< its law does not hold between two spheres
  std::string_view formula;
  std::string_view source;
  std::string_view fingerprint;  ///< its pattern in the residuals of a fit without it
  std::vector<Parameter> parameters = {};
  /// True if it states that the spheres of one point differ in size.
  bool mixes_sizes = false;
  /// True if its strength is a multiple of the dataset's work of adhesion, so that it has no effect
  /// if that is 0.
  bool needs_adhesion = false;
  bool needs_flow = false;    ///< it has no effect if a body is an elastomer, which does not yield
  bool needs_liquid = false;  ///< a search for causes needs a stated liquid film
  /// The methods of measurement in which it can occur; empty: all.
  std::vector<Method> methods = {};
  std::optional<TakenAway> taken_away = {};  ///< the condition that removes it, if there is one
  /// The reason why it cannot be combined with a law of adhesion; empty if it can. Null: it can be
  /// combined with all laws.
  std::string_view (*refused)(AdhesionLaw law) = nullptr;
  /// A mechanism that describes the same loss. The two cannot be combined, because each would leave
  /// the speed that the other takes unchanged.
  std::string_view not_with = {};
};

/// The law of a mechanism for one number type. A null function has no effect. `own` are its
/// parameters in the order of `MechanismInfo::parameters`.
template <class T>
struct MechanismLaw {
  void (*before)(Encounter<T>&, std::span<const T> own) = nullptr;  ///< on the way in
  void (*after)(Encounter<T>&, std::span<const T> own) = nullptr;   ///< on the way out
  void (*observe)(Observed<T>&, std::span<const T> own) = nullptr;
  /// Changes the sphere to one that differs from the typical one by z standard deviations.
  void (*vary)(Encounter<T>&, std::span<const T> own, double z) = nullptr;
};

/// Directions of the derivatives: V, D, C_H, C_A, f0, and then the mechanisms' parameters.
inline constexpr std::size_t base_directions = 5;
/// Further directions, last of all, if the materials are uncertain: density, K, W_A and mobility.
inline constexpr std::size_t material_directions = 4;
// The numbers of mechanisms' parameters, without and with uncertain materials:
using FewDirections = Dual<8>;       ///< 3; 0
using SomeDirections = Dual<12>;     ///< 7; 3: one mechanism
using SeveralDirections = Dual<16>;  ///< 11; 7: two or three mechanisms
using ManyDirections = Dual<48>;     ///< more than the whole catalogue has

struct Mechanism {
  MechanismInfo info;
  std::tuple<MechanismLaw<double>, MechanismLaw<FewDirections>, MechanismLaw<SomeDirections>,
             MechanismLaw<SeveralDirections>, MechanismLaw<ManyDirections>>
      laws;
  bool dashpot = false;      ///< it sets Encounter::relaxation, which needs a law with a dashpot
  bool never_pulls = false;  ///< that dashpot and the elastic force together never pull

  template <class T>
  const MechanismLaw<T>& law() const {
    return std::get<MechanismLaw<T>>(laws);
  }
  bool acts_at(const Surroundings& at) const {
    if (info.needs_adhesion && !(at.adhesion_energy > 0.0)) return false;
    if (info.needs_flat && at.surface_diameter > 0.0) return false;
    if (info.needs_flow && at.elastomer) return false;
    return at.method == Method::unknown || info.methods.empty() ||
           std::ranges::find(info.methods, at.method) != info.methods.end();
  }
  /// True if a search for causes may try it: it acts, and the liquid that it needs is stated.
  bool is_possible_at(const Surroundings& at) const {
    const auto wet = [](const Conditions& c) { return c.of(Condition::film_thickness) > 0.0; };
    return acts_at(at) &&
           (!info.needs_liquid || wet(at.conditions) || std::ranges::any_of(at.of_series, wet));
  }
  bool spreads() const { return law<double>().vary != nullptr; }
  /// The reason why it cannot be combined with this law of adhesion; empty if it can.
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

/// Makes a mechanism from a `Law`, which has any of the functions of MechanismLaw as static
/// templates over the number type. Each mechanism has one file, named like its id, and a line in
/// CMakeLists.txt. The file defines a function of that name that returns make_mechanism<Law>(...).
/// No other code depends on the mechanism: its properties are fields of MechanismInfo.
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
  if constexpr (requires { Law::never_pulls; }) m.never_pulls = Law::never_pulls;
  return m;
}

/// An attractive force before the contact: the sphere gains the energy U on the way in and loses it
/// on the way out. `Well::gained(e, own)` is 2 U / m [m2/s2].
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

/// The mechanism `id`; null if there is none.
const Mechanism* find_mechanism(std::string_view id);

/// A mechanism of `ids` with which `id` cannot be combined; null if there is none.
const Mechanism* rival_among(const std::vector<std::string>& ids, std::string_view id);

/// The mechanisms `ids`, in the order in which they act. @pre all of them exist
std::vector<const Mechanism*> chain_of(const std::vector<std::string>& ids);

/// The physically possible values of one parameter in given impacts.
struct AllowedValues {
  double lower = 0.0;  ///< in the parameter's unit
  double upper = 0.0;
  bool lower_by_limit = false;  ///< from `Parameter::limit`, not from `Parameter::plausible`
  bool upper_by_limit = false;
  double quantity = 0.0;  ///< the limited quantity at the value in `own` [1]; 0: no limit
};

/// The range `parameter.plausible`, narrowed so that the largest quantity of the parameter's limit
/// among `spheres` is within the limit. If there is no such value, lower equals upper.
/// @param k the index of `parameter` in `own`, the parameters of its mechanism
AllowedValues allowed_values(const Parameter& parameter, std::size_t k, std::span<const double> own,
                             std::span<const Encounter<double>> spheres);

}  // namespace recoil
