#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/units.hpp"
#include "data/text.hpp"
#include "report/fit_report.hpp"
#include "report/format.hpp"
#include "report/words_fit.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_sizes = 10;

Cell number_at(const std::vector<double>& values, std::size_t i, const Notation& notation) {
  return i < values.size() ? Cell(Number{values[i], notation}) : Cell();
}

std::string level_of(const Analysis& a) { return percent(a.uncertainty.options.level); }

Sentence label_with_unit(const Analysis& a, std::size_t slot) {
  const Parameter& parameter = *a.fitted.model.slots[slot].parameter;
  const Sentence name = parameter_words(a.fitted.model, slot, a.datasets);
  const bool is_f0 = parameter.role == ParameterRole::adhesion_force;
  return name_with_unit(is_f0 ? with_its_size(a.fitted, name) : name, parameter.unit);
}

std::size_t free_parameters(const FitResult& fitted) {
  const auto& slots = fitted.model.slots;
  return static_cast<std::size_t>(
      std::ranges::count_if(slots, [](const ParameterSlot& slot) { return slot.free; }));
}

Cell capture_cell(const Analysis& a, const CaptureEstimate& capture) {
  if (without_adhesion(a, capture.dataset)) return "none (no adhesion)";
  if (capture.above && capture.below && *capture.above < *capture.below) {
    return say("{:.3g} to {:.3g}", *capture.above, *capture.below);
  }
  if (capture.above) return say("above {:.3g}", *capture.above);
  if (capture.below) return say("below {:.3g}", *capture.below);
  if (!capture.found) return "none found";
  return with_interval(capture.value, capture.interval, padded(3));
}

/// A short remark about a parameter; may be empty.
std::string remark_of(const FitResult& f, std::size_t s, const Interval& interval) {
  if (!f.model.slots[s].free) return followed_in(f.model, s) ? "follows the materials" : "fixed";
  if (interval.note) {
    if (const std::string words = short_note(interval.note->caution); !words.empty()) return words;
  }
  if (s < f.at_bound.size() && f.at_bound[s]) return "at its bound";
  return interval.available() ? "" : missing_words(interval);
}

Cell p_value_cell(const FitResult& f) {
  if (!f.data.noise.sd_stated) return "not defined (no standard deviations are stated)";
  if (f.dof <= 0) return "not defined (no degrees of freedom left)";
  return Number{f.p_value, probability()};
}

/// The degrees of freedom, with the number of captured points that do not count.
Cell degrees_of_freedom_cell(const FitResult& f) {
  const int excluded =
      static_cast<int>(f.data.points.size()) - static_cast<int>(free_parameters(f)) - f.dof;
  if (!f.data.noise.sd_stated || f.data.noise.spec.student || excluded <= 0) {
    return whole(std::max(0, f.dof));
  }
  return say("{} ({} excluded)", std::max(0, f.dof),
             counted(excluded, "captured point is", "captured points are"));
}

std::string_view strategy_words(Strategy strategy) {
  using enum Strategy;
  static constexpr Phrase<Strategy> phrases[] = {
      {trust_region, "trust region within bounds (Ceres)"},
      {box_descent, "Levenberg-Marquardt within bounds"},
      {gauss_newton, "Gauss-Newton"}};
  return phrase_for(phrases, strategy).words;
}

std::string starts_words(const FitResult& f) {
  const auto count = [&](StartOutcome outcome) {
    return std::ranges::count(f.starts, outcome, &StartSummary::outcome);
  };
  const auto tied = count(StartOutcome::tie);
  return fmt::format("{} of {} starts reach the same minimum{}", 1 + count(StartOutcome::same),
                     f.starts.size(),
                     tied > 0 ? fmt::format(", {} its chi2 at other parameters", tied) : "");
}

}  // namespace

