#include "estimate/predictor.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <numeric>
#include <tuple>

#include "core/interrupt.hpp"
#include "core/parallel.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

constexpr std::size_t no_slot = static_cast<std::size_t>(-1);
constexpr std::size_t place_of_force = 2;  // index of f0 in the values of a point
constexpr std::size_t points_of_block = 512;

/// A mechanism that acts, and the index of its first parameter in the model's chain.
struct Acting {
  const Mechanism* mechanism;
  std::size_t first;
};

/// Adds the mechanism that averages over sizes, without free parameters, for datasets that state a
/// size distribution, unless the chain already has it.
void add_stated_sizes(const ImpactModel& model, std::vector<Acting>& acting) {
  if (!averages_over_sizes(model)) return;
  const std::vector<Mechanism>& catalogue = mechanism_catalogue();
  const auto sizes =
      std::find_if(catalogue.begin(), catalogue.end(),
                   [](const Mechanism& mechanism) { return mechanism.info.mixes_sizes; });
  const auto is_sizes = [&](const Acting& one) { return one.mechanism == &*sizes; };
  if (std::any_of(acting.begin(), acting.end(), is_sizes)) return;
  const auto later = [&](const Acting& one) {
    return one.mechanism->info.place > sizes->info.place;
  };
  acting.insert(std::find_if(acting.begin(), acting.end(), later), {&*sizes, no_slot});
}

std::vector<std::size_t> first_alike(const std::vector<PointConditions>& points) {
  const auto key = [&](std::size_t i) {
    return std::tie(points[i].dataset, points[i].diameter, points[i].velocity);
  };
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return key(a) < key(b) || (key(a) == key(b) && a < b);
  });
  std::vector<std::size_t> alike(points.size());
  bool repeated = false;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && key(order[k - 1]) == key(order[k]);
    alike[order[k]] = same ? alike[order[k - 1]] : order[k];
    repeated = repeated || same;
  }
  return repeated ? alike : std::vector<std::size_t>{};
}

}  // namespace

double Prediction::restitution() const { return std::sqrt(std::max(restitution_squared, 0.0)); }

PointPredictor::PointPredictor(const ImpactModel& model, std::vector<PointConditions> points,
                               Effects effects)
    : PointPredictor(model, std::move(points), effects, true, model.law_error.get()) {}

PointPredictor::PointPredictor(const ImpactModel& model, std::vector<PointConditions> points,
                               Effects effects, bool grid, const LawError* law_error)
    : model_(model),
      effects_(effects),
      law_error_(law_error),
      points_(std::move(points)),
      C_H_(model.contacts.size()),
      C_A_(model.contacts.size()),
      force_(model.contacts.size()),
      force_slope_(model.contacts.size()),
      beta_scale_(model.contacts.size(), 1.0),
      range_scale_(model.contacts.size(), 1.0),
      material_slopes_(model.contacts.size()),
      surroundings_(model.surroundings) {
  if (law_error != nullptr) {
    const std::size_t count = law_error->count();
    law_functions_.resize(points_.size() * count);
    bends_.resize(points_.size(), LossFactor(0.0));
    over_blocks(points_.size(), points_of_block, [&](std::size_t first, std::size_t own) {
      for (std::size_t i = first; i < first + own; ++i) {
        law_error->functions(points_[i], std::span(law_functions_).subspan(i * count, count));
      }
    });
  }

  if (grid) grid_ = VelocityGrid::for_points(points_);
  if (grid_) {
    nodes_.reset(new PointPredictor(model, grid_->nodes(), effects, false, nullptr));
    place_of_direct_.assign(points_.size(), no_slot);
    return;
  }
  beta_per_f0_.resize(points_.size());
  range_per_f0_.resize(points_.size());
  over_blocks(points_.size(), points_of_block, [&](std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i) {
      const PointConditions& p = points_[i];
      // Groups of the stated materials; theta scales them.
      const ContactProperties& stated = model.contacts[p.dataset];
      const auto [equal, density] = stated.as_one_sphere(p.diameter, stated.particle_density);
      const ImpactGroups groups =
          impact_groups({.diameter = equal,
                         .velocity = p.velocity,
                         .density = density,
                         .stiffness = stated.stiffness,
                         .adhesion_force = stated.adhesion_force_at(1.0, p.diameter),
                         .separation = model.separation});
      beta_per_f0_[i] = groups.beta;
      range_per_f0_[i] = groups.range;
    }
  });

  // Above this number sorting costs more than the impacts.
  constexpr std::size_t few = 8 * points_of_block;
  if (points_.size() <= few) alike_ = first_alike(points_);

  std::vector<Acting> acting;
  std::size_t parameter = 0;
  for (const Mechanism* mechanism : model.chain) {
    const bool acts =
        effects == Effects::as_measured || mechanism->info.kind != MechanismKind::measurement;
    if (acts) acting.push_back({mechanism, parameter});
    parameter += mechanism->info.parameters.size();
  }
  if (effects == Effects::as_measured) add_stated_sizes(model, acting);
  if (acting.empty()) return;
  std::vector<const Mechanism*> chain;
  for (const Acting& one : acting) chain.push_back(one.mechanism);
  std::vector<ExtendedPoint> extended;
  for (const PointConditions& p : points_) {
    extended.push_back({&surroundings_[p.dataset], p.diameter, p.velocity, p.series});
    for (const auto* base : {&model.slot_C_H, &model.slot_C_A, &model.slot_adhesion}) {
      slots_.push_back((*base)[p.dataset]);
      nulls_.push_back(0.0);
    }
    for (const Acting& one : acting) {
      std::size_t k = one.first;
      for (const Parameter& own : one.mechanism->info.parameters) {
        const bool stated = one.first == no_slot;
        slots_.push_back(stated ? no_slot : own_slot(model, k++, own, p).value_or(no_slot));
        nulls_.push_back(stated ? model.surroundings[p.dataset].sizes.spread : own.null_value);
      }
    }
  }
  extended_.emplace(std::move(chain), std::move(extended), model.material_count() > 0);
  values_.resize(slots_.size());
}

