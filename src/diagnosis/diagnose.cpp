#include "diagnosis/diagnose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "diagnosis/judge.hpp"
#include "diagnosis/next_experiments.hpp"
#include "diagnosis/search.hpp"
#include "diagnosis/separation.hpp"
#include "diagnosis/trial.hpp"
#include "diagnosis/unstated_errors.hpp"
#include "estimate/capture_velocity.hpp"
#include "estimate/law_average.hpp"
#include "estimate/predictor.hpp"
#include "mechanism/mechanism.hpp"
#include "uncertainty/bootstrap.hpp"
#include "uncertainty/fit_alternatives.hpp"
#include "uncertainty/parameter_intervals.hpp"

namespace recoil {

/// The data of one diagnosis and the base model fitted to them. `base` refers to the other members.
struct DiagnosedData {
  DiagnosedData(const FitSpec& stated, std::vector<Dataset> points, const FitResult& fitted,
                const DiagnosisOptions& given)
      : spec(stated),
        datasets(std::move(points)),
        options(given),
        base(search_base(spec, datasets, fitted, options)) {}

  FitSpec spec;
  std::vector<Dataset> datasets;
  DiagnosisOptions options;
  SearchBase base;
};

namespace {

// With one size, only the shape of one curve gives evidence.
constexpr double margin_at_one_size = 20.0;

/// The p-value of structure in the residuals of `refit`, which predicts as the base model does.
double quick_p_value(const SearchBase& base, const Refit& refit) {
  return quick_structure(base.fitted.data, base.fitted.weights, refit,
                         base.fitted.prediction_squared, base.noise)
      .p_value;
}

/// Adds the largest effect of `mechanism` in every dataset.
void add_effects(const SearchBase& base, const Mechanism& mechanism,
                 std::vector<ExpectedEffect>& all) {
  const Candidate candidate =
      make_candidate(base.spec, base.datasets, {std::string(mechanism.info.id)});
  const ImpactModel& model = candidate.model;
  const std::vector<double> with = carried_over(base.candidate.model, base.refit.theta, model);
  const std::vector<double> without = without_mechanism(model, with, mechanism);
  const std::vector<Prediction> acted = predict(model, with, candidate.impacts, false);
  const std::vector<Prediction> plain = predict(model, without, candidate.impacts, false);
  for (std::size_t d = 0; d < base.datasets.size(); ++d) {
    std::optional<ExpectedEffect> most;
    for (std::size_t i = 0; i < candidate.impacts.size(); ++i) {
      const PointConditions& at = candidate.impacts[i];
      if (at.dataset != d || !acted[i].usable() || !plain[i].usable()) continue;
      const ParameterSlot& strength = strength_at(model, mechanism, at);
      if (!strength.stated || strength.initial == strength.parameter->null_value) continue;
      const double change = acted[i].restitution() - plain[i].restitution();
      if (most && std::abs(change) <= std::abs(most->change)) continue;
      const Condition condition = *strength.stated;
      most = {std::string(mechanism.info.id),
              d,
              condition,
              conditions_of(base.datasets[d], at.series).of(condition).value_or(0.0),
              at.diameter,
              at.velocity,
              change};
    }
    if (most) all.push_back(*most);
  }
}

/// For every dataset and every mechanism whose strength its conditions state: the largest change of
/// e by the mechanism at the parameters of the base fit, even if it is too small to be detected.
/// The largest change first.
std::vector<ExpectedEffect> expected_effects(const SearchBase& base) {
  std::vector<ExpectedEffect> all;
  for (const Mechanism* mechanism : mechanisms_that_may_act(base.spec, base.candidate.model)) {
    const std::vector<Parameter>& parameters = mechanism->info.parameters;
    if (parameters.empty() || parameters.front().stated_by.empty()) continue;
    add_effects(base, *mechanism, all);
  }
  std::ranges::stable_sort(all, std::ranges::greater{},
                           [](const ExpectedEffect& one) { return std::abs(one.change); });
  return all;
}

/// The change of e^2 by every mechanism that a search would try, at its usual strength
/// [mechanisms][points].
std::vector<std::vector<double>> effect_shapes(const SearchBase& base) {
  std::vector<std::vector<double>> shapes;
  for (const Mechanism* mechanism : mechanisms_that_may_act(base.spec, base.candidate.model)) {
    if (mechanism->info.kind == MechanismKind::description) continue;
    const Candidate candidate =
        make_candidate(base.spec, base.datasets, {std::string(mechanism->info.id)});
    const ImpactModel& model = candidate.model;
    const std::vector<double> with = carried_over(base.candidate.model, base.refit.theta, model);
    const std::vector<Prediction> acted = predict(model, with, candidate.impacts, false);
    const std::vector<Prediction> plain =
        predict(model, without_mechanism(model, with, *mechanism), candidate.impacts, false);
    std::vector<double> change(acted.size(), 0.0);
    for (std::size_t i = 0; i < change.size(); ++i) {
      if (acted[i].usable() && plain[i].usable()) {
        change[i] = acted[i].restitution_squared - plain[i].restitution_squared;
      }
    }
    shapes.push_back(std::move(change));
  }
  return shapes;
}

/// The residuals of calibrating data sets, those without a fit left out.
struct Calibrating {
  Samples residuals;
  std::size_t tried = 0;