Table capture_table(const Analysis& a) {
  const SizeUnit size = size_unit(a.datasets);
  std::map<double, std::vector<Cell>> by_diameter;
  for (const CaptureEstimate& capture : a.uncertainty.capture) {
    std::vector<Cell>& cells = by_diameter[capture.diameter];
    cells.resize(a.datasets.size());
    cells[capture.dataset] = capture_cell(a, capture);
  }
  Table table;
  table.columns = {{say("{d}"), size.name}};
  table.compact = a.datasets.size() > 1;
  for (std::size_t k = 0; k < a.datasets.size(); ++k) {
    table.columns.push_back({a.datasets.size() > 1
                                 ? say("{V*} [m/s], {}", short_name(a.datasets, k))
                                 : say("{V*} [{} interval]", level_of(a)),
                             a.datasets.size() > 1 ? "" : "m/s"});
  }
  for (auto& [diameter, cells] : by_diameter) {
    if (table.rows.size() == most_sizes) {
      table.rows.push_back({say("{} more in fit.json", by_diameter.size() - most_sizes)});
      break;
    }
    cells.insert(cells.begin(), Sentence(size_text(diameter, size)));
    table.rows.push_back(std::move(cells));
  }
  return table;
}

Table parameters_table(const Analysis& a) {
  const FitResult& f = a.fitted;
  Table table;
  table.columns = {
      {"parameter"}, {say("estimate {+/-} error")}, {level_of(a) + " interval", "", true}};
  table.compact = true;
  const bool adheres = adheres_anywhere(f.model);
  for (std::size_t s = 0; s < f.model.slots.size(); ++s) {
    const ParameterSlot& slot = f.model.slots[s];
    if (slot.is_constant()) continue;
    if (!adheres && (slot.parameter->is_adhesion() ||
                     slot.parameter->role == ParameterRole::adhesion_damping)) {
      continue;
    }
    if (dry_loss_mechanism(a.spec.loss) != nullptr &&
        slot.parameter->role == ParameterRole::hertz_damping) {
      continue;  // the law of loss replaces C_H
    }
    const Interval interval = recommended_interval(intervals_of(a, s));
    const bool follows = followed_in(f.model, s).has_value();
    double error = s < f.std_error.size() ? f.std_error[s] : 0.0;
    if (follows) error = s < a.uncertainty.budgets.size() ? a.uncertainty.budgets[s].sd : 0.0;
    if (!std::isfinite(error)) error = 0.0;
    const bool flat = std::ranges::find(f.flat, s) != f.flat.end();
    const std::string remark = flat ? "no point depends on it" : remark_of(f, s, interval);
    Cell ends = interval_cell(
        interval, error > 0.0 ? beside(acting_value(f.model, f.theta, s), error) : significant(3));
    if (!remark.empty()) {
      ends = std::holds_alternative<std::monostate>(ends)
                 ? Sentence(remark)
                 : words_of_cell(ends) + Sentence(", " + remark);
    }
    if (interval.available()) {
      ends = words_of_cell(ends) + Sentence(", " + words_of(intervals_of(a, s).recommended));
    }
    table.rows.push_back(
        {label_with_unit(a, s),
         flat ? Cell() : Cell(Number{acting_value(f.model, f.theta, s), significant(4), error}),
         std::move(ends)});
  }
  return table;
}

Table constants_table(const Analysis& a) {
  const ImpactModel& model = a.fitted.model;
  Table table;
  if (a.fitted.std_error.empty()) return table;
  const bool adjusted = model.adjusts_constants();
  table.caption =
      adjusted ? "Material constants with uncertainty, fitted with their stated values as priors"
               : "Material constants with uncertainty: their errors widen the intervals";
  table.columns = {{"constant", "", true}, {"stated"}};
  if (adjusted) table.columns.insert(table.columns.end(), {{"fitted"}, {"moved", "sd"}});
  for (std::size_t k = 0; k < model.material_count(); ++k) {
    const std::size_t j = model.first_constant() + k;
    const UncertainConstant& constant = model.constants[k];
    const double sd = constant.sd * (is_positive(constant.constant) ? constant.stated : 1.0);
    const double scale =
        constant.constant == Constant::youngs_modulus || constant.constant == Constant::stiffness_K
            ? units::GPa
            : 1.0;
    Number stated{constant.stated / scale, significant(4), sd / scale};
    const std::string_view name = model.slots[j].parameter->unit;
    if (name != "1") stated.unit = scale > 1.0 ? "GPa" : std::string(name);
    table.rows.push_back({Sentence(constant_words(model, k, a.datasets)), stated});
    if (!adjusted) continue;
    table.rows.back().insert(
        table.rows.back().end(),
        {Number{a.fitted.theta[j] / scale, significant(4), a.fitted.std_error[j] / scale},
         Number{a.fitted.constants_moved[k], signed_fixed(2)}});
  }
  return table;
}