void PointPredictor::take_parameters(std::span<const double> theta, bool gradient) {
  assert(theta.size() == model_.slots.size());
  end_if_called_off();
  if (law_error_ != nullptr) take_law_error(theta);
  if (grid_) return;
  for (std::size_t d = 0; d < force_.size(); ++d) {
    C_H_[d] = theta[model_.slot_C_H[d]];
    C_A_[d] = theta[model_.slot_C_A[d]];
    force_[d] = adhesion_force_under(model_, theta, d);
    force_slope_[d] = adhesion_force_slope(model_, theta, d);
  }
  if (model_.material_count() > 0) take_materials(theta, gradient);
}

void PointPredictor::take_law_error(std::span<const double> theta) {
  const std::span<const double> z = theta.subspan(model_.first_law_slot());
  over_blocks(points_.size(), points_of_block, [&](std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i) {
      bends_[i] =
          LossFactor(std::inner_product(z.begin(), z.end(), &law_functions_[i * z.size()], 0.0));
    }
  });
}

void PointPredictor::bend(std::size_t first, std::span<ImpactResult> answers) const {
  if (law_error_ == nullptr) return;
  for (std::size_t k = 0; k < answers.size(); ++k) {
    ImpactResult& answer = answers[k];
    if (!answer.usable()) continue;
    double& square = answer.restitution_squared;
    square = 1.0 - (1.0 - square) * loss_factor(first + k);
    answer.outcome = square > 0.0 ? ImpactOutcome::rebound : ImpactOutcome::captured;
  }
}

ImpactGroups PointPredictor::groups_at(std::size_t i) const {
  const PointConditions& p = points_[i];
  return {.alpha = C_H_[p.dataset] * p.velocity,
          .beta = force_[p.dataset] * beta_per_f0_[i] * beta_scale_[p.dataset],
          .gamma = C_A_[p.dataset] * p.velocity,
          .range = force_[p.dataset] * range_per_f0_[i] * range_scale_[p.dataset]};
}

