#include "diagnosis/search.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "diagnosis/batches.hpp"
#include "diagnosis/plausibility.hpp"
#include "estimate/point_conditions.hpp"
#include "estimate/predictor.hpp"
#include "estimate/residual.hpp"
#include "estimate/shared_settings.hpp"
#include "estimate/simulated_observation.hpp"

namespace recoil {
namespace {

constexpr int tries_alone = 4;
constexpr int tries_in_pairs = 2;
constexpr std::size_t sets_at_once = 13;    // between two looks at how many gain more
constexpr std::ptrdiff_t often_enough = 5;  // to say that chance gives as much
constexpr double worth_releasing = 2.0;     // gain of the criterion by a released parameter
constexpr double followed_within = 30.0;  // of the best pair at the first look, a pair is followed,
constexpr double followed_part = 0.2;     // or within this part of what that one gains
constexpr double carried_part = 0.1;  // what each of two has to take, for the two to be forgiven

MechanismKind kind_of(const std::vector<std::string>& ids) {
  MechanismKind kind = MechanismKind::measurement;
  for (const Mechanism* mechanism : chain_of(ids)) {
    if (mechanism->info.kind == MechanismKind::description) return MechanismKind::description;
    if (mechanism->info.kind == MechanismKind::physics) kind = MechanismKind::physics;
  }
  return kind;
}

std::vector<double> predicted_squares(const Candidate& candidate, const Refit& refit,
                                      const Observations& data) {
  std::vector<double> squares;
  for (const Prediction& at : predict(candidate.model, refit.theta, data.conditions(), false)) {
    squares.push_back(at.restitution_squared);
  }
  return squares;
}

/// See `CandidateResult::remaining_part`.
double part_left(const SearchBase& base, const CandidateResult& candidate) {
  if (!base.fitted.data.sd_stated) return 1.0;  // nobody knows how much misfit there is
  const auto n = static_cast<double>(base.fitted.data.points.size());
  const double before = base.refit.chi2 - (n - base.candidate.free_count);
  const double after = candidate.refit.chi2 - (n - candidate.candidate.free_count);
  return before > 0.0 ? after / before : 1.0;
}

/// What a fitted candidate gains and leaves.
CandidateResult examine(const SearchBase& base, Candidate candidate, Refit refit) {
  const Observations& data = base.fitted.data;
  CandidateResult result;
  result.candidate = std::move(candidate);
  result.kind = kind_of(result.candidate.added);
  result.refit = std::move(refit);
  if (!result.refit.usable) return result;
  result.delta_aicc =
      corrected_criterion(data, result.refit, result.candidate.free_count) - base.criterion;
  result.parameters = found_parameters(result.candidate, result.refit, base.noise_scale);
  result.plausible = std::all_of(result.parameters.begin(), result.parameters.end(),
                                 [](const FoundParameter& p) { return p.plausible(); });
  result.near_plausible = std::all_of(result.parameters.begin(), result.parameters.end(),
                                      [](const FoundParameter& p) { return p.near_plausible; });
  const std::vector<double> squares = predicted_squares(result.candidate, result.refit, data);
  result.remaining_p =
      quick_structure(data, result.refit, squares, quick_samples, base.options.seed).p_value;
  result.remaining_part = part_left(base, result);
  return result;
}

CandidateResult try_one(const SearchBase& base, Candidate candidate, std::span<const double> near,
                        int tries) {
  Refit refit =
      with_law_errors(candidate, base.fitted.data,
                      refit_candidate(candidate, base.fitted.data, near, tries), base.laws);
  return examine(base, std::move(candidate), std::move(refit));
}

std::vector<double> within_bounds(const ImpactModel& model, std::vector<double> theta) {
  for (std::size_t j = 0; j < theta.size(); ++j) {
    const ParameterSlot& slot = model.slots[j];
    if (slot.free) theta[j] = std::clamp(theta[j], slot.lower, slot.upper);
  }
  return theta;
}

/// Does a free parameter of an added mechanism rest on a bound? Exponents may.
bool rests_on_the_edge(const CandidateResult& result) {
  for (std::size_t j = 0; j < result.refit.theta.size(); ++j) {
    const ParameterSlot& slot = result.candidate.model.slots[j];
    // One that the catalogue holds fixed may rest there.
    const bool own = result.candidate.adds(slot) && slot.parameter->free;
    if (own && slot.free && !result.refit.moving[j]) return true;
  }
  return false;
}

bool can_be_released(const Candidate& candidate) {
  return std::any_of(
      candidate.model.slots.begin(), candidate.model.slots.end(), [&](const ParameterSlot& slot) {
        return !slot.free && !slot.stated && slot.parameter->searched && candidate.adds(slot);
      });
}

/// The same with released parameters, if that is worth it.
void try_released(const SearchBase& base, CandidateResult& result, int tries) {
  if (!result.refit.usable || !can_be_released(result.candidate)) return;
  // A single one may want to be what it cannot be, and is to say so.
  const bool pair = result.candidate.added.size() > 1;
  Candidate released = make_candidate(base.spec, base.datasets, result.candidate.added, true, pair);
  const std::vector<double> near = within_bounds(
      released.model, carried_over(result.candidate.model, result.refit.theta, released.model));
  CandidateResult other = try_one(base, std::move(released), near, tries);
  if (other.refit.usable && other.delta_aicc < result.delta_aicc - worth_releasing) {
    result = std::move(other);
  }
}

void sort_by_criterion(std::vector<CandidateResult>& candidates) {
  std::erase_if(candidates, [](const CandidateResult& c) { return !c.refit.usable; });
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const CandidateResult& a, const CandidateResult& b) {
                     return a.delta_aicc < b.delta_aicc;
                   });
}