Table posterior_table(const Analysis& a) {
  Table table;
  if (!a.uncertainty.posterior || !a.uncertainty.posterior->available()) return table;
  const PosteriorResult& found = *a.uncertainty.posterior;
  table.caption = say("Posterior with flat priors between the bounds; {} intervals of equal tails",
                      level_of(a));
  table.columns = {{"quantity"},        {"mean"},        {"sd"}, {"interval"}, {"R-hat"},
                   {"effective draws"}, {"in the tails"}};
  for (std::size_t j = 0; j < found.parameters.size(); ++j) {
    const PosteriorMarginal& m = found.parameters[j];
    if (!a.fitted.model.slots[j].moves()) continue;
    table.rows.push_back({label_with_unit(a, j), Number{m.mean}, Number{m.sd, significant(2)},
                          interval_cell(m.interval), Number{m.check.r_hat, fixed(4)},
                          Number{m.check.bulk, fixed(0)}, Number{m.check.tail, fixed(0)}});
  }
  for (std::size_t k = 0; k < found.capture.size(); ++k) {
    const PosteriorMarginal& m = found.capture[k];
    table.rows.push_back({capture_name(a, a.uncertainty.capture[k]) + " [m/s]", Number{m.mean},
                          Number{m.sd, significant(2)}, interval_cell(m.interval)});
  }
  return table;
}

Table two_point_table(const Analysis& a, const TwoPointComparison& comparison) {
  const FitResult& f = a.fitted;
  Table table;
  table.columns = {{"calibration"},        {symbol("C_H"), "s/m"},
                   {symbol("C_A"), "s/m"}, {with_its_size(a.fitted, say("{f0}")), "N/m"},
                   {say("rms of {e}")},    {"held out"}};
  table.compact = true;
  const std::size_t d = comparison.dataset;
  for (const ComparisonRow& row : comparison.rows) {
    const auto f0 = row.theta.empty() ? std::nullopt
                                      : std::optional(adhesion_force_under(f.model, row.theta, d));
    table.rows.push_back(
        {row.row == CalibrationKind::two_point
             ? say("two points of {}", diameter_sentence(comparison.result.diameter))
         : row.row == CalibrationKind::full         ? say("all points, same {f0}")
         : row.row == CalibrationKind::full_f0_free ? say("all points, {f0} fitted")
                                                    : say("the fit above"),
         number_at(row.theta, f.model.slot_C_H[d], significant(3)),
         number_at(row.theta, f.model.slot_C_A[d], significant(3)),
         cell_if(number_if(f0, significant(3))), cell_if(number_if(row.rmse, significant(2))),
         cell_if(number_if(row.held_out_rmse, significant(2)))});
  }
  return table;
}

Table statistics_table(const Analysis& a) {
  const FitResult& f = a.fitted;
  std::vector<std::pair<Sentence, Cell>> entries = {
      {"equation of motion", equation_words(f.model.adhesion)},
      {"adhesion damping", f.model.phase == AdhesionDampingPhase::rebound
                               ? "during rebound"
                               : "during approach and rebound"},
      {"mechanisms", joined(a.spec.mechanisms, ", ",
                            [](const std::string& id) { return Sentence(words_of(id)); })},
      {"method",
       say("{} in {e}{}, {}; {}",
           f.data.noise.spec.student ? "Student's t likelihood" : "weighted least squares",
           exponent("2"), strategy_words(f.strategy), starts_words(f))},
      {"data points", whole(f.data.points.size())},
      {"free parameters", whole(free_parameters(f))},
      {"chi-square", Number{f.chi2, significant(6)}},
      {"degrees of freedom", degrees_of_freedom_cell(f)},
      {"p-value", p_value_cell(f)},
      {say("rms of {e}"), Number{f.rmse}},
      {"noise", Sentence(noise_words(f))}};
  const BootstrapResult& bootstrap = a.uncertainty.bootstrap;
  if (bootstrap.replicates > 0) {
    entries.emplace_back("bootstrap", say("{} {} replicates, {} failed, seed {}",
                                          bootstrap.replicates, to_string(bootstrap.scheme),
                                          bootstrap.failed, fmt::format("{}", bootstrap.seed)));
  }
  return items(entries);
}

