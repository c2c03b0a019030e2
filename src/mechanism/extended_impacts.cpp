#include "mechanism/extended_impacts.hpp"

#include <algorithm>
#include <cassert>

namespace recoil {
namespace {

/// From this kappa on the dashpot stops the sphere. One that pulls leaves e^2 < 5e-10 (falling as
/// kappa^-10), while the number of steps would grow with kappa^2 until the solver fails; one that
/// does not pull leaves e^2 < 1e-8 (falling as kappa^(-10/3)). Without adhesion it is solved
/// further.
template <class T>
double stopping(bool pulls, const T& beta) {
  return pulls ? 12.0 : value_of(beta) > 0.0 ? 300.0 : 1e6;
}

/// For spheres that differ in another quantity than size.
const MixedSizes no_sizes;

/// The groups of the base impact with their derivatives.
template <class T>
struct Groups {
  T alpha, beta, gamma, kappa, range;

  ImpactGroups values(bool pulls) const {
    return {value_of(alpha), value_of(beta), value_of(gamma),
            std::min(value_of(kappa), stopping(pulls, beta)), value_of(range)};
  }
};

template <class T>
Encounter<T> approaching(const ExtendedPoint& point, std::span<const T> values, const T& velocity,
                         const T& diameter) {
  Encounter<T> e = plain_sphere(*point.at, diameter, velocity, point.series);
  e.hertz_damping = values[0];
  e.adhesion_damping = values[1];
  e.adhesion_force = values[2] * power(e.radius() / relative_radius(point.at->reference_diameter,
                                                                    point.at->surface_diameter),
                                       1.0 / 3.0);
  return e;
}

template <class T>
Groups<T> groups_at_contact(const Encounter<T>& e) {
  return {e.hertz_damping * e.velocity, e.beta(), e.adhesion_damping * e.velocity,
          1.5 * e.relaxation * e.velocity / e.scale(), e.range()};
}

template <class T>
T base_square(const Groups<T>& groups, bool pulls, const ImpactResult& impact) {
  T square = impact.restitution_squared;
  add_slopes(square, impact.gradient[0], groups.alpha);
  add_slopes(square, impact.gradient[1], groups.beta);
  add_slopes(square, impact.gradient[2], groups.gamma);
  if (value_of(groups.kappa) <= stopping(pulls, groups.beta))
    add_slopes(square, impact.gradient[3], groups.kappa);
  add_slopes(square, impact.gradient[4], groups.range);
  return square;
}

/// Calls act(law, its parameters) for every mechanism of the chain, from the outside in.
template <class T, class Act>
void for_each_in_chain(std::span<const Mechanism* const> chain, std::span<const T> own, Act act) {
  std::size_t first = 0;
  for (const Mechanism* mechanism : chain) {
    const std::size_t count = mechanism->info.parameters.size();
    act(mechanism->template law<T>(), own.subspan(first, count));
    first += count;
  }
}

template <class T, class Act>
void back_along(std::span<const Mechanism* const> chain, std::span<const T> own, Act act) {
  std::size_t last = own.size();
  for (std::size_t k = chain.size(); k-- > 0;) {
    const std::size_t count = chain[k]->info.parameters.size();
    last -= count;
    act(chain[k]->template law<T>(), own.subspan(last, count));
  }
}

/// Changes the sphere of this node on its way in. Of several spreads the last is the innermost.
template <class T>
void approach(std::span<const Mechanism* const> chain, std::span<const T> own, std::size_t node,
              std::size_t nodes, Encounter<T>& e) {
  std::size_t rest = node;
  std::size_t stride = nodes;
  for_each_in_chain<T>(chain, own, [&](const MechanismLaw<T>& law, std::span<const T> its) {
    if (law.vary != nullptr) {
      stride /= spread_nodes;
      law.vary(e, its, spread_positions()[rest / stride]);
      rest %= stride;
    }
    if (law.before != nullptr) law.before(e, its);
  });
}

}  // namespace

template <class T>
struct ExtendedImpacts::Workspace {
  std::vector<T> values;                 // of one point
  std::vector<Encounter<T>> encounters;  // [points x nodes]
  std::vector<Groups<T>> groups;         // [points x nodes]
  std::vector<T> squares;                // of the nodes of one point
};

ExtendedImpacts::ExtendedImpacts(std::vector<const Mechanism*> chain,
                                 std::vector<ExtendedPoint> points, bool materials)
    : chain_(std::move(chain)), points_(std::move(points)), materials_(materials) {
  for (const Mechanism* mechanism : chain_) {
    own_count_ += mechanism->info.parameters.size();
    if (mechanism->spreads()) {
      nodes_ *= spread_nodes;
      spreads_.push_back(mechanism);
    }
    dashpot_ = dashpot_ || mechanism->dashpot;
    never_pulls_ = never_pulls_ || mechanism->never_pulls;
  }
  groups_.resize(points_.size() * nodes_);
  results_.resize(points_.size() * nodes_);
  answers_.resize(points_.size());
}

ExtendedImpacts::~ExtendedImpacts() = default;
ExtendedImpacts::ExtendedImpacts(ExtendedImpacts&&) noexcept = default;
ExtendedImpacts& ExtendedImpacts::operator=(ExtendedImpacts&&) noexcept = default;

long ExtendedImpacts::evaluate(std::span<const double> values, ImpactOptions options,
                               SimulateImpacts simulate) {
  assert(values.size() == points_.size() * value_count());
  options.dashpot = dashpot_;
  options.never_pulls = never_pulls_;
  const auto with = [&](auto& work) {
    using Work = typename std::decay_t<decltype(work)>::element_type;
    if (!work) work = std::make_unique<Work>();
    return evaluate_with(*work, values, options, simulate);
  };
  if (!options.gradient) return with(plain_);
  slopes_.resize(points_.size() * directions());
  if (directions() <= FewDirections().slope.size()) return with(few_);
  if (directions() <= SomeDirections().slope.size()) return with(some_);
  if (directions() <= SeveralDirections().slope.size()) return with(several_);
  assert(directions() <= ManyDirections().slope.size());
  return with(many_);
}

template <class T>
long ExtendedImpacts::evaluate_with(Workspace<T>& work, std::span<const double> values,
                                    const ImpactOptions& options, SimulateImpacts simulate) {
  const std::size_t count = value_count();
  work.values.resize(count);
  work.squares.resize(nodes_);
  work.encounters.resize(points_.size() * nodes_);
  work.groups.resize(points_.size() * nodes_);
  const auto variable = [](double at, [[maybe_unused]] std::size_t direction) {
    if constexpr (std::is_same_v<T, double>) {
      return at;
    } else {
      return T(at, direction);
    }
  };
  const auto take_values = [&](std::size_t i) {
    for (std::size_t j = 0; j < count; ++j) work.values[j] = variable(values[i * count + j], j + 2);
    return std::span<const T>(work.values).subspan(base_directions - 2);
  };

  for (std::size_t i = 0; i < points_.size(); ++i) {
    const std::span<const T> own = take_values(i);
    Encounter<T> start = approaching<T>(points_[i], work.values, variable(points_[i].velocity, 0),
                                        variable(points_[i].diameter, 1));
    if (materials_) {
      std::size_t direction = base_directions + own_count_;
      for (T* constant :
           {&start.density, &start.stiffness, &start.adhesion_energy, &start.wave_mobility}) {
        *constant = variable(value_of(*constant), direction++);
      }
    }
    for (std::size_t node = 0; node < nodes_; ++node) {
      const std::size_t at = i * nodes_ + node;
      Encounter<T>& e = work.encounters[at];
      e = start;
      approach<T>(chain_, own, node, nodes_, e);
      work.groups[at] = groups_at_contact(e);
      groups_[at] = work.groups[at].values(!never_pulls_);
    }
  }
  const long handed_over = simulate(groups_, options, results_);

  for (std::size_t i = 0; i < points_.size(); ++i) {
    const std::span<const T> own = take_values(i);
    ExtendedAnswer& answer = answers_[i];
    answer = {ImpactOutcome::rebound, 0.0};
    for (std::size_t node = 0; node < nodes_; ++node) {
      const ImpactResult& impact = results_[i * nodes_ + node];
      if (!impact.usable()) answer.outcome = impact.outcome;
      Encounter<T>& e = work.encounters[i * nodes_ + node];
      e.square += base_square(work.groups[i * nodes_ + node], !never_pulls_, impact) *
                  (e.velocity * e.velocity);
      back_along<T>(chain_, own, [&](const MechanismLaw<T>& law, std::span<const T> its) {
        if (law.after != nullptr) law.after(e, its);
      });
      work.squares[node] = e.square / (e.measured_velocity * e.measured_velocity);
    }
    if (answer.outcome != ImpactOutcome::rebound) continue;
    const double slowest = points_[i].at->sizes.slowest_seen;
    const T& velocity = work.encounters[i * nodes_].measured_velocity;
    const T seen = T(slowest * slowest) / (velocity * velocity);
    // The last spread of the chain is innermost.
    std::size_t spread = spreads_.size();
    for (std::size_t left = nodes_; left > 1; left /= spread_nodes) {
      const MixedSizes& sizes =
          spreads_[--spread]->info.mixes_sizes ? points_[i].at->sizes : no_sizes;
      for (std::size_t k = 0; k < left / spread_nodes; ++k) {
        const std::span<const T> siblings(&work.squares[k * spread_nodes], spread_nodes);
        work.squares[k] = survivors_square<T>(siblings, seen, sizes);
      }
    }
    Observed<T> observed{work.squares.front(), work.encounters[i * nodes_].measured_velocity};
    for_each_in_chain<T>(chain_, own, [&](const MechanismLaw<T>& law, std::span<const T> its) {
      if (law.observe != nullptr) law.observe(observed, its);
    });
    answer.restitution_squared = value_of(observed.square);
    if constexpr (!std::is_same_v<T, double>) {
      std::copy_n(observed.square.slope.begin(), directions(), &slopes_[i * directions()]);
    }
    if (!std::isfinite(answer.restitution_squared)) {
      answer.outcome = ImpactOutcome::integration_failure;
    } else if (!(answer.restitution_squared > 0.0)) {
      answer.outcome = ImpactOutcome::captured;
    }
  }
  return handed_over;
}

std::span<const double> ExtendedImpacts::slopes(std::size_t i) const {
  const std::size_t count = directions();
  return std::span<const double>(slopes_).subspan(i * count, count);
}

ContactView view_contact(std::span<const Mechanism* const> chain, const ExtendedPoint& point,
                         std::span<const double> values) {
  ContactView view;
  for (const Mechanism* mechanism : chain) {
    view.dashpot = view.dashpot || mechanism->dashpot;
    view.never_pulls = view.never_pulls || mechanism->never_pulls;
  }
  view.encounter = approaching<double>(point, values, point.velocity, point.diameter);
  Encounter<double>& e = view.encounter;
  for_each_in_chain<double>(chain, values.subspan(base_directions - 2),
                            [&](const MechanismLaw<double>& law, std::span<const double> its) {
                              if (law.before != nullptr) law.before(e, its);
                            });
  view.groups = groups_at_contact(e).values(!view.never_pulls);
  const double energy = e.mass() * e.velocity * e.velocity;
  view.scales = {e.scale(), e.velocity, e.scale() / e.velocity, energy / e.scale(), energy};
  return view;
}

WholeImpactEnergy whole_impact_energy(std::span<const Mechanism* const> chain,
                                      const ExtendedPoint& point, std::span<const double> values,
                                      const ImpactResult& impact) {
  const std::span<const double> own = values.subspan(base_directions - 2);
  Encounter<double> e = approaching<double>(point, values, point.velocity, point.diameter);
  WholeImpactEnergy energy;
  for_each_in_chain<double>(chain, own,
                            [&](const MechanismLaw<double>& law, std::span<const double> its) {
                              const double before = e.velocity * e.velocity + e.square;
                              if (law.before != nullptr) law.before(e, its);
                              energy.in.push_back(before - e.velocity * e.velocity - e.square);
                            });
  const double returned = impact.restitution_squared * e.velocity * e.velocity;
  energy.contact = e.velocity * e.velocity - returned;
  e.square += returned;
  back_along<double>(chain, own, [&](const MechanismLaw<double>& law, std::span<const double> its) {
    const double before = e.square;
    if (law.after != nullptr) law.after(e, its);
    energy.out.insert(energy.out.begin(), before - e.square);
  });
  const double half_mass = 0.5 * e.mass();
  energy.incident = half_mass * point.velocity * point.velocity;
  energy.contact *= half_mass;
  energy.rebound = half_mass * e.square;
  for (double& taken : energy.in) taken *= half_mass;
  for (double& taken : energy.out) taken *= half_mass;
  return energy;
}

}  // namespace recoil
