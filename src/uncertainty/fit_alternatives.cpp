#include "uncertainty/fit_alternatives.hpp"

#include <algorithm>
#include <cmath>

#include "estimate/reweighting.hpp"

namespace recoil {
namespace {

constexpr double negligible = 1e-3;  // weight below which an alternative is omitted
constexpr double plausible = 0.05;

/// A reference without ownership.
std::shared_ptr<const FitResult> borrowed(const FitResult& fitted) {
  return {std::shared_ptr<const FitResult>(), &fitted};
}

double total_criterion(const Noise::Candidate& candidate) {
  return candidate.criterion + penalty_of(candidate.function);
}

/// The fit under its error of the laws with every variance function; the weights add up to 1.
std::vector<FitAlternative> over_noise(const FitResult& fitted) {
  std::vector<FitAlternative> alternatives = {{1.0, borrowed(fitted)}};
  const Noise& noise = fitted.weights.noise;
  double least = INFINITY;
  for (const Noise::Candidate& candidate : noise.candidates) {
    least = std::min(least, total_criterion(candidate));
  }
  for (const Noise::Candidate& candidate : noise.candidates) {
    const double weight = std::exp(-0.5 * (total_criterion(candidate) - least));
    if (candidate.function == noise.variance) {
      alternatives.front().weight = weight;
      continue;
    }
    if (weight < negligible) continue;
    Observations data = fitted.data;
    data.noise.spec.variance = candidate.function;
    FitOptions options;
    options.several_starts = false;
    options.start = fitted.theta;
    options.noise = noise;
    options.noise->variance = candidate.function;
    options.noise->scale = candidate.scale;
    options.noise->candidates.clear();
    FitResult other = fit(fitted.model, std::move(data), options);
    if (!other.usable) continue;
    alternatives.push_back({weight, std::make_shared<const FitResult>(std::move(other))});
  }
  double sum = 0.0;
  for (const FitAlternative& alternative : alternatives) sum += alternative.weight;
  for (FitAlternative& alternative : alternatives) alternative.weight /= sum;
  return alternatives;
}

}  // namespace

std::vector<FitAlternative> fit_alternatives(const FitResult& fitted) {
  std::vector<FitAlternative> alternatives = over_noise(fitted);
  double others = 0.0;
  double own = 0.0;
  for (const LawAlternative& law : fitted.laws) {
    const bool is_own = law.is_of(fitted);
    if (is_own) own = law.weight;
    if (!is_own && law.fitted && law.weight >= negligible) others += law.weight;
  }
  if (!(others > 0.0)) return alternatives;
  for (FitAlternative& alternative : alternatives) alternative.weight *= own / (own + others);
  for (const LawAlternative& law : fitted.laws) {
    if (law.is_of(fitted) || !law.fitted || law.weight < negligible) continue;
    alternatives.push_back({law.weight / (own + others), law.fitted});
  }
  return alternatives;
}

std::vector<FitAlternative> noise_alternatives(const FitResult& fitted) {
  return over_noise(fitted);
}

std::vector<WaldTerm> terms_of_slot(const std::vector<FitAlternative>& alternatives,
                                    std::size_t j) {
  std::vector<WaldTerm> terms;
  for (const FitAlternative& alternative : alternatives) {
    const FitResult& fitted = alternative.fitted();
    terms.push_back(
        {alternative.weight, fitted.theta[j], fitted.std_error[j], degrees_of_freedom(fitted, j)});
  }
  return terms;
}

std::vector<FitAlternative> under_same_laws(std::vector<FitAlternative> alternatives) {
  const auto own = alternatives.front().fitted().model.law_error;
  std::erase_if(alternatives, [&](const FitAlternative& alternative) {
    return alternative.fitted().model.law_error != own;
  });
  double sum = 0.0;
  for (const FitAlternative& alternative : alternatives) sum += alternative.weight;
  for (FitAlternative& alternative : alternatives) alternative.weight /= sum;
  return alternatives;
}

double undecided_factor(const std::vector<WaldTerm>& terms) {
  double least = INFINITY;
  double most = 0.0;
  for (const WaldTerm& term : terms) {
    if (term.weight < plausible || !(term.std_error > 0.0)) continue;
    least = std::min(least, term.std_error);
    most = std::max(most, term.std_error);
  }
  return most > 0.0 ? most / least : 1.0;
}

Interval averaged_wald(const std::vector<FitAlternative>& alternatives, std::size_t j,
                       double level) {
  const ParameterSlot& slot = alternatives.front().fitted().model.slots[j];
  return averaged_wald_interval(terms_of_slot(alternatives, j), level, slot.lower, slot.upper);
}

}  // namespace recoil
