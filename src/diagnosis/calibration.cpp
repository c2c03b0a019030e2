#include "diagnosis/calibration.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/error.hpp"
#include "diagnosis/outlying_points.hpp"
#include "diagnosis/search.hpp"

namespace recoil {
/// Everything refers to what stands before it.
struct Calibration::Side {
  Side(const FitSpec& fit_spec, std::vector<Dataset> data, FitResult fit_result,
       const DiagnosisOptions& given)
      : spec(fit_spec),
        datasets(std::move(data)),
        fitted(std::move(fit_result)),
        options(given),
        base(search_base(spec, datasets, fitted, options)) {}

  FitSpec spec;
  std::vector<Dataset> datasets;
  FitResult fitted;
  DiagnosisOptions options;
  SearchBase base;
};

Calibration::Calibration(const FitSpec& stated, const std::vector<Dataset>& datasets,
                         const DiagnosisOptions& options) {
  const FitSpec spec = with_constants_adjusted(stated);
  FitResult fitted = fit(make_model(spec, datasets), gather(datasets, spec.noise));
  if (!fitted.usable) {
    throw ComputationError(
        fmt::format("{}: the fit has no usable answer: {}", spec.file.string(), fitted.failure));
  }
  DiagnosisOptions own = options;
  own.kept.reset();
  sides_.push_back(std::make_unique<Side>(spec, datasets, std::move(fitted), own));
  if (!sides_.front()->base.refit.usable) {
    throw ComputationError(
        fmt::format("{}: the fit cannot be repeated from its own answer", spec.file.string()));
  }
  const std::vector<OutlyingPoint> outlying = outlying_points(sides_.front()->base);
  if (outlying.empty()) return;
  const std::vector<Dataset> others = without_points(datasets, outlying);
  FitResult refitted = fit(make_model(spec, others), gather(others, spec));
  if (!refitted.usable) return;
  auto side = std::make_unique<Side>(spec, others, std::move(refitted), own);
  if (side->base.refit.usable) sides_.push_back(std::move(side));
}

Calibration::~Calibration() = default;

std::size_t Calibration::pieces() const { return sides_.size() * sides_.front()->options.pieces(); }

std::vector<double> Calibration::run(std::size_t piece) const {
  const std::size_t of_each = sides_.front()->options.pieces();
  return calibration_row(residuals_of_sample(sides_[piece / of_each]->base, piece % of_each));
}

std::string Calibration::digits() const {
  std::string digits;
  for (const auto& side : sides_) {
    for (const double value : side->base.refit.theta) digits += fmt::format("{:a}|", value);
    for (const double value : side->base.refit.residuals) digits += fmt::format("{:a}|", value);
    digits += fmt::format("{:a};", side->base.criterion);
  }
  return digits;
}

}  // namespace recoil