  /// Goes on until `count` data sets are tried.
  void simulate(const SearchBase& base, std::size_t count, Progress& progress) {
    std::vector<std::optional<std::vector<double>>> answers(count - tried);
    parallel_over(answers.size(), base.options.threads, [&](std::size_t b) {
      answers[b] = residuals_of_sample(base, tried + b);
      progress.advance();
    });
    tried = count;
    for (auto& answer : answers) {
      if (answer) residuals.push_back(std::move(*answer));
    }
  }
};

/// Step 1: tests whether the base model leaves structure.
/// @return the residuals of the calibrating data sets [points x data sets]
Eigen::MatrixXd test_base(const SearchBase& base, Diagnosis& diagnosis, Progress& progress) {
  const StructureStatistics statistics(base.fitted.data, base.fitted.weights, base.first,
                                       base.fitted.prediction_squared, effect_shapes(base));
  const DiagnosisOptions& options = diagnosis.options;
  Calibrating simulated;
  for (const int count :
       {std::min(options.first_simulated, options.simulated), options.simulated}) {
    simulated.simulate(base, static_cast<std::size_t>(count), progress);
    diagnosis.structure =
        judge_structure(statistics, base.first.residuals, statistics(simulated.residuals));
    if (diagnosis.structure.p_value > options.clearly_above) break;
  }
  diagnosis.structure.failed = static_cast<int>(simulated.tried - simulated.residuals.size());
  diagnosis.free_form = statistics.free_form(base.first.residuals);
  diagnosis.free_form_p = diagnosis.structure.p_value;
  if (!diagnosis.free_form.empty()) {
    Refit without = base.first;
    for (std::size_t i = 0; i < without.residuals.size(); ++i) {
      without.residuals[i] -= diagnosis.free_form[i];
    }
    diagnosis.free_form_p = quick_p_value(base, without);
  }
  Eigen::MatrixXd residuals(static_cast<Eigen::Index>(base.fitted.data.points.size()),
                            static_cast<Eigen::Index>(simulated.residuals.size()));
  for (Eigen::Index b = 0; b < residuals.cols(); ++b) {
    residuals.col(b) = Eigen::Map<const Eigen::VectorXd>(
        simulated.residuals[static_cast<std::size_t>(b)].data(), residuals.rows());
  }
  return residuals;
}

bool beyond_a_sharp_limit(const CandidateResult& c) {
  return std::ranges::any_of(
      c.parameters, [](const FoundParameter& p) { return p.limit != nullptr && p.limit->sharp; });
}

/// Is it a possible cause that fits better than the base model?
bool may_act(const CandidateResult& c) {
  return c.near_plausible && may_be_a_cause(c) && c.delta_aicc < 0.0;
}

/// Is it a cause that only its impossible size excludes? Limits of what is possible are not known
/// so well that they alone could decide between causes that fit alike.
bool only_its_size_is_wrong(const CandidateResult& c) {
  return c.set_aside == SetAside::not_possible && c.remaining_p >= tolerated_level;
}

/// The best explanation among `candidates` (sorted, best first) and its rivals, which cannot be
/// distinguished from it, those of impossible size included; empty without an explanation.
std::vector<const CandidateResult*> explanations(const std::vector<CandidateResult>& candidates,
                                                 double margin, bool one_size) {
  const auto best = std::ranges::find_if(candidates, &CandidateResult::explains);
  if (best == candidates.end()) return {};
  std::vector<const CandidateResult*> found = {&*best};
  for (const CandidateResult& c : candidates) {
    if (c.delta_aicc > best->delta_aicc + margin) break;
    if (&c == &*best) continue;
    // If a candidate is as good as the best explanation, the other reasons to set it aside are
    // doubtful. If the best is plausible only within its error, the distance of others from their
    // ranges does not count.
    const bool near = c.near_plausible || (best->only_by_error && !beyond_a_sharp_limit(c));
    const bool possible = near && may_be_a_cause(c) && c.delta_aicc < 0.0;
    const bool pair = c.candidate.added.size() > 1;
    if (one_size || pair ? c.explains() : possible || only_its_size_is_wrong(c)) {
      found.push_back(&c);
    }
  }
  return found;
}

/// The cause of which all of them, each a single mechanism, are laws; empty if there is none.
std::string shared_cause(const std::vector<const CandidateResult*>& found) {
  std::set<std::string> causes;
  for (const CandidateResult* c : found) {
    const auto& added = c->candidate.added;
    causes.emplace(added.size() == 1 ? find_mechanism(added.front())->info.cause : "");
  }
  return causes.size() == 1 ? *causes.begin() : std::string();
}

/// The answer for several explanations that cannot be distinguished, the best first.
NotSeparable several(const std::vector<const CandidateResult*>& found, bool one_size) {
  NotSeparable answer;
  for (const CandidateResult* c : found) {
    if (c->candidate.added.size() < found.front()->candidate.added.size()) {
      answer.alone.push_back(c->candidate.added.front());
    }
    for (const std::string& id : c->candidate.added) {
      auto& rivals = answer.rivals;
      if (std::ranges::find(rivals, id) == rivals.end()) rivals.push_back(id);
    }
  }
  if (one_size) return answer;  // it identifies neither a cause nor what causes have in common
  for (const std::string& id : answer.rivals) {
    if (std::ranges::all_of(found, [&](const auto* c) { return c->candidate.adds(id); })) {
      answer.common.push_back(id);
    }
  }
  answer.shared_cause = shared_cause(found);
  return answer;
}

std::vector<CaptureChange> compare_capture(const FitResult& base, const FitResult& extended) {
  std::set<std::pair<std::size_t, double>> sizes;
  for (const Observation& point : base.data.points) sizes.insert({point.dataset, point.diameter});
  std::vector<CaptureQuery> queries;
  for (const auto& [dataset, diameter] : sizes) {
    if (!without_adhesion(base.model, dataset)) queries.push_back({dataset, diameter, 0.0});
  }
  const auto before = capture_velocities(base.model, base.theta, queries);
  const auto after = capture_velocities(extended.model, extended.theta, queries);
  std::vector<CaptureChange> changes;
  for (std::size_t k = 0; k < queries.size(); ++k) {
    CaptureChange change{queries[k].dataset, queries[k].diameter, {}, {}};
    if (before[k].found) change.base = before[k].value;
    if (after[k].found) change.extended = after[k].value;
    changes.push_back(change);
  }
  return changes;
}

std::vector<IntervalSet> intervals_of_fit(const FitResult& fitted, const SearchBase& base) {
  UncertaintyOptions options;
  options.replicates = fitted.data.noise.sd_stated ? 0 : 199;
  options.level = base.spec.uncertainty.level;
  options.seed = base.options.seed;
  options.threads = base.options.threads;
  std::vector<IntervalSet> intervals =
      likelihood_intervals(fit_alternatives(fitted), options.level, options.threads);
  add_resampled_intervals(fitted, bootstrap(fitted, {}, options), options.level, options.threads,
                          intervals);
  return intervals;
}

/// The base model extended by `cause`, fitted as `fit` does.
ExtendedModel extended_by(const CandidateResult& cause, const SearchBase& base,
                          const std::vector<IntervalSet>& base_intervals) {
  ExtendedModel extended;
  extended.cause = cause;
  if (base.options.answer_alone) return extended;
  FitOptions options;
  options.several_starts = false;
  options.start = cause.refit.theta;
  FitResult fitted = fit(cause.candidate.model, gather(base.datasets, base.spec), options);
  if (!fitted.usable) {
    extended.failure = fitted.failure;
    return extended;
  }
  extended.base_intervals =
      base_intervals.empty() ? intervals_of_fit(base.fitted, base) : base_intervals;
  extended.intervals = intervals_of_fit(fitted, base);
  extended.capture = compare_capture(base.fitted, fitted);
  extended.fit = std::move(fitted);
  return extended;
}

/// Do unstated errors leave no structure and fit so well that no cause can be identified? They must
/// be better than a single cause by `margin`. Compared with a pair they may be worse by 2 ln N,
/// which is about what chance gives the best of N independent pairs. Errors of readings of a scale
/// always exist, so they need only be as close as a rival.
bool errors_fit_better(const CandidateResult& best, const Diagnosis& diagnosis, double margin) {
  const bool pair = best.candidate.added.size() > 1;
  const double lead = pair ? -2.0 * std::log(static_cast<double>(diagnosis.pairs.size())) : margin;
  return std::ranges::any_of(diagnosis.unstated, [&](const UnstatedErrors& errors) {
    const double ahead = errors.of_readings() ? lead - 2.0 * margin : lead;
    return errors.leave_nothing() && errors.delta_aicc + ahead < best.delta_aicc;
  });
}

/// Does the best single candidate gain more than chance explains?
bool gains_more_than_chance(const Diagnosis& diagnosis) {
  return !diagnosis.candidates.empty() &&
         diagnosis.candidates.front().p_value <= diagnosis.options.chance;
}

/// Is it set aside only for an implausible value, or because an unknown law of size, or rounding,
/// has the same effect?
bool only_resembles(const CandidateResult& c) {
  return (c.set_aside == SetAside::not_possible && !c.near_plausible) ||
         c.set_aside == SetAside::batch_is_size || c.set_aside == SetAside::within_a_step;
}

/// Is the best explanation excluded by a better, but implausible candidate? Limits must not promote
/// a worse cause: a plausible cause explains only if it is at most `margin` worse than the
/// implausible one, and a pair, which has many rivals, only if it is better by `lead`.
bool impossible_fits_better(const CandidateResult& best, const CandidateResult& impossible,
                            double margin, double lead) {
  const bool pair = best.candidate.added.size() > 1;
  return best.delta_aicc > impossible.delta_aicc + (pair ? -lead : margin);
}

/// Does a pair with a parameter at its limit fit better by `lead`? Then no cause is named, as with
/// single causes.
bool pair_at_limit_fits_better(const CandidateResult& best,
                               const std::vector<CandidateResult>& pairs, double lead) {
  return std::ranges::any_of(pairs, [&](const CandidateResult& c) {
    return c.set_aside == SetAside::at_limit && c.delta_aicc < best.delta_aicc - lead;
  });
}

/// Adds single causes whose criterion is within `lead` of the best pair in `found`: rivals although
/// they leave structure, because a law that is wrong by more than its allowed error is as likely.
/// The members of the pair are excluded; they were judged with it.
void add_close_singles(const std::vector<CandidateResult>& singles, double lead, double chance,
                       std::vector<const CandidateResult*>& found) {
  const CandidateResult& best = *found.front();
  for (const CandidateResult& c : singles) {
    const bool possible = c.near_plausible && may_be_a_cause(c) && c.p_value <= chance;
    const bool other = !best.candidate.adds(c.candidate.added.front());
    if (possible && other && c.delta_aicc <= best.delta_aicc + lead) found.push_back(&c);
  }
}

/// Is there a plausible cause that fits at least as well as `impossible`, although it is set aside
/// for another reason?
bool plausible_cause_fits_as_well(const std::vector<CandidateResult>& candidates,
                                  const CandidateResult& impossible, double chance) {
  return std::ranges::any_of(candidates, [&](const CandidateResult& c) {
    return c.plausible && c.kind != MechanismKind::description && !only_resembles(c) &&
           c.p_value <= chance && c.delta_aicc <= impossible.delta_aicc;
  });
}

/// The `candidates`, the best first, for which `holds` and that cannot be distinguished from the
/// best of these.
template <class Holds>
std::vector<const CandidateResult*> best_where(const Holds& holds,
                                               const std::vector<CandidateResult>& candidates,
                                               double margin) {
  std::vector<const CandidateResult*> found;
  double best = INFINITY;
  for (const CandidateResult& c : candidates) {
    if (!holds(c)) continue;
    best = std::min(best, c.delta_aicc);
    if (c.delta_aicc <= best + margin) found.push_back(&c);
  }
  return found;
}

std::vector<std::string> ids_of(const std::vector<const CandidateResult*>& singles) {
  std::vector<std::string> ids;
  for (const CandidateResult* c : singles) ids.push_back(c->candidate.added.front());
  return ids;
}

/// Step 4 for pairs of causes, with the single causes that are as close.
std::vector<const CandidateResult*> explanations_by_pairs(const SearchBase& base,
                                                          const std::vector<Fold>& folds,
                                                          double margin, bool one_size,
                                                          Diagnosis& diagnosis) {
  diagnosis.pairs = try_pairs(base, diagnosis.candidates);
  judge(base, diagnosis.pairs, margin, folds);
  std::vector<const CandidateResult*> found = explanations(diagnosis.pairs, margin, one_size);
  if (found.empty() || pair_at_limit_fits_better(*found.front(), diagnosis.pairs, margin))
    return {};
  add_close_singles(diagnosis.candidates, margin, base.options.chance, found);
  return found;
}

Eigen::MatrixXd matrix_of(const Samples& samples) {
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(samples.front().size()),
                          static_cast<Eigen::Index>(samples.size()));
  for (std::size_t b = 0; b < samples.size(); ++b) {
    columns.col(static_cast<Eigen::Index>(b)) =
        Eigen::Map<const Eigen::VectorXd>(samples[b].data(), columns.rows());
  }
  return columns;
}

/// Do errors of the laws, of a larger size than the smallest, leave no structure?
bool law_errors_suffice(const SearchBase& base) {
  return base.refit.law_error > base.first.law_error &&
         quick_p_value(base, base.refit) > base.options.level;
}

/// The first causes that experiments shall tell apart.
std::vector<const CandidateResult*> first_of(std::vector<const CandidateResult*> causes) {
  constexpr std::size_t most_causes = 3;
  causes.resize(std::min(causes.size(), most_causes));
  return causes;
}

/// Experiments that tell these causes from each other and from an error of the laws.
NextExperiments experiments_against_law_error(const SearchBase& base,
                                              std::vector<CandidateResult> causes) {
  CandidateResult none;  // its criterion is the zero of the others
  none.candidate = base.candidate;
  none.refit = base.refit;
  causes.push_back(std::move(none));
  std::ranges::stable_sort(causes, {}, &CandidateResult::delta_aicc);
  std::vector<const CandidateResult*> rivals;
  for (const CandidateResult& one : causes) rivals.push_back(&one);
  return next_experiments(base, rivals);
}

/// The answer if an error of the laws explains the structure: the possible causes that explain it
/// better than no error, if there are any, are its rivals.
DiagnosisAnswer with_law_error(const SearchBase& base,
                               const std::vector<IntervalSet>& base_intervals, double margin,
                               Diagnosis& diagnosis) {
  const std::vector<const CandidateResult*> close =
      best_where(may_act, diagnosis.candidates, margin);
  if (close.empty()) return Adequate{};
  NotSeparable answer;
  answer.law_error = true;
  answer.rivals = ids_of(close);
  answer.extended = extended_by(*close.front(), base, base_intervals);
  if (!base.options.answer_alone) {
    std::vector<CandidateResult> causes;
    for (const CandidateResult* cause : first_of(close)) causes.push_back(*cause);
    diagnosis.next = experiments_against_law_error(base, std::move(causes));
  }
  return answer;
}

/// The answer if no cause explains the structure.
DiagnosisAnswer without_a_cause(const SearchBase& base,
                                const std::vector<IntervalSet>& base_intervals, double margin,
                                Diagnosis& diagnosis) {
  const std::vector<CandidateResult>& candidates = diagnosis.candidates;
  const auto impossible = std::ranges::find_if(candidates, only_resembles);
  const bool has_impossible = impossible != candidates.end();
  if (law_errors_suffice(base) && !(has_impossible && impossible->delta_aicc < -margin)) {
    return with_law_error(base, base_intervals, margin, diagnosis);
  }
  if (!has_impossible ||
      plausible_cause_fits_as_well(candidates, *impossible, base.options.chance)) {
    return Unexplained{};
  }
  return Resembles{ids_of(best_where(only_resembles, candidates, margin))};
}

/// Steps 2 to 5.
/// @param simulated residuals of the calibrating data sets [points x data sets]
DiagnosisAnswer search(const SearchBase& base, const Eigen::MatrixXd& simulated,
                       const std::vector<IntervalSet>& base_intervals, Diagnosis& diagnosis) {
  const DiagnosisOptions& options = base.options;
  diagnosis.candidates = try_singles(base);
  const bool same_laws = base.refit.law_error == base.first.law_error;
  calibrate(base, diagnosis.candidates, same_laws ? simulated : matrix_of(base.noise));
  const std::vector<Fold> folds =
      held_out_folds(base.fitted.data, base.datasets.size(), base.candidate.free_count + 1);
  const bool one_size = has_one_size(base.fitted.data);
  const double margin = one_size ? margin_at_one_size : options.margin;
  const double margin_in_pairs = std::max(margin, options.margin_in_pairs);
  judge(base, diagnosis.candidates, margin, folds);
  if (!options.answer_alone) separate(base, diagnosis.candidates);
  diagnosis.unstated = unstated_errors(base);
  const auto impossible = std::ranges::find_if(diagnosis.candidates, only_resembles);
  const bool has_impossible = impossible != diagnosis.candidates.end();
  const auto nothing_explains = [&](const std::vector<const CandidateResult*>& found) {
    return found.empty() || (has_impossible && impossible_fits_better(*found.front(), *impossible,
                                                                      margin, margin_in_pairs));
  };
  std::vector<const CandidateResult*> found = explanations(diagnosis.candidates, margin, one_size);
  if (nothing_explains(found) && !options.single_causes && gains_more_than_chance(diagnosis)) {
    found = explanations_by_pairs(base, folds, margin_in_pairs, one_size, diagnosis);
  }
  // An error of the laws is the simpler answer unless a cause is clearly better.
  const bool clearly = !found.empty() && found.front()->delta_aicc < -margin;
  if (nothing_explains(found) || (!clearly && law_errors_suffice(base))) {
    return without_a_cause(base, base_intervals, margin, diagnosis);
  }
  const CandidateResult& best = *found.front();
  if (errors_fit_better(best, diagnosis, margin)) return ErrorsTooSmall{best.candidate.name()};
  ExtendedModel extended = extended_by(best, base, base_intervals);
  if (found.size() == 1 && !one_size) return CauseNamed{std::move(extended)};
  NotSeparable answer = several(found, one_size);
  if (!options.answer_alone) diagnosis.next = next_experiments(base, found);
  answer.extended = std::move(extended);
  return answer;
}

/// Is the model adequate only because of the errors of its material constants?
std::optional<MaterialsExplain> materials_explain(const Diagnosis& diagnosis) {
  if (diagnosis.base.model.constants.empty()) return std::nullopt;
  FitSpec exact = diagnosis.spec;
  exact.uncertainty.materials = Materials::exact;
  const FitResult fitted =
      fit(make_model(exact, diagnosis.datasets), gather(diagnosis.datasets, exact.noise));
  if (!fitted.usable) return std::nullopt;
  const SearchBase base = search_base(exact, diagnosis.datasets, fitted, diagnosis.options);
  if (!base.refit.usable) return std::nullopt;
  const double p_value = quick_p_value(base, base.first);
  if (p_value > diagnosis.options.level) return std::nullopt;
  return MaterialsExplain{p_value};
}

/// Steps 1 to 5 on all points of `base`.
Diagnosis diagnose_all(const SearchBase& base, const std::vector<IntervalSet>& base_intervals) {
  const DiagnosisOptions& options = base.options;
  Diagnosis diagnosis;
  diagnosis.options = options;
  diagnosis.spec = base.spec;
  diagnosis.datasets = base.datasets;
  diagnosis.base = base.fitted;
  diagnosis.expected = expected_effects(base);
  Progress progress("diagnosis", options.pieces());
  const Eigen::MatrixXd simulated = test_base(base, diagnosis, progress);
  diagnosis.where = misfit_map(diagnosis.base);
  if (diagnosis.structure.p_value > options.level) {
    diagnosis.answer = options.answer_alone ? Adequate{} : Adequate{materials_explain(diagnosis)};
  } else {
    diagnosis.answer = search(base, simulated, base_intervals, diagnosis);
  }
  return diagnosis;
}

/// Experiments that tell the causes of exact laws from each other and from an error of the laws.
/// @param close those causes, as exact laws fit them
NextExperiments experiments_on_a_hint(const SearchBase& allowed,
                                      const std::vector<const CandidateResult*>& close) {
  std::vector<CandidateResult> causes;
  for (const CandidateResult* cause : first_of(close)) {
    causes.push_back(try_one(allowed, cause->candidate, cause->refit.theta, 0));
    if (!causes.back().refit.usable) causes.pop_back();
  }
  if (causes.empty()) return {};
  return experiments_against_law_error(allowed, std::move(causes));
}

/// Adds what exact laws leave and, if it has structure, the answer of steps 1 to 5 with them for
/// single causes; unless a cause is named without them. Where an error of the laws explains as much
/// as any cause, the closest causes are those of its search.
void add_exact_answer(const SearchBase& allowed, Diagnosis& diagnosis) {
  if (allowed.options.answer_alone || diagnosis.answer_if<CauseNamed>()) return;
  if (!(allowed.first.law_error > 0.0)) return;
  FitSpec spec = allowed.spec;
  spec.law_error = 0.0;
  DiagnosisOptions options = allowed.options;
  options.answer_alone = options.single_causes = true;
  options.kept.reset();  // their pieces are others
  const SearchBase base = with_exact_laws(allowed, spec, options);
  if (!base.refit.usable) return;
  IfExact& found = diagnosis.if_exact.emplace();
  found.p_value = quick_p_value(base, base.refit);
  if (found.p_value > options.level) return;
  const Diagnosis exact = diagnose_all(base, {});
  const auto* const several = diagnosis.answer_if<NotSeparable>();
  const bool law_error_competes =
      !diagnosis.candidates.empty() &&
      (diagnosis.answer_if<Adequate>() || (several && several->law_error));
  const std::vector<CandidateResult>& candidates =
      law_error_competes ? diagnosis.candidates : exact.candidates;
  const double margin = has_one_size(base.fitted.data) ? margin_at_one_size : options.margin;
  const std::vector<const CandidateResult*> close = best_where(may_act, candidates, margin);
  found.named = exact.named();
  found.listed = ids_of(close);
  const bool no_cause = diagnosis.rivals().empty() && diagnosis.resembles().empty();
  if (no_cause && !has_one_size(base.fitted.data)) {
    diagnosis.next = experiments_on_a_hint(allowed, close);
  }
}

/// Returns `fitted`, the fit of `spec`.
/// @throws ComputationError if it is not usable
FitResult usable(const FitSpec& spec, FitResult fitted) {
  if (fitted.usable) return fitted;
  throw ComputationError(
      fmt::format("{}: the fit has no usable answer: {}", spec.file.string(), fitted.failure));
}

/// The fit as stated; `answer_alone` leaves out the error of the laws, which the answer repeats.
FitResult usable_fit(const FitSpec& spec, const std::vector<Dataset>& datasets) {
  return usable(spec,
                fit_as_stated(spec, make_model(spec, datasets), gather(datasets, spec.noise)));
}

/// The fit that a diagnosis starts from: with exact laws, and constants that the points move.
FitResult base_fit(const FitSpec& spec, const std::vector<Dataset>& datasets,
                   const FitResult& fitted) {
  const FitResult& exact = with_laws_exact(fitted);
  if (exact.model.constants.empty() || exact.model.adjusts_constants()) {
    FitResult base = exact;
    base.laws.clear();
    return base;
  }
  return usable(spec, fit(with_adjusted_materials(exact.model), gather(datasets, spec.noise)));
}

/// @throws ComputationError if the fit cannot be repeated from its own result
std::unique_ptr<DiagnosedData> all_points(const FitSpec& spec, const std::vector<Dataset>& datasets,
                                          const FitResult& fitted,
                                          const DiagnosisOptions& options) {
  auto all = std::make_unique<DiagnosedData>(spec, datasets, fitted, options);
  if (all->base.refit.usable) return all;
  throw ComputationError(
      fmt::format("{}: the fit cannot be repeated from its own answer", spec.file.string()));
}

/// The data without the points `outlying`, refitted; null if there are none or if the fit fails.
std::unique_ptr<DiagnosedData> other_points(const DiagnosedData& all,
                                            const std::vector<OutlyingPoint>& outlying) {
  if (outlying.empty()) return nullptr;
  const std::vector<Dataset> others = without_points(all.datasets, outlying);
  const FitResult refitted = fit(make_model(all.spec, others), gather(others, all.spec));
  if (!refitted.usable) return nullptr;
  DiagnosisOptions options = all.options;
  options.first_piece += options.pieces();
  auto data = std::make_unique<DiagnosedData>(all.spec, others, refitted, options);
  return data->base.refit.usable ? std::move(data) : nullptr;
}

}  // namespace

