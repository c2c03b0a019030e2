#include "estimate/model_verdict.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace recoil {
namespace {

constexpr double least_p = 0.01;
constexpr double far_away = 1.0;  // standard deviations of a constant

std::optional<std::size_t> farthest_constant(const FitResult& fitted) {
  std::optional<std::size_t> found;
  double most = far_away;
  for (std::size_t k = 0; k < fitted.model.material_count(); ++k) {
    const double by = std::abs(fitted.constants_moved[k]);
    if (!(by > most) || !fitted.model.adjusts_constants()) continue;
    most = by;
    found = k;
  }
  return found;
}

}  // namespace

bool tests_the_curve(const FitResult& fitted) {
  std::set<std::tuple<std::size_t, double, double>> places;
  for (const Observation& point : fitted.data.points) {
    places.insert({point.dataset, point.diameter, point.velocity});
  }
  const auto& slots = fitted.model.slots;
  const auto free = std::ranges::count_if(
      slots, [](const ParameterSlot& slot) { return slot.free && !slot.is_constant(); });
  return places.size() > static_cast<std::size_t>(free);
}

ModelJudgement judge_model(const FitResult& fitted, double level) {
  const FitResult& exact = with_laws_exact(fitted);
  ModelJudgement judged;
  judged.laws = law_error_of(fitted, level);
  judged.moved = farthest_constant(fitted);
  const bool stated = fitted.data.noise.sd_stated;
  const bool has_p = stated && exact.dof > 0 && std::isfinite(exact.p_value);
  if (has_p) judged.p_value = exact.p_value;
  if (!fitted.weights.noise.known || fitted.dof <= 0 || has_p != stated) return judged;
  if (judged.laws && judged.laws->seen()) {
    const bool contradicted = stated && fitted.p_value < least_p;
    judged.verdict =
        contradicted ? ModelVerdict::does_not_fit : ModelVerdict::fits_within_law_error;
  } else if (judged.p_value && *judged.p_value < least_p) {
    judged.verdict = ModelVerdict::does_not_fit;
  } else if (stated && tests_the_curve(exact)) {
    judged.verdict = judged.moved ? ModelVerdict::fits_with_moved_constants : ModelVerdict::fits;
  }
  return judged;
}

}  // namespace recoil
