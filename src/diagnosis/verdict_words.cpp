#include "diagnosis/verdict_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "data/text.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_titles = 3;  // of tests that found something
constexpr std::size_t most_values = 8;  // of parameters

std::string p_words(double p, int simulated) {
  const double smallest = 1.0 / (simulated + 1.0);
  return p <= smallest * 1.001 ? fmt::format("p < {:.2g}", 2.0 * smallest)
                               : fmt::format("p = {:.2g}", p);
}

std::string diameter_words(double diameter) {
  return diameter < 1e-3 ? fmt::format("{:.3g} um", diameter / units::um)
                         : fmt::format("{:.3g} mm", diameter / 1e-3);
}

std::string title_of(const std::string& id) {
  const Mechanism* mechanism = find_mechanism(id);
  return mechanism == nullptr ? id : fmt::format("{} ({})", id, mechanism->info.title);
}

std::string titles_of(const std::vector<std::string>& ids, const char* between = ", ") {
  std::vector<std::string> titles;
  for (const std::string& id : ids) titles.push_back(title_of(id));
  return fmt::format("{}", fmt::join(titles, between));
}

/// "C_x = 3 m"; of more than `most_values`, as a parameter per series may be, the range.
std::string parameters_words(const CandidateResult& candidate) {
  const auto& all = candidate.parameters;
  if (all.size() > most_values) {
    const auto [low, high] = std::minmax_element(
        all.begin(), all.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
    return fmt::format("{} values from {} = {:.3g} to {} = {:.3g}", all.size(), low->label,
                       low->value, high->label, high->value);
  }
  std::vector<std::string> words;
  for (const FoundParameter& p : candidate.parameters) {
    words.push_back(fmt::format("{} = {:.3g}{}", p.label, p.value, unit_suffix(p.unit)));
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string gain_words(const Diagnosis& d) {
  if (!d.gain || d.gain->folds.empty()) return "";
  std::string text = fmt::format(
      " Points that were held out are predicted with an error of {:.3g} in e instead of {:.3g}",
      d.gain->rmse_extended, d.gain->rmse_base);
  if (d.gain->relative < 0.0) {
    text += fmt::format(" ({:.0f} % more: what was seen elsewhere does not hold there)",
                        -100.0 * d.gain->relative);
  } else if (d.gain->lower && d.gain->upper) {
    text += fmt::format(" ({:.0f} % less, 95 % interval {:.0f} to {:.0f} %)",
                        100.0 * d.gain->relative, 100.0 * *d.gain->lower, 100.0 * *d.gain->upper);
  }
  return text + ".";
}

/// What an explanation leaves and is forgiven, being small beside what it takes.
std::string rest_words(const Diagnosis& d) {
  if (d.extended->remaining_p >= tolerated_level) return "";
  return fmt::format(
      " {:.1f} % of the misfit stay, more than noise ({}): the laws are good to some per cent, or "
      "something smaller acts beside them.",
      100.0 * d.extended->remaining_part, p_words(d.extended->remaining_p, quick_samples));
}

/// Those that would have gained as much as the answer, but are not possible.
std::string aside_words(const Diagnosis& d) {
  std::vector<std::string> words;
  const double answer = d.extended ? d.extended->delta_aicc + d.options.apart : 0.0;
  for (const CandidateResult& c : d.candidates) {
    if (!c.plausible && c.delta_aicc < answer && words.size() < 2) {
      const bool listed =
          std::find(d.rivals.begin(), d.rivals.end(), c.candidate.name()) != d.rivals.end();
      words.push_back(listed ? fmt::format("{} is listed though hardly plausible ({})",
                                           c.candidate.name(), c.aside)
                             : fmt::format("{} is set aside, {}", c.candidate.name(), c.aside));
    }
  }
  return words.empty() ? "" : fmt::format(" {}.", fmt::join(words, "; "));
}

/// When two causes at once are needed: which one all the answers have in common.
std::string common_words(const Diagnosis& d) {
  if (!d.extended || d.extended->candidate.added.size() < 2) return "";
  std::string text = " It takes two at once";
  for (const std::string& id : d.common) text += fmt::format("; {} is one of them in any case", id);
  return text + ".";
}

std::string next_words(const Diagnosis& d) {
  if (d.next.empty()) return "";
  const std::string taken = d.extended->candidate.name();
  const auto about = std::find_if(d.next.begin(), d.next.end(), [&](const NextMeasurement& next) {
    return next.one == taken || next.other == taken;
  });
  const NextMeasurement& next = about == d.next.end() ? d.next.front() : *about;
  std::string text = fmt::format(
      " What would tell {} from {}: spheres of {} at {:.3g} m/s, where they differ by "
      "{:.2g} "
      "in e",
      next.one, next.other, diameter_words(next.diameter), next.velocity,
      std::abs(next.difference));
  text += !next.events        ? "; a million events would not be enough"
          : *next.events == 1 ? "; one event may do"
                              : fmt::format("; about {} events", *next.events);
  return text + ".";
}

std::string one_size_words(const Diagnosis& d) {
  double low = INFINITY, high = 0.0;
  for (const Observation& point : d.base.data.points) {
    low = std::min(low, point.diameter);
    high = std::max(high, point.diameter);
  }
  return high < 1.2 * low ? " One diameter cannot show how the effect depends on size, which is "
                            "what tells causes apart: none is named."
                          : "";
}

/// An adequate model that nothing could have shown wrong.
std::string evidence_words(const Diagnosis& d) {
  constexpr int few = 3;
  const auto& points = d.base.data.points;
  const auto rebounds =
      std::count_if(points.begin(), points.end(), [](const Observation& p) { return !p.censored; });
  const auto free = std::count_if(d.base.model.slots.begin(), d.base.model.slots.end(),
                                  [](const ParameterSlot& slot) { return slot.free; });
  if (rebounds - free >= few) return "";
  return fmt::format(
      " With {} points that rebounded and {} free parameters hardly anything else could have been "
      "seen: that is no evidence for the model.",
      rebounds, free);
}

/// The point that makes most of the misfit, if one does.
std::string single_point_words(const Diagnosis& d) {
  constexpr double most = 0.5;
  const auto& residuals = d.base.residuals;
  const auto worst = std::max_element(residuals.begin(), residuals.end(),
                                      [](double a, double b) { return std::abs(a) < std::abs(b); });
  if (worst == residuals.end() || *worst * *worst < most * d.base.chi2) return "";
  const Observation& point =
      d.base.data.points[static_cast<std::size_t>(worst - residuals.begin())];
  return fmt::format(
      " Most of it is one point, of {} at {:.3g} m/s (e = {:.3g}): look at that first.",
      diameter_words(point.diameter), point.velocity, point.restitution);
}

/// What takes nearly all of the misfit and is not named, because structure is left.
std::string lead_words(const Diagnosis& d) {
  constexpr double nearly_all = 0.2;
  const auto lead =
      std::find_if(d.candidates.begin(), d.candidates.end(), [](const CandidateResult& c) {
        return c.plausible && c.kind != MechanismKind::description && c.delta_aicc < 0.0 &&
               c.remaining_part < nearly_all && c.remaining_p < tolerated_level;
      });
  if (lead == d.candidates.end()) return "";
  return fmt::format(
      " Closest comes {}, which takes {:.0f} % of the misfit: it may be the cause with a law other "
      "than the catalogue's, or one of two; what it leaves is more than noise ({}), and it is not "
      "named.",
      title_of(lead->candidate.name()), 100.0 * (1.0 - lead->remaining_part),
      p_words(lead->remaining_p, quick_samples));
}

std::string found_words(const Diagnosis& d) {
  std::vector<std::string> found;
  for (const StructureTest& test : d.structure.tests) {
    if (test.p_value > 0.01) continue;
    if (found.size() == most_titles) {
      found.emplace_back("and more");
      break;
    }
    found.push_back(test.title);
  }
  return found.empty() ? "" : fmt::format(": {}", fmt::join(found, ", "));
}

}  // namespace

std::vector<UnstatedErrors> rival_errors(const Diagnosis& d) {
  std::vector<UnstatedErrors> rivals;
  for (const UnstatedErrors& errors : d.unstated) {
    const bool close = !d.extended || errors.delta_aicc < d.extended->delta_aicc + d.options.apart;
    const bool two_for_one = d.extended && d.extended->candidate.added.size() > 1;
    if (errors.leave_nothing() && (close || two_for_one)) rivals.push_back(errors);
  }
  return rivals;
}

namespace {

std::string errors_words(const UnstatedErrors& errors) {
  return errors.id == "velocity_errors"
             ? fmt::format(
                   "velocities uncertain by {:.2g} % each (velocity_relative_sd = {:.2g} "
                   "under [noise]) leave nothing systematic (p = {:.2g})",
                   100.0 * errors.value, errors.value, errors.remaining_p)
             : fmt::format(
                   "standard deviations {:.2g} times as large leave nothing systematic "
                   "(p = {:.2g})",
                   errors.value, errors.remaining_p);
}

std::string rival_errors_words(const Diagnosis& d) {
  const std::vector<UnstatedErrors> rivals = rival_errors(d);
  if (rivals.empty()) return "";
  std::vector<std::string> words;
  for (const UnstatedErrors& errors : rivals) words.push_back(errors_words(errors));
  const double behind = d.extended ? rivals.front().delta_aicc - d.extended->delta_aicc : 0.0;
  return fmt::format(" Errors that were not stated would do {}: {}.",
                     !d.extended                ? "without any cause"
                     : behind > d.options.apart ? fmt::format("too, if less well (AICc larger by "
                                                              "{:.0f} than with two causes)",
                                                              behind)
                                                : "as well",
                     fmt::join(words, "; "));
}

std::string unexplained_words(const Diagnosis& d) {
  if (!d.structure.smooth) {
    return " It has no shape in velocity and size: the points scatter more than their stated "
           "deviations say, which are then too small.";
  }
  if (d.free_form_p <= 0.01) {
    return " A smooth function of velocity and size does not take it up either.";
  }
  return rival_errors(d).empty()
             ? " A smooth function of velocity and size takes it up: there is an effect that this "
               "program does not know, or one that acts on some of the points only."
             : " A smooth function of velocity and size takes it up as well, as it would an effect "
               "that this program does not know.";
}

}  // namespace

std::string where_text(const Diagnosis& d) {
  const auto worst = std::max_element(d.where.begin(), d.where.end(),
                                      [](const MisfitCell& a, const MisfitCell& b) {
                                        return std::abs(a.standardised) < std::abs(b.standardised);
                                      });
  if (worst == d.where.end() || std::abs(worst->standardised) < 2.0) return "";
  return fmt::format(
      "It is furthest off for {} at {:.3g} to {:.3g} m/s, where it is too {} by {:.2g} in e "
      "({:.2g} standard errors) and by {:.2g} J in the energy of the rebound",
      diameter_words(worst->diameter), worst->slowest, worst->fastest,
      worst->restitution > 0.0 ? "low" : "high", std::abs(worst->restitution),
      std::abs(worst->standardised), std::abs(worst->energy));
}

std::string verdict_text(const Diagnosis& d) {
  const std::string p = p_words(d.structure.p_value, d.structure.simulated);
  if (d.verdict == Verdict::adequate) {
    return fmt::format(
               "The model describes these points: nothing systematic is left in its residuals ({}; "
               "of data sets that the model itself makes, so many look as systematic).",
               p) +
           evidence_words(d);
  }
  std::string text =
      fmt::format("The fitted model leaves structure in its residuals ({}){}. ", p, found_words(d));
  const std::string where = where_text(d);
  if (!where.empty()) text += where + ". ";
  switch (d.verdict) {
    case Verdict::cause_named:
      text += fmt::format("Of all that the catalogue offers, only {} it: {}.",
                          d.named.size() == 1
                              ? title_of(d.named.front()) + " explains"
                              : fmt::format("{} together explain", titles_of(d.named, " and ")),
                          parameters_words(*d.extended));
      text += gain_words(d) + rest_words(d);
      break;
    case Verdict::not_separable:
      text += d.rivals.size() == 1
                  ? fmt::format("Of all that the catalogue offers, only {} would explain it.",
                                titles_of(d.rivals))
              : d.shared_cause.empty()
                  ? fmt::format("These data cannot tell which of these causes it is: {}.",
                                titles_of(d.rivals))
                  : fmt::format("The cause is {}; by which of its laws these data cannot tell: {}.",
                                d.shared_cause, titles_of(d.rivals));
      text += common_words(d) + one_size_words(d);
      text += fmt::format(" The extended model takes {}: {}.", d.extended->candidate.name(),
                          parameters_words(*d.extended));
      text += gain_words(d) + rest_words(d) + next_words(d);
      break;
    case Verdict::unexplained:
      text += d.outdone.empty() ? "Nothing in the catalogue explains it, alone or in pairs."
                                : fmt::format(
                                      "{} would explain it, but so would errors that were not "
                                      "stated, and with less: no cause is told.",
                                      d.outdone);
      text += single_point_words(d) + lead_words(d) + unexplained_words(d);
      break;
    case Verdict::adequate:
      break;
  }
  return text + rival_errors_words(d) + aside_words(d);
}

}  // namespace recoil