/// Simulates answers.size() points from `first` on. @return the impacts handed to the reference
long PointPredictor::simulate_range(std::size_t first, const ImpactOptions& options,
                                    std::span<ImpactResult> answers) const {
  static thread_local std::array<ImpactGroups, points_of_block> groups;
  long handed_over = 0;
  for (std::size_t done = 0; done < answers.size();) {
    const std::size_t count = std::min(points_of_block, answers.size() - done);
    const std::size_t from = first + done;
    // A point takes the answer of an earlier equal point if that is in this block.
    const auto is_own = [&](std::size_t k) {
      return alike_.empty() || alike_[from + k] < from || alike_[from + k] == from + k;
    };
    std::size_t own = 0;
    for (std::size_t k = 0; k < count; ++k) {
      if (is_own(k)) groups[own++] = groups_at(from + k);
    }
    handed_over +=
        model_.simulator()(std::span(groups).first(own), options, answers.subspan(done, own));
    if (own < count) {
      for (std::size_t k = count; k-- > 0;) {
        if (is_own(k)) answers[done + k] = answers[done + --own];
      }
      for (std::size_t k = 0; k < count; ++k) {
        if (!is_own(k)) answers[done + k] = answers[done + alike_[from + k] - from];
      }
    }
    done += count;
  }
  return handed_over;
}

void PointPredictor::evaluate(std::span<const double> theta, bool gradient) {
  take_parameters(theta, gradient);
  last_theta_.assign(theta.begin(), theta.end());
  last_gradient_ = gradient;
  results_.resize(points_.size());
  if (grid_) return evaluate_grid(theta, gradient);
  const ImpactOptions options = model_.impact_options(gradient);
  if (extended_) {
    evaluate_extended(theta, options);
    bend(0, results_);
    return;
  }
  std::atomic<long> handed_over = 0;
  over_blocks(points_.size(), points_of_block, [&](std::size_t first, std::size_t count) {
    const std::span<ImpactResult> answers = std::span(results_).subspan(first, count);
    handed_over += simulate_range(first, options, answers);
    bend(first, answers);
  });
  handovers_ += handed_over;
}

template <class Of>
double PointPredictor::from_grid(std::size_t i, const Of& of) const {
  const std::size_t direct = place_of_direct_[i];
  if (direct != no_slot) return of(*direct_, direct);
  double sum = 0.0;
  grid_->for_each_neighbour(
      i, [&](std::size_t node, double weight) { sum += weight * of(*nodes_, node); });
  return sum;
}

void PointPredictor::choose_direct(std::span<const double> theta, bool gradient) {
  std::vector<double> squares(nodes_->size());
  for (std::size_t node = 0; node < squares.size(); ++node) {
    const ImpactResult& at = nodes_->at(node);
    squares[node] = at.usable() ? at.restitution_squared : NAN;
  }
  std::vector<std::size_t> direct = grid_->rough_points(squares);
  if (direct != direct_points_) {
    for (const std::size_t i : direct_points_) place_of_direct_[i] = no_slot;
    std::vector<PointConditions> points;
    for (const std::size_t i : direct) {
      place_of_direct_[i] = points.size();
      points.push_back(points_[i]);
    }
    direct_.reset(points.empty()
                      ? nullptr
                      : new PointPredictor(model_, std::move(points), effects_, false, nullptr));
    direct_points_ = std::move(direct);
  }
  if (!direct_) return;
  const long before = direct_->handovers();
  direct_->evaluate(theta, gradient);
  handovers_ += direct_->handovers() - before;
}

void PointPredictor::evaluate_grid(std::span<const double> theta, bool gradient) {
  const auto rows_of = [&](const PointPredictor& simulated, std::vector<double>& rows) {
    const std::size_t count = model_.slots.size();
    rows.resize(simulated.size() * count);
    for (std::size_t k = 0; k < simulated.size(); ++k) {
      simulated.gradient_row(k, 1.0, std::span(rows).subspan(k * count, count));
    }
  };
  const long before = nodes_->handovers();
  nodes_->evaluate(theta, gradient);
  handovers_ += nodes_->handovers() - before;
  choose_direct(theta, gradient);
  if (gradient) {
    rows_of(*nodes_, node_rows_);
    if (direct_) rows_of(*direct_, direct_rows_);
  }
  over_blocks(points_.size(), points_of_block, [&](std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i) {
      ImpactResult& answer = results_[i];
      if (place_of_direct_[i] != no_slot) {
        answer = direct_->at(place_of_direct_[i]);
        continue;
      }
      answer.restitution_squared = from_grid(i, [](const PointPredictor& simulated, std::size_t k) {
        return simulated.at(k).restitution_squared;
      });
      answer.outcome =
          answer.restitution_squared > 0.0 ? ImpactOutcome::rebound : ImpactOutcome::captured;
    }
    bend(first, std::span(results_).subspan(first, count));
  });
}