bool spreads(const CandidateResult& single) {
  return find_mechanism(single.candidate.added.front())->spreads();
}

/// Two mechanisms at once as a first look has them: nothing released, and the errors of laws seen
/// where the descents without them end.
struct FirstLook {
  const CandidateResult* first = nullptr;
  const CandidateResult* second = nullptr;
  Candidate both{};
  Refit refit{};
  /// Change of the criterion at most: two do no worse than the better one alone.
  double delta_aicc = INFINITY;
};

/// By a descent from the fit of either alone.
void look_at(const SearchBase& base, FirstLook& look) {
  look.both = make_candidate(
      base.spec, base.datasets,
      {look.first->candidate.added.front(), look.second->candidate.added.front()}, false, true);
  const Observations& data = base.fitted.data;
  if (look.both.free_count >= static_cast<int>(data.points.size()) - 2) return;
  for (const CandidateResult* from : {look.first, look.second}) {
    const std::vector<double> near = within_bounds(
        look.both.model, carried_over(from->candidate.model, from->refit.theta, look.both.model));
    Refit refit = refit_candidate(look.both, data, near, 1);
    if (refit.usable && !(look.refit.usable && look.refit.chi2 <= refit.chi2)) {
      look.refit = std::move(refit);
    }
  }
  look.delta_aicc = std::min(look.first->delta_aicc, look.second->delta_aicc);
  const Refit seen = under_law_errors(look.both, data, look.refit, base.laws);
  if (!seen.usable) return;
  look.delta_aicc = std::min(
      look.delta_aicc, corrected_criterion(data, seen, look.both.free_count) - base.criterion);
}

/// A pair that is further behind at the first look does not come near the best in the end: of 460
/// pairs for wall1990-molybdenum and wall1990-silicon none gained more than a third of its change
/// of the criterion by what follows, and none of the best ten more than a twentieth.
double worth_following(const std::vector<FirstLook>& looks) {
  double best = 0.0;
  for (const FirstLook& look : looks) best = std::min(best, look.delta_aicc);
  return best + std::max(followed_within, followed_part * -best);
}

/// What it is in the end.
CandidateResult try_both(const SearchBase& base, FirstLook look, bool follow) {
  const CandidateResult& first = *look.first;
  const CandidateResult& second = *look.second;
  const Observations& data = base.fitted.data;
  if (!follow) {
    Refit refit = under_law_errors(look.both, data, std::move(look.refit), base.laws);
    CandidateResult result = examine(base, std::move(look.both), std::move(refit));
    result.set_aside = SetAside::far_behind;
    return result;
  }
  Refit refit = with_law_errors(look.both, data, std::move(look.refit), base.laws);
  CandidateResult result = examine(base, std::move(look.both), std::move(refit));
  try_released(base, result, tries_in_pairs);
  // Each has to carry its part.
  const double better = std::min(first.delta_aicc, second.delta_aicc);
  const bool possible = first.delta_aicc < second.delta_aicc ? first.plausible : second.plausible;
  if (possible && !(result.delta_aicc < better - base.options.margin_in_pairs)) {
    result.set_aside = SetAside::one_would_do;
  }
  const double better_part = std::min(first.remaining_part, second.remaining_part);
  if (result.remaining_p < tolerated_level && better_part - result.remaining_part < carried_part) {
    result.set_aside = SetAside::one_hardly_takes_part;
  }
  if (rests_on_the_edge(result)) {
    result.set_aside = SetAside::at_the_edge;
  }
  return result;
}

