#include "diagnosis/separation.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "core/parallel.hpp"
#include "estimate/predictor.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_causes = 4;
constexpr std::size_t most_near = 5;  // rivals that are fitted under the errors of their laws

/// The points as `cause` predicts them, without noise; captures stay.
std::optional<Observations> points_of(const SearchBase& base, const CandidateResult& cause) {
  Observations data = base.fitted.data;
  const std::vector<Prediction> at =
      predict(cause.candidate.model, cause.refit.theta, data.conditions(), false);
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (!at[i].usable()) return std::nullopt;
    Observation& point = data.points[i];
    if (!point.censored && !point.counts_only()) point.restitution = at[i].restitution();
  }
  return data;
}

/// A rival of a cause, fitted to points of the cause.
struct Rival {
  const CandidateResult* candidate = nullptr;
  Refit refit;
};

/// The points of a cause without noise, and the fits of its rivals to them.
class CleanPoints {
 public:
  CleanPoints(const SearchBase& base, const CandidateResult& cause, Observations points)
      : base_(base), cause_(cause), points_(std::move(points)) {
    const Refit own =
        refit_candidate(cause.candidate, points_, base.fitted.weights, cause.refit.theta, 0);
    own_chi2_ = own.usable ? own.chi2 : 0.0;
  }

  Refit fitted(const CandidateResult& rival) const {
    return refit_candidate(rival.candidate, points_, base_.fitted.weights, rival.refit.theta, 0);
  }

  /// The rival under the errors of its laws.
  Refit fitted_with_errors(const Rival& rival) const {
    LawErrors laws = base_.laws;
    laws.mechanism = usual_law_error;
    return refit_with_law_error(rival.candidate->candidate, points_, base_.fitted.weights,
                                rival.refit, laws, law_error_of_base * usual_law_error);
  }

  Separation separation_from(const CandidateResult& rival, const Refit& refit) const {
    const double scale = base_.noise_scale;
    const double lambda = std::max(refit.chi2 - own_chi2_, 0.0) / (scale * scale);
    const double penalty = penalty_of(rival) - penalty_of(cause_);
    return {rival.candidate.name(), lambda,
            probability_of_naming(lambda, penalty, base_.options.margin)};
  }

 private:
  double penalty_of(const CandidateResult& c) const {
    const Observations& data = base_.fitted.data;
    return corrected_criterion(data, static_cast<double>(data.points.size()),
                               c.candidate.free_count);
  }

  const SearchBase& base_;
  const CandidateResult& cause_;
  Observations points_;
  double own_chi2_ = 0.0;  // of its constants, which may lie away from their stated values
};

bool harder(const Separation& a, const Separation& b) { return a.probability < b.probability; }

void separate_one(const SearchBase& base, const std::vector<CandidateResult*>& causes,
                  CandidateResult& cause) {
  std::optional<Observations> points = points_of(base, cause);
  if (!points) return;
  const CleanPoints clean(base, cause, *std::move(points));
  std::vector<Rival> rivals;
  for (const CandidateResult* other : causes) {
    if (other == &cause) continue;
    Rival rival{other, clean.fitted(*other)};
    if (rival.refit.usable) rivals.push_back(std::move(rival));
  }
  std::ranges::sort(rivals, {}, [](const Rival& one) { return one.refit.chi2; });
  std::vector<Separation> exact, allowed;
  for (const Rival& rival : rivals) {
    exact.push_back(clean.separation_from(*rival.candidate, rival.refit));
    if (allowed.size() == most_near) continue;
    const Refit refit = clean.fitted_with_errors(rival);
    if (refit.usable) allowed.push_back(clean.separation_from(*rival.candidate, refit));
  }
  if (!exact.empty()) cause.separation = std::ranges::min(exact, harder);
  if (!allowed.empty()) cause.separation_allowed = std::ranges::min(allowed, harder);
}

}  // namespace

double probability_of_naming(double lambda, double penalty, double margin) {
  const double ahead = lambda + penalty - margin;
  if (!(lambda > 0.0)) return ahead >= 0.0 ? 1.0 : 0.0;
  return gsl_cdf_ugaussian_P(ahead / (2.0 * std::sqrt(lambda)));
}

void separate(const SearchBase& base, std::vector<CandidateResult>& candidates) {
  std::vector<CandidateResult*> causes;
  for (CandidateResult& c : candidates) {
    if (c.near_plausible && may_be_a_cause(c)) causes.push_back(&c);
  }
  parallel_over(std::min(causes.size(), most_causes), base.options.threads,
                [&](std::size_t k) { separate_one(base, causes, *causes[k]); });
}

}  // namespace recoil