bool PointPredictor::keeps_answers() const {
  return grid_ || extended_ || points_.size() <= points_of_block;
}

void PointPredictor::evaluate_blocks(std::span<const double> theta, bool gradient,
                                     const TakeBlock& take) {
  if (keeps_answers()) {
    const auto is_at = [&](const std::vector<double>& known) {
      return std::equal(theta.begin(), theta.end(), known.begin(), known.end());
    };
    if (!is_at(last_theta_) || (gradient && !last_gradient_)) {
      if (is_at(first_theta_)) {
        take_parameters(theta, true);
        results_ = first_results_;
        last_theta_ = first_theta_;
        last_gradient_ = true;
      } else {
        evaluate(theta, gradient);
      }
    }
    if (gradient && first_theta_.empty() && !extended_ && !grid_) {
      first_theta_.assign(theta.begin(), theta.end());
      first_results_ = results_;
    }
    over_blocks(points_.size(), points_of_block, [&](std::size_t first, std::size_t count) {
      take(first, std::span(results_).subspan(first, count));
    });
    return;
  }
  take_parameters(theta, gradient);
  const ImpactOptions options = model_.impact_options(gradient);
  std::atomic<long> handed_over = 0;
  over_blocks(points_.size(), points_of_block, [&](std::size_t first, std::size_t count) {
    std::array<ImpactResult, points_of_block> room;
    const std::span<ImpactResult> answers = std::span(room).first(count);
    handed_over += simulate_range(first, options, answers);
    bend(first, answers);
    take(first, answers);
  });
  handovers_ += handed_over;
}

void PointPredictor::take_materials(std::span<const double> theta, bool gradient) {
  for (std::size_t d = 0; d < force_.size(); ++d) {
    const ContactProperties& stated = model_.contacts[d];
    const MaterialState now = materials_under(model_, theta, d);
    // beta ~ f0 K^(-3/5) rho^(-2/5).
    beta_scale_[d] = std::pow(now.stiffness / stated.stiffness, -0.6) *
                     std::pow(now.density / stated.particle_density, -0.4);
    range_scale_[d] = stated.stiffness / now.stiffness;  // lambda ~ f0 / K
    surroundings_[d] = surroundings_under(model_, theta, d);
    if (gradient) material_slopes_[d] = material_slopes(model_, theta, d);
  }
}

void PointPredictor::evaluate_extended(std::span<const double> theta,
                                       const ImpactOptions& options) {
  for (std::size_t k = 0; k < slots_.size(); ++k) {
    values_[k] = slots_[k] == no_slot ? nulls_[k] : theta[slots_[k]];
  }
  const std::size_t per_point = values_.size() / points_.size();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    values_[i * per_point + place_of_force] = force_[points_[i].dataset];
  }
  handovers_ += extended_->evaluate(values_, options, model_.simulator());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    results_[i].outcome = extended_->at(i).outcome;
    results_[i].restitution_squared = extended_->at(i).restitution_squared;
  }
}

void PointPredictor::gradient_row(std::size_t i, const ImpactResult& answer, double scale,
                                  std::span<double> row) const {
  base_gradient_row(i, answer, scale * loss_factor(i), row);
  if (law_error_ == nullptr) return;
  const double loss = (1.0 - answer.restitution_squared) / loss_factor(i);
  const std::size_t count = law_error_->count();
  for (std::size_t k = 0; k < count; ++k) {
    row[model_.first_law_slot() + k] =
        -scale * loss * bends_[i].slope * law_functions_[i * count + k];
  }
}

void PointPredictor::add_grid_row(std::size_t i, double scale, std::span<double> row) const {
  const std::size_t direct = place_of_direct_[i];
  const std::vector<double>& rows = direct != no_slot ? direct_rows_ : node_rows_;
  const std::size_t count = law_error_ != nullptr ? model_.first_law_slot() : row.size();
  const auto add = [&](std::size_t from, double weight) {
    const double* slopes = &rows[from * row.size()];
    for (std::size_t j = 0; j < count; ++j) row[j] += weight * slopes[j];
  };
  if (direct != no_slot) return add(direct, scale);
  grid_->for_each_neighbour(i, [&](std::size_t node, double weight) { add(node, scale * weight); });
}

