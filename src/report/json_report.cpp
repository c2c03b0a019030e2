#include "report/json_report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/files.hpp"
#include "core/program.hpp"
#include "core/units.hpp"
#include "report/format.hpp"
#include "report/json_materials.hpp"
#include "report/json_noise.hpp"
#include "report/json_resampling.hpp"
#include "report/json_values.hpp"
#include "report/posterior_report.hpp"
#include "report/words_dataset.hpp"
#include "report/words_identifiability.hpp"
#include "report/words_intervals.hpp"
#include "report/words_noise.hpp"
#include "report/words_validity.hpp"

namespace recoil {
namespace {

Json dataset_json(const Dataset& dataset) {
  return {{"id", dataset.id},
          {"title", dataset.title},
          {"provenance", to_string(dataset.provenance)},
          {"provenance_sentence", provenance_sentence(dataset.provenance)},
          {"points", dataset.points.size()},
          {"sha256", dataset.sha256},
          {"sources", dataset.sources}};
}

/// The datasets of a joint fit as one: ids joined by "+", the provenance that claims least.
Json joint_json(const std::vector<Dataset>& datasets) {
  if (datasets.size() == 1) return dataset_json(datasets.front());
  std::string id;
  std::string title;
  std::string sums;
  std::size_t points = 0;
  Json sources = Json::array();
  for (const Dataset& dataset : datasets) {
    id += (id.empty() ? "" : "+") + dataset.id;
    title += (title.empty() ? "" : "; ") + dataset.title;
    sums += dataset.sha256;
    points += dataset.points.size();
    for (const std::string& source : dataset.sources) sources.push_back(source);
  }
  const Provenance weakest = weakest_provenance(datasets);
  return {{"id", id},
          {"title", title},
          {"provenance", to_string(weakest)},
          {"provenance_sentence", provenance_sentence(weakest)},
          {"points", points},
          {"sha256", sha256_hex(sums)},
          {"sources", sources}};
}

std::string joined_sentences(const std::vector<Dataset>& datasets) {
  std::string text;
  for (const auto& [label, sentence] : provenances(datasets)) {
    text += fmt::format("{}{}: {}", text.empty() ? "" : " ", label, sentence);
  }
  return text;
}

Json options_json(const Analysis& a) {
  const UncertaintyOptions& options = a.uncertainty.options;
  Json parameters = Json::object();
  for (const ParameterSlot& slot : a.fitted.model.slots) {
    if (slot.is_constant()) continue;
    Json entry = {{"initial", number_or_null(slot.initial)}, {"free", slot.free}};
    entry["bounds"] = Json::array({number_or_null(slot.lower), number_or_null(slot.upper)});
    parameters[slot.label()] = entry;
  }
  // The number of threads is left out on purpose: no digit of a result depends on it.
  return {{"adhesion", to_string(a.fitted.model.adhesion)},
          {"adhesion_damping_phase", to_string(a.fitted.model.phase)},
          {"mechanisms", a.spec.mechanisms},
          {"mixed_sizes", averages_over_sizes(a.fitted.model)},
          {"replicates", options.replicates_auto ? Json("auto") : Json(options.replicates)},
          {"scheme", to_string(options.scheme)},
          {"level", number_or_null(options.level)},
          {"seed", options.seed},
          {"materials", a.spec.uncertainty.materials},
          {"parameters", parameters}};
}

Json parameter_json(const Analysis& a, std::size_t s) {
  const FitResult& f = a.fitted;
  const ParameterSlot& slot = f.model.slots[s];
  Json out;
  put(out, "value", acting_value(f.model, f.theta, s), "the estimate is not finite");
  out["unit"] = slot.parameter->unit;
  out["free"] = slot.free;
  const bool at_bound = s < f.at_bound.size() && f.at_bound[s];
  out["at_bound"] = at_bound;
  const double error = s < f.std_error.size() ? f.std_error[s] : NAN;
  const std::string why = !slot.free ? "the parameter is fixed"
                          : at_bound ? "the estimate rests on a bound"
                                     : "the covariance is not available";
  const bool follows = s < a.uncertainty.budgets.size() && !slot.free;
  const double own = follows ? a.uncertainty.budgets[s].sd : error;
  put(out, "std_error", own > 0.0 ? own : NAN, why);

  const IntervalSet set = intervals_of(a, s);
  Json intervals;
  Json reasons = Json::object();
  for (const IntervalKind kind : values_of<IntervalKind>()) {
    Json& interval = intervals[to_string(kind)];
    interval = interval_json(set[kind]);
    if (interval.is_null()) reasons[to_string(kind)] = why_none(set[kind]);
  }
  intervals["why"] = reasons;
  Json recommended;
  const Interval& quoted = recommended_interval(set);
  recommended["interval"] = quoted.available() ? Json(to_string(set.recommended)) : Json(nullptr);
  recommended["why"] = quoted.available() ? recommended_words(set) : why_none(quoted);
  intervals["recommended"] = recommended;
  const std::optional<PosteriorResult>& posterior = a.uncertainty.posterior;
  put_posterior(intervals, a, posterior ? &posterior->parameters[s] : nullptr);
  out["intervals"] = intervals;
  out["recommended"] = recommended;
  const std::optional<ProfileShape> shape = set[IntervalKind::profile].shape;
  out["profile_shape"] = shape ? Json(to_string(*shape)) : Json(nullptr);
  put_resampling(out, a, s);
  if (s < a.uncertainty.budgets.size()) put_budget(out, a.uncertainty.budgets[s], f.model);
  put_conditional(out, a, s);
  return out;
}

/// A slots x slots matrix over the labels of the free parameters.
Json matrix_json(const Analysis& a, bool as_correlation) {
  const FitResult& f = a.fitted;
  const std::size_t slots = f.model.slots.size();
  Json rows = Json::object();
  if (f.covariance.size() != slots * slots) return nullptr;
  for (std::size_t i = 0; i < slots; ++i) {
    if (!f.model.slots[i].free) continue;
    Json row = Json::object();
    for (std::size_t j = 0; j < slots; ++j) {
      if (!f.model.slots[j].free) continue;
      if (!(f.std_error[i] > 0.0) || !(f.std_error[j] > 0.0)) {  // fixed, or resting on a bound
        row[f.model.slots[j].label()] = nullptr;
        continue;
      }
      const double value = !as_correlation ? f.covariance[i * slots + j]
                           : i == j        ? 1.0
                                           : correlation(a, i, j);
      row[f.model.slots[j].label()] = number_or_null(value);
    }
    rows[f.model.slots[i].label()] = row;
  }
  return rows;
}

std::string equation_of(AdhesionLaw law) {
  switch (law) {
    case AdhesionLaw::ring:
      return "Li, Dunn & Brach (1999), eq. 5";
    case AdhesionLaw::jkr:
      return "Johnson, Kendall & Roberts (1971), damped";
    case AdhesionLaw::dmt:
      return "Derjaguin, Muller & Toporov (1975), damped";
    case AdhesionLaw::maugis:
      return "Maugis (1992), damped";
  }
  return {};
}

Json model_json(const Analysis& a) {
  Json contacts = Json::array();
  for (std::size_t k = 0; k < a.datasets.size(); ++k) {
    const ContactProperties& contact = a.fitted.model.contacts[k];
    const ImpactConditions conditions = reference_conditions(a, k, 1.0);
    contacts.push_back(
        {{"dataset", a.datasets[k].id},
         {"stiffness_K_Pa", number_or_null(contact.stiffness)},
         {"stiffness_K_derived_Pa", number_or_null(contact.stiffness_derived)},
         {"adhesion_energy_J_per_m2", number_or_null(contact.adhesion_energy)},
         {"f0_N_per_m", number_or_null(conditions.adhesion_force)},
         {"W_of_f0_J_per_m2",
          number_or_null(adhesion_energy_for(conditions.adhesion_force, conditions.diameter / 2.0,
                                             contact.stiffness))},
         {"f0_eq12_N_per_m", number_or_null(contact.adhesion_force_derived)},
         {"reference_diameter_um", number_or_null(contact.reference_diameter / units::um)},
         {"particle_density_kg_per_m3", number_or_null(contact.particle_density)},
         {"adhesion_velocity_m_per_s", number_or_null(adhesion_velocity(conditions))},
         {"contradictions", contact.contradictions}});
  }
  const AdhesionLaw law = a.fitted.model.adhesion;
  Json model = {{"equation", equation_of(law)},
                {"adhesion", to_string(law)},
                {"adhesion_damping_phase", to_string(a.fitted.model.phase)},
                {"contacts", contacts}};
  if (law == AdhesionLaw::maugis) model["separation_m"] = a.fitted.model.separation;
  return model;
}

Json goodness_json(const Analysis& a) {
  const FitResult& f = a.fitted;
  Json out;
  put(out, "chi2", f.chi2, "the sum of squares is not finite");
  out["dof"] = f.dof;
  const bool defined = a.fitted.data.sd_stated && f.dof > 0;
  put(out, "p_value", defined ? f.p_value : NAN,
      a.fitted.data.sd_stated
          ? "no degrees of freedom are left"
          : "no standard deviations are stated: the noise is estimated from the fit");
  put(out, "rmse", f.rmse, "no point rebounded");
  put(out, "noise_scale", f.noise_scale, "the noise could not be estimated");
  out["noise_text"] = noise_words(f);
  return out;
}

Json capture_json(const Analysis& a) {
  Json list = Json::array();
  for (const CaptureEstimate& capture : a.uncertainty.capture) {
    Json entry;
    entry["dataset"] = a.datasets[capture.dataset].id;
    entry["diameter_um"] = number_or_null(capture.diameter / units::um);
    entry["unit"] = "m/s";
    put(entry, "value", capture.found ? capture.value : NAN,
        "no velocity at which capture turns into rebound was found");
    entry["interval"] = interval_json(capture.interval);
    entry["interval_mc_error"] = mc_error_json(capture.interval);
    for (const CaptureIntervalKind kind : values_of<CaptureIntervalKind>()) {
      entry["intervals"][to_string(kind)] = interval_json(capture[kind]);
    }
    entry["recommended"] = {
        {"interval", capture.because ? Json(to_string(capture.recommended)) : Json(nullptr)},
        {"why", recommended_words(capture)}};
    if (entry["interval"].is_null()) entry["why"] = why_none(capture.interval);
    if (const auto& posterior = a.uncertainty.posterior; posterior && posterior->available()) {
      entry["intervals"]["posterior"] = interval_json(posterior->capture[list.size()].interval);
    }
    const std::size_t k = list.size();
    if (k < a.uncertainty.capture_budgets.size()) {
      put_budget(entry, a.uncertainty.capture_budgets[k], a.fitted.model);
    }
    list.push_back(entry);
  }
  return list;
}

Json validity_json(const Analysis& a) {
  Json list = Json::array();
  for (const Validity& one : a.validity) {
    list.push_back({{"quantity", to_string(one.quantity)},
                    {"value", number_or_null(one.value)},
                    {"limit", one.limit},
                    {"limit_is", one.limit_is_least() ? "least" : "largest"},
                    {"passed", one.passed()},
                    {"dataset", a.datasets[one.dataset].id},
                    {"diameter_um", one.diameter / units::um},
                    {"incident_velocity", one.velocity},
                    {"text", validity_sentence(one)}});
  }
  return list;
}

Json bootstrap_json(const Analysis& a) {
  const BootstrapResult& bootstrap = a.uncertainty.bootstrap;
  Json two_point_failed = Json::object();
  for (std::size_t k = 0; k < a.datasets.size() && k < bootstrap.two_point_failed.size(); ++k) {
    two_point_failed[a.datasets[k].id] = bootstrap.two_point_failed[k];
  }
  return {{"scheme", to_string(bootstrap.scheme)},
          {"scheme_why", scheme_words(bootstrap)},
          {"replicates", bootstrap.replicates},
          {"failed", bootstrap.failed},
          {"failures", failures_json(bootstrap, a.fitted.data)},
          {"mc_error_of_width",
           bootstrap.relative_error ? number_or_null(*bootstrap.relative_error) : Json(nullptr)},
          {"seed", bootstrap.seed},
          {"usable", bootstrap.theta.size()},
          {"two_point_replicates", bootstrap.two_point_replicates},
          {"two_point_failed", two_point_failed}};
}

/// What the points know, direction by direction, and what more of them would do.
Json information_json(const Analysis& a) {
  const Information& information = a.uncertainty.identifiability.information;
  const std::vector<ParameterSlot>& slots = a.fitted.model.slots;
  const auto by_parameter = [&](const std::vector<double>& values) {
    Json out = Json::object();
    for (std::size_t s = 0; s < values.size() && s < slots.size(); ++s) {
      if (slots[s].free && values[s] != 0.0) out[slots[s].label()] = number_or_null(values[s]);
    }
    return out;
  };
  Json directions = Json::array();
  for (const InformationDirection& direction : information.directions) {
    directions.push_back({{"exponents", by_parameter(direction.exponents)},
                          {"relative_sd", number_or_null(direction.relative_sd)},
                          {"words", plain_text(direction_words(a.fitted, direction))}});
  }
  Json plans = Json::array();
  constexpr std::size_t most_plans = 3;
  for (const PlannedPoints& plan : information.plans) {
    if (plans.size() == most_plans) break;
    plans.push_back({{"dataset", a.datasets[plan.dataset].id},
                     {"diameter_um", plan.diameter / units::um},
                     {"incident_velocity", plan.velocity},
                     {"points", plan.points},
                     {"relative_sd", by_parameter(plan.relative_sd)}});
  }
  return {{"directions", directions},
          {"relative_sd", by_parameter(information.relative_sd)},
          {"condition", number_or_null(information.condition)},
          {"more_points", plans}};
}

Json identifiability_json(const Analysis& a) {
  const Identifiability& found = a.uncertainty.identifiability;
  Json parameters = Json::object();
  for (std::size_t s = 0; s < found.parameter.size() && s < a.fitted.model.slots.size(); ++s) {
    if (!a.fitted.model.slots[s].free) continue;
    parameters[a.fitted.model.slots[s].label()] = found.parameter[s].identifiable;
  }
  return {{"verdict", found.assessed() ? Json(to_string(found.verdict)) : Json(nullptr)},
          {"text", plain_text(identifiability_words(a.fitted, a.uncertainty))},
          {"parameters", parameters},
          {"information", information_json(a)}};
}

}  // namespace

std::string json_report(const Analysis& analysis) {
  Json out;
  out["format_version"] = format_version;
  out["recoil_version"] = version();
  out["fit"] = {{"id", analysis.spec.id}, {"sha256", analysis.spec.sha256}};
  out["provenance_sentence"] = joined_sentences(analysis.datasets);
  out["dataset"] = joint_json(analysis.datasets);
  Json datasets = Json::array();
  for (const Dataset& dataset : analysis.datasets) datasets.push_back(dataset_json(dataset));
  out["datasets"] = datasets;
  out["options"] = options_json(analysis);
  out["model"] = model_json(analysis);
  Json parameters = Json::object();
  for (std::size_t s = 0; s < analysis.fitted.model.slots.size(); ++s) {
    if (analysis.fitted.model.slots[s].is_constant()) continue;
    parameters[analysis.fitted.model.slots[s].label()] = parameter_json(analysis, s);
  }
  out["parameters"] = parameters;
  out["constants"] = constants_json(analysis);
  out["covariance"] = matrix_json(analysis, false);
  out["correlation"] = matrix_json(analysis, true);
  out["derived"] = {{"capture_velocity", capture_json(analysis)}};
  out["solver"] = {{"name", to_string(analysis.fitted.model.solver.kind)},
                   {"handovers", analysis.fitted.handovers},
                   {"ended", to_string(analysis.fitted.ending)}};
  out["goodness"] = goodness_json(analysis);
  out["noise"] = noise_json(analysis);
  out["identifiability"] = identifiability_json(analysis);
  out["validity"] = validity_json(analysis);
  out["bootstrap"] = bootstrap_json(analysis);
  out["posterior"] = posterior_json(analysis);
  put_two_point(out, analysis);
  out["starts"] = starts_json(analysis);
  std::vector<Sentence> warnings = all_warnings(analysis);
  for (const Sentence& sentence : all_contradictions(analysis)) warnings.push_back(sentence);
  out["warnings"] = plain_texts(warnings);
  out["curve"] = curve_json(analysis);
  out["residuals"] = residuals_json(analysis);
  return out.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace recoil