/// The fit with an error of settings that no smooth law could explain: the one that it estimated
/// takes up whatever the base model gets wrong, and would hide it.
FitResult with_rough_settings(const FitSpec& spec, const std::vector<Dataset>& datasets,
                              const FitResult& fitted) {
  const Observations& data = fitted.data;
  if (!data.setting_sd_estimated || !(data.noise.setting_sd > 0.0)) return fitted;
  const int free = fitted.model.free_count();
  const Eigen::MatrixXd smooth = smooth_functions(data);
  const Eigen::Index half = (count_settings(data).settings - free) / 2;
  if (half < 1) return fitted;
  std::vector<std::vector<double>> trends;
  for (Eigen::Index k = 0; k < std::min<Eigen::Index>(half, smooth.cols()); ++k) {
    trends.emplace_back(smooth.col(k).begin(), smooth.col(k).end());
  }
  const double rough = estimated_setting_error(data, fitted.prediction_squared, free, trends);
  NoiseSpec noise = spec.noise;
  noise.setting_sd = std::min(rough, data.noise.setting_sd);
  FitOptions options;
  options.several_starts = false;
  options.start = fitted.theta;
  FitResult again = fit(fitted.model, gather(datasets, noise), options);
  return again.usable ? again : fitted;
}

}  // namespace

SearchBase search_base(const FitSpec& spec, const std::vector<Dataset>& datasets,
                       const FitResult& estimated, const DiagnosisOptions& options) {
  SearchBase base{spec,
                  datasets,
                  with_rough_settings(spec, datasets, estimated),
                  {},
                  make_candidate(spec, datasets, {}),
                  {},
                  0.0,
                  1.0,
                  options};
  const FitResult& fitted = base.fitted;
  base.laws = {spec.law_error, law_error_of_base * spec.law_error, smooth_functions(fitted.data)};
  base.candidate.model.solver = fitted.model.solver;
  base.refit =
      with_law_errors(base.candidate, fitted.data,
                      refit_candidate(base.candidate, fitted.data, fitted.theta, 1), base.laws);
  base.criterion = corrected_criterion(fitted.data, base.refit, base.candidate.free_count);
  if (!fitted.data.sd_stated) base.noise_scale = fitted.noise_scale;
  return base;
}

namespace {

/// All impacts of `point` were captured, and of their scatter nothing is known: where the model has
/// them come back, the error of e decides (see `weighted_residual`).
void draw_capture(Observation& point, double square, RandomStream& random) {
  const double sd = point.weights.sd;
  const double error = std::hypot(std::sqrt(2.0) * sd * sd, point.weights.input_sd);
  const double reading = std::sqrt(std::max(square, 0.0)) + sd * random.normal();
  if (!(square + error * random.normal() > 0.0) || !(reading > 0.0)) return;
  point.censored = false;
  point.captured = 0;
  point.restitution = reading;
}

}  // namespace

Observations simulate_base(const SearchBase& base, std::uint64_t index) {
  RandomStream random(base.options.seed, RandomPurpose::diagnosis, index);
  Eigen::VectorXd bend = Eigen::VectorXd::Zero(base.laws.functions.cols());
  for (double& weight : bend) weight = random.normal();
  const Eigen::VectorXd wrong_by = base.laws.base * (base.laws.functions * bend);
  Observations sample = base.fitted.data;
  RandomStream of_settings(base.options.seed, RandomPurpose::settings, index);
  const std::vector<double> shared = draw_setting_errors(sample, of_settings);
  for (std::size_t i = 0; i < sample.points.size(); ++i) {
    Observation& point = sample.points[i];
    const double square = base.fitted.prediction_squared[i];
    const double loss = std::clamp(1.0 - square, 0.0, 1.0);
    const double bent = square + loss * wrong_by(static_cast<Eigen::Index>(i));
    point = simulate_observation(point, shifted_square(bent, shared[i]), base.noise_scale,
                                 sample.noise.student, random);
    if (point.weights.scatter > 0.0 && !point.censored) locate_peak(point);
    if (point.censored && !(point.weights.scatter > 0.0)) draw_capture(point, square, random);
  }
  return sample;
}

std::optional<PerValue<StructureQuestion, double>> structure_of_sample(
    const SearchBase& base, const StructureStatistics& statistics, std::uint64_t index) {
  if (const std::vector<double>* const row = base.options.row(index)) {
    if (row->size() == 1) return std::nullopt;
    PerValue<StructureQuestion, double> answer{};
    std::size_t at = 1;
    for (const StructureQuestion question : values_of<StructureQuestion>()) {
      answer[question] = row->at(at++);
    }
    return answer;
  }
  const Observations sample = simulate_base(base, index);
  const Refit refit =
      refit_candidate(base.candidate, sample, base.refit.theta, 1, base.refit.discrepancy);
  if (!refit.usable) return std::nullopt;
  return statistics(refit.residuals);
}