void PointPredictor::base_gradient_row(std::size_t i, const ImpactResult& answer, double scale,
                                       std::span<double> row) const {
  const PointConditions& p = points_[i];
  const auto& by_group = answer.gradient;
  std::fill(row.begin(), row.end(), 0.0);
  if (grid_) return add_grid_row(i, scale, row);
  if (extended_) {
    const std::span<const double> slopes = extended_->slopes(i).subspan(2);
    const std::size_t count = extended_->value_count();
    for (const MaterialSlope& material : material_slopes_[p.dataset]) {
      const Surroundings& at = surroundings_[p.dataset];
      row[model_.first_constant() + material.index] +=
          scale * (slopes[place_of_force] * force_[p.dataset] * material.adhesion_force +
                   slopes[count] * at.density * material.density +
                   slopes[count + 1] * at.stiffness * material.stiffness +
                   slopes[count + 2] * at.adhesion_energy * material.adhesion_energy +
                   slopes[count + 3] * at.wave_mobility * material.wave_mobility);
    }
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t slot = slots_[i * count + k];
      const double own = k == place_of_force ? force_slope_[p.dataset] : 1.0;
      if (slot != no_slot) row[slot] += scale * own * slopes[k];
    }
    return;
  }
  row[model_.slot_C_H[p.dataset]] += scale * p.velocity * by_group[0];
  row[model_.slot_adhesion[p.dataset]] +=
      scale * force_slope_[p.dataset] *
      (beta_per_f0_[i] * beta_scale_[p.dataset] * by_group[1] +
       range_per_f0_[i] * range_scale_[p.dataset] * by_group[4]);
  row[model_.slot_C_A[p.dataset]] += scale * p.velocity * by_group[2];
  if (material_slopes_[p.dataset].empty()) return;
  const ImpactGroups g = groups_at(i);
  for (const MaterialSlope& material : material_slopes_[p.dataset]) {
    row[model_.first_constant() + material.index] +=
        scale * (g.beta * by_group[1] *
                     (material.adhesion_force - 0.6 * material.stiffness - 0.4 * material.density) +
                 g.range * by_group[4] * (material.adhesion_force - material.stiffness));
  }
}

double PointPredictor::bent_slope(std::size_t i, double slope,
                                  double PointConditions::*input) const {
  if (law_error_ == nullptr) return slope;
  constexpr double step = 1e-4;  // relative; g is smooth, so the error is about its square
  const auto g = [&](double factor) {
    PointConditions beside = points_[i];
    beside.*input *= factor;
    return (*law_error_)(beside,
                         std::span<const double>(last_theta_).subspan(model_.first_law_slot()));
  };
  const double bend = (g(1.0 + step) - g(1.0 - step)) / (2.0 * step * points_[i].*input);
  const double loss = (1.0 - results_[i].restitution_squared) / loss_factor(i);
  return loss_factor(i) * slope - loss * bends_[i].slope * bend;
}

double PointPredictor::velocity_slope(std::size_t i) const {
  if (grid_) {
    const double slope = from_grid(i, [](const PointPredictor& simulated, std::size_t k) {
      return simulated.velocity_slope(k);
    });
    return bent_slope(i, slope, &PointConditions::velocity);
  }
  if (extended_) return bent_slope(i, extended_->slopes(i)[0], &PointConditions::velocity);
  const ImpactGroups g = groups_at(i);
  const auto& by_group = results_[i].gradient;
  const double slope =
      (g.alpha * by_group[0] - 0.8 * g.beta * by_group[1] + g.gamma * by_group[2]) /
      points_[i].velocity;
  return bent_slope(i, slope, &PointConditions::velocity);
}