Diagnosis diagnose(const FitSpec& stated, const std::vector<Dataset>& datasets,
                   const DiagnosisOptions& options) {
  const FitSpec spec = options.answer_alone ? with_constants_adjusted(stated) : stated;
  return diagnose(spec, datasets, usable_fit(spec, datasets), options);
}

Diagnosis diagnose(const FitSpec& stated, const std::vector<Dataset>& datasets,
                   const FitResult& fitted, const DiagnosisOptions& options,
                   const std::vector<IntervalSet>& base_intervals) {
  const FitSpec spec = with_constants_adjusted(stated);
  const FitResult start = base_fit(spec, datasets, fitted);
  const bool same_fit = fitted.laws.empty() && start.theta == fitted.theta;
  const auto all = all_points(spec, datasets, start, options);
  const std::vector<OutlyingPoint> outlying = outlying_points(all->base);
  Diagnosis for_all =
      diagnose_all(all->base, same_fit ? base_intervals : std::vector<IntervalSet>());
  for_all.fitted = std::make_shared<const FitResult>(fitted);
  // Errors that all points have may also make points outlie, and are the simpler answer.
  const bool errors_do = std::ranges::any_of(for_all.unstated, &UnstatedErrors::leave_nothing);
  const auto others = errors_do ? nullptr : other_points(*all, outlying);
  if (!others) {
    add_exact_answer(all->base, for_all);
    return for_all;
  }
  Diagnosis diagnosis = diagnose_all(others->base, {});
  add_exact_answer(others->base, diagnosis);
  diagnosis.fitted = for_all.fitted;
  diagnosis.outlying = outlying;
  diagnosis.for_all =
      AnswerForAll{for_all.verdict(), for_all.named(), for_all.rivals(), for_all.resembles()};
  return diagnosis;
}

Calibration::Calibration(const FitSpec& stated, const std::vector<Dataset>& datasets,
                         const DiagnosisOptions& options) {
  const FitSpec spec = with_constants_adjusted(stated);
  DiagnosisOptions own = options;
  own.kept.reset();
  data_.push_back(all_points(spec, datasets, usable_fit(spec, datasets), own));
  auto others = other_points(*data_.front(), outlying_points(data_.front()->base));
  if (others) data_.push_back(std::move(others));
}

Calibration::~Calibration() = default;

std::size_t Calibration::pieces() const { return data_.size() * data_.front()->options.pieces(); }

std::vector<double> Calibration::run(std::size_t piece) const {
  const std::size_t of_each = data_.front()->options.pieces();
  return calibration_row(residuals_of_sample(data_[piece / of_each]->base, piece % of_each));
}

std::string Calibration::digits() const {
  std::string digits;
  for (const auto& data : data_) {
    for (const double value : data->base.refit.theta) digits += fmt::format("{:a}|", value);
    for (const double value : data->base.refit.residuals) digits += fmt::format("{:a}|", value);
    digits += fmt::format("{:a};", data->base.criterion);
  }
  return digits;
}

}  // namespace recoil
