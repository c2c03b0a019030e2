#include "validation/studies/baseline.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/analysis.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "validation/studies/program_run.hpp"
#include "validation/synthetic/case_files.hpp"

namespace hidden {
namespace {

namespace fs = std::filesystem;
using recoil::FitResult;

/// Infinite where there is no fit.
double aicc(const FitResult& fitted) {
  if (!fitted.usable) return std::numeric_limits<double>::infinity();
  const auto n = static_cast<double>(fitted.residuals.size());
  const double k = fitted.model.free_count();
  return fitted.chi2 + 2.0 * k + 2.0 * k * (k + 1.0) / (n - k - 1.0);
}

/// Of numbers about their means; 0 where one does not vary.
double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const auto n = static_cast<Eigen::Index>(a.size());
  Eigen::ArrayXd x = Eigen::Map<const Eigen::ArrayXd>(a.data(), n);
  Eigen::ArrayXd y = Eigen::Map<const Eigen::ArrayXd>(b.data(), n);
  x -= x.mean();
  y -= y.mean();
  const double size = std::sqrt(x.square().sum() * y.square().sum());
  return size > 0.0 ? (x * y).sum() / size : 0.0;
}

}  // namespace

std::vector<double> discrepancy_mean(const std::vector<double>& log_velocity,
                                     const std::vector<double>& log_diameter,
                                     const std::vector<double>& residuals) {
  const auto n = static_cast<Eigen::Index>(residuals.size());
  const Eigen::Map<const Eigen::VectorXd> r(residuals.data(), n);
  const Eigen::Map<const Eigen::ArrayXd> v(log_velocity.data(), n);
  const Eigen::Map<const Eigen::ArrayXd> d(log_diameter.data(), n);
  Eigen::MatrixXd kernel(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    kernel.col(j) = (-0.5 * ((v - v(j)).square() + (d - d(j)).square())).exp();
  }
  double least = r.squaredNorm() - 2.0;  // -2 ln likelihood without it, less what it costs
  std::vector<double> best;
  for (double s = 0.1; s < 100.5; s *= std::pow(10.0, 0.25)) {
    const Eigen::LLT<Eigen::MatrixXd> covariance(Eigen::MatrixXd::Identity(n, n) + s * s * kernel);
    const Eigen::VectorXd weights = covariance.solve(r);
    const double log_determinant =
        2.0 * Eigen::MatrixXd(covariance.matrixL()).diagonal().array().log().sum();
    const double deviance = r.dot(weights) + log_determinant;
    if (!(deviance < least)) continue;
    least = deviance;
    const Eigen::VectorXd mean = s * s * kernel * weights;
    best.assign(mean.begin(), mean.end());
  }
  return best;
}

FitResult fit_with(const fs::path& fit, const std::vector<std::string>& mechanisms) {
  std::string ids;
  for (const std::string& id : mechanisms) ids += (ids.empty() ? "\"" : ", \"") + id + "\"";
  std::string text = recoil::read_text_file(fit);
  const std::string model = "[model]\n";
  if (text.find(model) == std::string::npos) text.insert(text.find("[parameters]"), model + "\n");
  text.insert(text.find(model) + model.size(), "mechanisms = [" + ids + "]\n");
  const fs::path changed = fs::path(fit).replace_extension(".with.toml");
  recoil::write_whole_file(changed, text);
  try {
    const recoil::FitInputs inputs = recoil::load_inputs(changed);
    return recoil::fit(recoil::make_model(inputs.spec, inputs.datasets),
                       recoil::gather(inputs.datasets, inputs.spec));
  } catch (const recoil::InputError&) {  // a mechanism that these data cannot have
    return {};
  }
}

BaselineAnswers baseline_answers(const Case& made) {
  const ScratchFolder scratch;
  const std::filesystem::path fit = write_case(made, scratch.path());
  std::vector<std::string> catalogue;
  for (const HiddenEffect& effect : hidden_effects()) {
    if (effect.kind == EffectKind::physics || effect.kind == EffectKind::measurement) {
      catalogue.emplace_back(effect.id);
    }
  }
  const FitResult base = fit_with(fit, {});
  BaselineAnswers answers;
  if (!base.usable) return answers;
  std::vector<double> log_velocity, log_diameter;
  for (const recoil::Observation& point : base.data.points) {
    log_velocity.push_back(std::log(point.velocity));
    log_diameter.push_back(std::log(point.diameter));
  }
  const std::vector<double> discrepancy =
      discrepancy_mean(log_velocity, log_diameter, base.residuals);
  double least = aicc(base);
  for (std::size_t round = 0; round < 2 && answers.stepwise.size() == round; ++round) {
    double largest = 0.0;
    std::string added;
    for (const std::string& id : catalogue) {
      std::vector<std::string> mechanisms = answers.stepwise;
      if (std::find(mechanisms.begin(), mechanisms.end(), id) != mechanisms.end()) continue;
      mechanisms.push_back(id);
      const FitResult with = fit_with(fit, mechanisms);
      if (aicc(with) < least) {
        least = aicc(with);
        added = id;
      }
      if (round > 0 || discrepancy.empty() || !with.usable) continue;
      std::vector<double> effect;
      for (std::size_t i = 0; i < with.prediction.size(); ++i) {
        effect.push_back((with.prediction[i] - base.prediction[i]) /
                         base.data.points[i].weights.sd);
      }
      const double alike = std::abs(correlation(effect, discrepancy));
      if (alike > largest) {
        largest = alike;
        answers.correlated = id;
      }
    }
    if (!added.empty()) answers.stepwise.push_back(added);
  }
  return answers;
}

}  // namespace hidden