double PointPredictor::diameter_slope(std::size_t i) const {
  if (grid_) {
    const double slope = from_grid(i, [](const PointPredictor& simulated, std::size_t k) {
      return simulated.diameter_slope(k);
    });
    return bent_slope(i, slope, &PointConditions::diameter);
  }
  if (extended_) return bent_slope(i, extended_->slopes(i)[1], &PointConditions::diameter);
  // beta ~ f0 R^(1/5) m^(-2/5) with f0 ~ R^(1/3) (eq. 12); lambda ~ f0. On a flat R ~ D, m ~ D^3.
  const ImpactGroups g = groups_at(i);
  const auto& by_group = results_[i].gradient;
  const double diameter = points_[i].diameter;
  const ContactProperties& contact = model_.contacts[points_[i].dataset];
  const double of_radius = 2.0 * contact.relative_radius(diameter) / diameter;  // d ln R / d ln D
  const double of_mass = 3.0 * contact.reduced_mass(diameter, contact.particle_density) /
                         sphere_mass(diameter, contact.particle_density);
  const double slope = (g.range * by_group[4] * of_radius / 3.0 +
                        g.beta * by_group[1] * (8.0 / 15.0 * of_radius - 0.4 * of_mass)) /
                       diameter;
  return bent_slope(i, slope, &PointConditions::diameter);
}

std::vector<Prediction> predict(const ImpactModel& model, std::span<const double> theta,
                                std::vector<PointConditions> points, bool gradient) {
  std::vector<Prediction> predictions(points.size());
  PointPredictor predictor(model, std::move(points));
  const auto take = [&](std::size_t first, std::span<const ImpactResult> answers) {
    for (std::size_t k = 0; k < answers.size(); ++k) {
      Prediction& prediction = predictions[first + k];
      prediction.outcome = answers[k].outcome;
      prediction.restitution_squared = answers[k].restitution_squared;
      if (!gradient) continue;
      prediction.gradient.resize(model.slots.size());
      predictor.gradient_row(first + k, answers[k], 1.0, prediction.gradient);
    }
  };
  predictor.evaluate_blocks(theta, gradient, take);
  return predictions;
}

Prediction predict(const ImpactModel& model, std::span<const double> theta, std::size_t dataset,
                   double diameter, double velocity, bool gradient) {
  return predict(model, theta, {{dataset, diameter, velocity}}, gradient).front();
}

std::vector<double> restitution_curve(const ImpactModel& model, std::span<const double> theta,
                                      PointConditions sphere, std::span<const double> velocities,
                                      Effects effects) {
  std::vector<PointConditions> points;
  for (const double velocity : velocities) {
    sphere.velocity = velocity;
    points.push_back(sphere);
  }
  PointPredictor predictor(model, std::move(points), effects);
  predictor.evaluate(theta, false);
  std::vector<double> e;
  for (std::size_t i = 0; i < predictor.size(); ++i) {
    const ImpactResult& impact = predictor.at(i);
    e.push_back(impact.usable() ? std::sqrt(std::max(impact.restitution_squared, 0.0)) : NAN);
  }
  return e;
}

namespace {

/// The values of C_H, C_A, f0 and the parameters of the chain at `point`.
std::vector<double> values_at(const ImpactModel& model, std::span<const double> theta,
                              const PointConditions& point) {
  std::vector<double> values = {theta[model.slot_C_H[point.dataset]],
                                theta[model.slot_C_A[point.dataset]],
                                adhesion_force_under(model, theta, point.dataset)};
  std::size_t k = 0;
  for (const Mechanism* mechanism : model.chain) {
    for (const Parameter& p : mechanism->info.parameters) {
      const auto slot = own_slot(model, k++, p, point);
      values.push_back(slot ? theta[*slot] : p.null_value);
    }
  }
  return values;
}

}  // namespace

ContactView contact_view(const ImpactModel& model, std::span<const double> theta,
                         const PointConditions& point) {
  const Surroundings now = surroundings_under(model, theta, point.dataset);
  ContactView view = view_contact(model.chain, {&now, point.diameter, point.velocity, point.series},
                                  values_at(model, theta, point));
  view.encounter.at = &model.surroundings[point.dataset];
  return view;
}

WholeImpactEnergy whole_impact_energy(const ImpactModel& model, std::span<const double> theta,
                                      const PointConditions& point, const ImpactResult& impact) {
  const Surroundings now = surroundings_under(model, theta, point.dataset);
  return whole_impact_energy(model.chain, {&now, point.diameter, point.velocity, point.series},
                             values_at(model, theta, point), impact);
}

}  // namespace recoil
