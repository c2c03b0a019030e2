#include "diagnosis/search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/parallel.hpp"
#include "diagnosis/kept_pieces.hpp"
#include "estimate/observation.hpp"
#include "estimate/residual.hpp"
#include "estimate/shared_settings.hpp"
#include "estimate/simulated_observation.hpp"
#include "mechanism/catalogue.hpp"

namespace recoil {
namespace {

constexpr std::size_t sets_at_once = 13;    // between two looks at how many gain more
constexpr std::ptrdiff_t often_enough = 5;  // to say that chance gives as much

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
  noise.setting_sd = too_few_settings(data, free) ? 0.0 : std::min(rough, data.noise.setting_sd);
  FitOptions options;
  options.several_starts = false;
  options.start = fitted.theta;
  FitResult again = fit(fitted.model, gather(datasets, noise), options);
  return again.usable ? again : fitted;
}

}  // namespace

FitSpec with_constants_adjusted(FitSpec spec) {
  if (spec.uncertainty.materials == Materials::propagated) {
    spec.uncertainty.materials = Materials::adjusted;
  }
  return spec;
}

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
  using Answer = std::optional<PerValue<StructureQuestion, double>>;
  const auto make = [&]() -> Answer {
    const Observations sample = simulate_base(base, index);
    const Refit refit =
        refit_candidate(base.candidate, sample, base.refit.theta, 1, base.refit.discrepancy);
    if (!refit.usable) return std::nullopt;
    return statistics(refit.residuals);
  };
  const auto write = [](const Answer& answer) { return row_json(calibration_row(answer)); };
  const auto read = [](const Json& row) -> Answer {
    const std::vector<double> values = row_numbers(row);
    if (values.size() == 1) return std::nullopt;
    PerValue<StructureQuestion, double> answer{};
    std::size_t at = 1;
    for (const StructureQuestion question : values_of<StructureQuestion>()) {
      answer[question] = values.at(at++);
    }
    return answer;
  };
  return kept_or_made(base.options.kept.get(), base.options.first_piece + index, make, write, read);
}

std::vector<double> calibration_row(
    const std::optional<PerValue<StructureQuestion, double>>& answer) {
  if (!answer) return {0.0};
  std::vector<double> row = {1.0};
  for (const StructureQuestion question : values_of<StructureQuestion>()) {
    row.push_back((*answer)[question]);
  }
  return row;
}

bool spreads(const CandidateResult& single) {
  return find_mechanism(single.candidate.added.front())->spreads();
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
    most[b] = kept_or_made(
        base.options.kept.get(),
        base.options.first_piece + static_cast<std::size_t>(base.options.simulated) + b,
        [&] { return largest_gain(base, candidates, b); },
        [](double gain) { return row_json({gain}); },
        [](const Json& row) { return row_numbers(row).at(0); });
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

}  // namespace recoil