std::vector<CandidateResult> try_singles(const SearchBase& base) {
  std::vector<const Mechanism*> untried;
  for (const Mechanism* mechanism : mechanisms_that_may_act(base.spec, base.candidate.model)) {
    // Counts of captures have told the base model already how the impacts differ.
    if (mechanism->spreads() && base.fitted.data.noise.event_spread > 0.0) continue;
    untried.push_back(mechanism);
  }
  std::vector<CandidateResult> results(untried.size());
  parallel_over(untried.size(), base.options.threads, [&](std::size_t k) {
    Candidate candidate =
        make_candidate(base.spec, base.datasets, {std::string(untried[k]->info.id)});
    if (candidate.free_count >= static_cast<int>(base.fitted.data.points.size()) - 1) return;
    const std::vector<PointConditions>& impacts = candidate.impacts;
    if (std::all_of(impacts.begin(), impacts.end(), [&](const PointConditions& at) {
          return is_taken_away(candidate.model, *untried[k], at);
        })) {
      return;
    }
    const std::vector<double> near =
        carried_over(base.candidate.model, base.refit.theta, candidate.model);
    results[k] = try_one(base, std::move(candidate), near, tries_alone);
    try_released(base, results[k], tries_alone);
  });
  sort_by_criterion(results);
  return results;
}

double largest_gain(const SearchBase& base, const std::vector<CandidateResult>& candidates,
                    std::uint64_t index) {
  double most = -INFINITY;
  const Observations sample = simulate_base(base, index);
  const Refit alone =
      refit_candidate(base.candidate, sample, base.refit.theta, 1, base.refit.discrepancy);
  if (!alone.usable) return most;
  const double criterion = corrected_criterion(sample, alone, base.candidate.free_count);
  bool spread = false;
  for (const CandidateResult& c : candidates) {
    // One spread looks like the other, and takes nine times as long as anything else.
    if (spreads(c) && std::exchange(spread, true)) continue;
    const std::vector<double> near =
        carried_over(base.candidate.model, alone.theta, c.candidate.model);
    // What chance alone makes of a mechanism is small, and so is the error of its law.
    const Refit refit = refit_candidate(c.candidate, sample, near, 1, base.refit.discrepancy);
    if (!refit.usable) continue;
    const double gain = criterion - corrected_criterion(sample, refit, c.candidate.free_count);
    most = std::max(most, gain);
  }
  return most;
}

void calibrate(const SearchBase& base, std::vector<CandidateResult>& candidates,
               const std::function<void()>& tick) {
  const auto count = static_cast<std::size_t>(base.options.compared);
  std::vector<double> most(count, -INFINITY);
  const auto gains_more = [&](std::size_t b) {
    const auto* made = base.options.row(static_cast<std::size_t>(base.options.simulated) + b);
    most[b] = made != nullptr ? made->front() : largest_gain(base, candidates, b);
    tick();
  };
  std::size_t done = 0;
  const auto as_much = [&](const CandidateResult& c) {
    return std::count_if(most.begin(), most.begin() + static_cast<std::ptrdiff_t>(done),
                         [&](double gain) { return gain >= -c.delta_aicc; });
  };
  while (done < count && !candidates.empty() && as_much(candidates.front()) < often_enough) {
    const std::size_t now = std::min(sets_at_once, count - done);
    parallel_over(now, base.options.threads, [&](std::size_t k) { gains_more(done + k); });
    done += now;
  }
  for (std::size_t b = done; b < count; ++b) tick();
  for (CandidateResult& c : candidates) {
    c.p_value = (1.0 + static_cast<double>(as_much(c))) / (1.0 + static_cast<double>(done));
  }
}

std::vector<CandidateResult> try_pairs(const SearchBase& base,
                                       const std::vector<CandidateResult>& singles) {
  std::vector<const CandidateResult*> causes;
  for (const CandidateResult& single : singles) {
    const bool batch = find_mechanism(single.candidate.added.front())->is_batch();
    if (single.kind == MechanismKind::description) continue;
    if (batch && series_are_sizes(base.fitted.data)) continue;
    causes.push_back(&single);
  }
  std::vector<FirstLook> looks;
  for (std::size_t a = 0; a < causes.size(); ++a) {
    for (std::size_t b = a + 1; b < causes.size(); ++b) {
      if (spreads(*causes[a]) && spreads(*causes[b])) continue;
      looks.push_back({causes[a], causes[b], {}, {}});
    }
  }
  Progress progress("pairs of causes", 2 * looks.size());
  parallel_over(looks.size(), base.options.threads, [&](std::size_t k) {
    look_at(base, looks[k]);
    progress.advance();
  });
  const double worth = worth_following(looks);
  std::vector<CandidateResult> results(looks.size());
  parallel_over(looks.size(), base.options.threads, [&](std::size_t k) {
    const bool follow = looks[k].delta_aicc <= worth;
    results[k] = try_both(base, std::move(looks[k]), follow);
    progress.advance();
  });
  sort_by_criterion(results);
  return results;
}

}  // namespace recoil