Table materials_table(const Analysis& a) {
  Table table;
  table.columns = {{"material"}};
  table.rows = {{say("density [{kg/m3}]")},
                {"Young's modulus [GPa]"},
                {"Poisson's ratio"},
                {say("surface energy [{J/m2}]")}};
  std::vector<std::string> known;
  const auto add = [&](const Material& material, double energy) {
    if (std::ranges::find(known, material.name) != known.end()) return;
    known.push_back(material.name);
    table.columns.push_back({material.name});
    const std::vector<Cell> cells = {
        material.density > 0.0 ? Cell(Number{material.density, significant(5)}) : Cell(),
        Number{material.youngs_modulus / units::GPa}, Number{material.poisson_ratio},
        say("{}{}", number(energy, 3), material.surface_energy ? "" : " (Gilman)")};
    for (std::size_t row = 0; row < cells.size(); ++row) table.rows[row].push_back(cells[row]);
  };
  for (std::size_t k = 0; k < a.datasets.size(); ++k) {
    const ContactProperties& contact = a.fitted.model.contacts[k];
    add(a.datasets[k].system.particle, contact.gamma_particle);
    add(a.datasets[k].system.surface, contact.gamma_surface);
  }
  return table;
}

Table contact_table(const Analysis& a) {
  const bool by_force = traits(a.fitted.model.adhesion).by_force;
  const double reference = a.fitted.model.contacts.front().reference_diameter;
  Table table;
  table.columns = {{"contact"}};
  table.rows = {
      {say("{K} [GPa]")},
      {say("{W_A} [{J/m2}]")},
      {by_force ? say("{f0} [N/m] at {}", diameter_sentence(reference)) : say("{W} [{J/m2}]")},
      {say("{V_a} [m/s], where adhesion and inertia balance")}};
  if (a.fitted.theta.size() != a.fitted.model.slots.size()) return {};
  for (std::size_t k = 0; k < a.datasets.size(); ++k) {
    const ImpactSystem& system = a.datasets[k].system;
    const ContactProperties& contact = a.fitted.model.contacts[k];
    const ImpactConditions at = reference_conditions(a, k, 1.0);
    const bool fitted = a.fitted.model.slots[a.fitted.model.slot_adhesion[k]].free;
    const auto origin = [](bool stated, double derived, const char* equation) {
      return stated ? say(" (stated; {} gives {})", equation, number(derived)) : Sentence();
    };
    const double energy =
        adhesion_energy_for(at.adhesion_force, at.diameter / 2.0, contact.stiffness);
    table.columns.push_back({a.datasets.size() > 1 ? short_name(a.datasets, k) : "value"});
    table.rows[0].push_back(
        Sentence(number(contact.stiffness / units::GPa)) +
        origin(system.stiffness_K.has_value(), contact.stiffness_derived / units::GPa, "eq. 6"));
    table.rows[1].push_back(
        say("{}{}", number(contact.adhesion_energy), system.adhesion_energy ? " (stated)" : ""));
    table.rows[2].push_back(Sentence(number(by_force ? at.adhesion_force : energy)) +
                            (fitted     ? Sentence(" (fitted)")
                             : by_force ? origin(system.adhesion_force_f0.has_value(),
                                                 contact.adhesion_force_derived, "eq. 12")
                                        : Sentence()));
    table.rows[3].push_back(Number{adhesion_velocity(at)});
  }
  return table;
}

}  // namespace recoil
