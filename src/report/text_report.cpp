#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "data/text.hpp"
#include "report/format.hpp"
#include "report/pair_words.hpp"
#include "report/text_blocks.hpp"
#include "report/words_noise.hpp"
#include "report/words_two_point.hpp"

namespace recoil {
namespace {

constexpr double least_correlation = 0.1;
constexpr std::size_t most_starts = 8;

void write_provenance(Blocks& out, const Analysis& a) {
  out.open("Provenance");
  out.item("fit", a.spec.file.empty() ? a.spec.id : a.spec.file.generic_string());
  out.item("recoil", version());
  for (const Dataset& dataset : a.datasets) {
    out.item("dataset", fmt::format("{} ({}, {} points)", dataset.id, to_string(dataset.provenance),
                                    dataset.points.size()));
    if (!dataset.title.empty()) out.item("  title", dataset.title);
    if (!dataset.sha256.empty()) out.item("  sha256", dataset.sha256);
  }
  for (const auto& [label, sentence] : provenances(a.datasets)) {
    const bool named = sentence.find(label) != std::string::npos;
    out.say(named ? sentence : fmt::format("{}: {}", label, sentence));
  }
}

void write_model(Blocks& out, const Analysis& a) {
  const ImpactModel& model = a.fitted.model;
  out.open("Model");
  out.say(
      fmt::format("Hertz contact with ring adhesion 2 pi a f0 and damping C_H, C_A "
                  "(Li, Dunn & Brach 1999, eq. 5)"));
  out.item("adhesion damping",
           fmt::format("phase \"{}\", always dissipative", to_string(model.phase)));
  if (!a.spec.mechanisms.empty()) {
    out.item("mechanisms", fmt::format("{}", fmt::join(a.spec.mechanisms, ", ")));
  }
  const bool has_theta = a.fitted.theta.size() == model.slots.size();
  for (std::size_t k = 0; k < a.datasets.size() && k < model.contacts.size(); ++k) {
    const ContactProperties& contact = model.contacts[k];
    if (a.datasets.size() > 1) out.line(a.datasets[k].id);
    out.line(fmt::format("K = {} GPa   W_A = {} J/m2   eq. 12: f0 = {} N/m at d = {} um",
                         number(contact.stiffness / units::GPa), number(contact.adhesion_energy),
                         number(contact.adhesion_force),
                         diameter_text(contact.reference_diameter)));
    if (has_theta) {
      const ImpactConditions conditions = reference_conditions(a, k, 1.0);
      out.line(fmt::format("V_a = {} m/s (adhesion and inertia balance) with f0 = {} N/m",
                           number(adhesion_velocity(conditions)),
                           number(conditions.adhesion_force)));
    }
    for (const std::string& sentence : contact.contradictions) {
      out.entry("contradiction: " + sentence);
    }
  }
}

std::string solver_text(const FitResult& f) {
  if (f.model.solver.kind == Solver::reference) return "reference (CVODES)";
  return fmt::format("fast; {} impacts of the fit were handed over to the reference", f.handovers);
}

void write_statistics(Blocks& out, const Analysis& a) {
  const FitResult& f = a.fitted;
  const auto free = std::count_if(f.model.slots.begin(), f.model.slots.end(),
                                  [](const ParameterSlot& slot) { return slot.free; });
  out.open("Fit Statistics");
  out.item("method", fmt::format("{} in e^2, trust region within bounds (Ceres)",
                                 a.fitted.data.spec.student ? "Student's t likelihood"
                                                            : "weighted least squares"));
  out.item("solver", solver_text(f));
  out.item("data points", fmt::format("{}", a.fitted.data.points.size()));
  out.item("variables", fmt::format("{}", free));
  out.item("chi-square", number(f.chi2, 6));
  out.item("reduced chi-square",
           f.dof > 0 ? fmt::format("{} ({} degrees of freedom)", number(f.chi2 / f.dof, 5), f.dof)
                     : "not defined (no degrees of freedom left)");
  out.item("p-value", a.fitted.data.sd_stated ? p_value_text(f.p_value)
                                              : "not defined (no standard deviations are stated)");
  out.item("rms of e", number(f.rmse));
  if (const std::string words = noise_words(f); !words.empty()) out.item("noise", words);
}

void write_variables(Blocks& out, const Analysis& a) {
  const FitResult& f = a.fitted;
  std::size_t widest = 0;
  for (const ParameterSlot& slot : f.model.slots) widest = std::max(widest, slot.label().size());
  out.open("Variables");
  for (std::size_t s = 0; s < f.model.slots.size(); ++s) {
    const ParameterSlot& slot = f.model.slots[s];
    const std::string name = fmt::format("{:<{}}", slot.label() + ":", widest + 1);
    const std::string unit = unit_suffix(slot.parameter->unit);
    if (!slot.free) {
      out.line(fmt::format("{}  {}{} (fixed)", name, number(f.theta[s]), unit));
      continue;
    }
    const double error = s < f.std_error.size() ? f.std_error[s] : 0.0;
    const bool at_bound = s < f.at_bound.size() && f.at_bound[s];
    const auto [value, spread] = number_with_error(f.theta[s], error);
    std::string content = fmt::format("{}  {}", name, value);
    if (error > 0.0 && std::isfinite(error)) {
      content += fmt::format(" +/- {}{}", spread, unit);
      if (f.theta[s] != 0.0) {
        content += fmt::format(" ({} %)", number(100.0 * error / std::abs(f.theta[s]), 3));
      }
    } else {
      content += unit + (at_bound ? "" : " (no standard error)");
    }
    content += fmt::format(" (init = {})", number(slot.initial));
    if (at_bound) {
      content += fmt::format(" AT BOUND [{}, {}]", number(slot.lower), number(slot.upper));
    }
    out.line(content);
    const IntervalSet set = intervals_of(a, s);
    const Interval interval = recommended_interval(set);
    const std::string lead(std::min<std::size_t>(widest + 3, 30), ' ');
    const std::string words =
        interval.available()
            ? fmt::format("{} interval {} ({})", percent(a.uncertainty.options.level),
                          interval_text(interval), set.recommended)
            : "no interval: " + reason_without(set);
    out.say(words, Blocks::margin + lead.size());
    if (!interval.note.empty()) out.say(interval.note, Blocks::margin + lead.size());
  }
  for (const std::string& sentence : recommendations(a)) out.say(sentence);
  for (const std::string& sentence : disagreements(a)) out.say(sentence);
}

void write_correlations(Blocks& out, const Analysis& a) {
  const auto& slots = a.fitted.model.slots;
  struct Pair {
    std::string label;
    double value;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    for (std::size_t j = i + 1; j < slots.size(); ++j) {
      const double value = correlation(a, i, j);
      if (std::abs(value) < least_correlation) continue;
      pairs.push_back({fmt::format("C({}, {})", slots[i].label(), slots[j].label()), value});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) {
    return std::abs(x.value) > std::abs(y.value);
  });
  out.open("Correlations",
           fmt::format(" (unreported correlations are < {:.3f})", least_correlation));
  std::size_t widest = 0;
  for (const Pair& pair : pairs) widest = std::max(widest, pair.label.size());
  for (const Pair& pair : pairs) {
    out.line(fmt::format("{:<{}} = {:+.4f}", pair.label, widest, pair.value));
  }
}

void write_capture(Blocks& out, const Analysis& a) {
  if (a.uncertainty.capture.empty()) return;
  out.open("Capture Velocity");
  for (const CaptureEstimate& capture : a.uncertainty.capture) {
    std::string content = fmt::format("d = {:>6} um   ", diameter_text(capture.diameter));
    if (without_adhesion(a, capture.dataset)) {
      content += fmt::format("V* = {}", no_capture_words);
    } else if (!capture.found) {
      content += "none found";
    } else {
      content += fmt::format("V* = {:>7} m/s", digits(capture.value, 4));
      content += capture.interval.available()
                     ? fmt::format("   {} {}", percent(a.uncertainty.options.level),
                                   interval_text(capture.interval))
                     : fmt::format("   no interval: {}", capture.interval.why);
    }
    if (a.datasets.size() > 1) content += "   " + a.datasets[capture.dataset].id;
    out.line(content);
  }
}

std::string point_text(const Analysis& a, std::size_t index) {
  if (index >= a.fitted.data.points.size()) return "none";
  const Observation& point = a.fitted.data.points[index];
  return fmt::format("e = {} at V = {} m/s", number(point.restitution), number(point.velocity));
}

void write_two_point(Blocks& out, const Analysis& a) {
  if (a.uncertainty.two_point.empty()) return;
  const FitResult& f = a.fitted;
  out.open("Two Points Against All");
  for (const TwoPointComparison& comparison : a.uncertainty.two_point) {
    const TwoPointResult& two = comparison.result;
    out.item("dataset",
             fmt::format("{}, calibrated at d = {} um", a.datasets[comparison.dataset].id,
                         diameter_text(two.diameter)));
    out.item("status",
             fmt::format("{} ({} iterations): {}", words_of(to_string(two.status)), two.iterations,
                         two_point_words(a.fitted, comparison.dataset, two)));
    out.item("high point", point_text(a, two.high_point));
    out.item("low point", point_text(a, two.low_point));
    const auto row = [&](const std::string& name, const std::string& x, const std::string& y) {
      out.line(fmt::format("{:<28}{:>14}{:>14}", name, x, y));
    };
    const auto at = [](const std::vector<double>& values, std::size_t s) {
      return s < values.size() ? number(values[s]) : std::string("n/a");
    };
    row("", "two points", "all points");
    for (const std::size_t s :
         {f.model.slot_C_H[comparison.dataset], f.model.slot_C_A[comparison.dataset]}) {
      const ParameterSlot& slot = f.model.slots[s];
      row(fmt::format("{} [{}]", slot.parameter->name, slot.parameter->unit), at(two.theta, s),
          at(f.theta, s));
      row("  spread under resampling", at(comparison.spread, s), at(comparison.full_spread, s));
    }
    const bool answered = two.status != TwoPointStatus::too_few_points;
    row("rms of e, all points", answered ? number(comparison.rmse) : "none",
        number(comparison.full_rmse));
    row("rms of e, other diameters",
        comparison.held_out_rmse ? number(*comparison.held_out_rmse) : "none",
        comparison.full_held_out_rmse ? number(*comparison.full_held_out_rmse) : "none");
    if (!comparison.held_out_why.empty()) out.say(comparison.held_out_why);
    if (comparison.failed > 0) {
      out.say(fmt::format("In {} of {} replicates the two-point iteration found no answer.",
                          comparison.failed, a.uncertainty.bootstrap.two_point_replicates));
    }
    for (const PairStudy& study : a.uncertainty.pairs) {
      if (study.dataset != comparison.dataset) continue;
      for (const std::string& sentence : pair_words(a, study)) out.say(sentence);
    }
  }
}

void write_bootstrap(Blocks& out, const Analysis& a) {
  const BootstrapResult& bootstrap = a.uncertainty.bootstrap;
  out.open("Bootstrap");
  if (bootstrap.replicates == 0) {
    out.say("not run: no replicates were asked for");
    return;
  }
  out.item("scheme", bootstrap.scheme_why.empty()
                         ? bootstrap.scheme
                         : fmt::format("{} ({})", bootstrap.scheme, bootstrap.scheme_why));
  out.item("replicates", fmt::format("{}, {} failed", bootstrap.replicates, bootstrap.failed));
  if (const std::string chance = chance_text(bootstrap); !chance.empty()) {
    out.item("Monte-Carlo error", chance);
  }
  out.item("seed", fmt::format("{}", bootstrap.seed));
  if (bootstrap.failed > 0) out.say(as_sentence(bootstrap.failures.text));
}

void write_starts(Blocks& out, const Analysis& a) {
  const auto& starts = a.fitted.starts;
  if (starts.empty()) return;
  out.open("Starts");
  for (std::size_t i = 0; i < starts.size() && i < most_starts; ++i) {
    out.line(fmt::format("{:>2}  chi-square = {:<10} {}", i + 1, number(starts[i].chi2, 6),
                         starts[i].converged ? "converged" : "failed: " + starts[i].message));
  }
  if (starts.size() > most_starts) {
    out.say(fmt::format("and {} more", starts.size() - most_starts));
  }
}

}  // namespace

std::string text_report(const Analysis& analysis) {
  Blocks out;
  write_provenance(out, analysis);
  write_model(out, analysis);
  if (analysis.fitted.usable) {
    write_statistics(out, analysis);
    write_variables(out, analysis);
    write_correlations(out, analysis);
    write_capture(out, analysis);
    write_two_point(out, analysis);
    write_bootstrap(out, analysis);
    const Identifiability& identifiability = analysis.uncertainty.identifiability;
    if (!identifiability.verdict.empty()) {
      out.open("Identifiability");
      out.item("verdict", identifiability.verdict);
      if (!identifiability.text.empty()) out.say(identifiability.text);
    }
  } else {
    out.open("Failure");
    out.say(analysis.fitted.failure);
  }
  write_starts(out, analysis);
  if (const auto warnings = all_warnings(analysis); !warnings.empty()) {
    out.open("Warnings");
    for (const std::string& warning : warnings) out.entry(warning);
  }
  return out.take();
}

}  // namespace recoil
