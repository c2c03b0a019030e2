#include "validation/studies/baseline.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/analysis.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "diagnosis/candidate.hpp"
#include "estimate/predictor.hpp"
#include "validation/synthetic/case.hpp"

namespace recoil::hidden {
namespace {

namespace fs = std::filesystem;

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

FitResult fit_with(const fs::path& written, const std::vector<std::string>& mechanisms,
                   const std::vector<std::string>& freed) {
  std::string ids;
  for (const std::string& id : mechanisms) ids += (ids.empty() ? "\"" : ", \"") + id + "\"";
  std::string text = read_text_file(written);
  const std::string model = "[model]\n";
  if (text.find(model) == std::string::npos) text.insert(text.find("[parameters]"), model + "\n");
  text.insert(text.find(model) + model.size(), "mechanisms = [" + ids + "]\n");
  const std::string parameters = "[parameters]\n";
  for (const std::string& id : freed) {
    text.insert(text.find(parameters) + parameters.size(), id + " = { free = true }\n");
  }
  const fs::path changed = fs::path(written).replace_extension(".with.toml");
  write_whole_file(changed, text, Replacing::data);
  try {
    const FitInputs inputs = load_inputs(changed);
    return fit(make_model(inputs.spec, inputs.datasets), gather(inputs.datasets, inputs.spec));
  } catch (const InputError&) {  // a mechanism that these data cannot have
    return {};
  }
}

namespace {

constexpr int starts = 4;  // as many as a diagnosis follows

/// A model of the written case and its fit under the weights of the base model.
struct Fitted {
  Candidate candidate;
  recoil::Refit refit;
};

/// Of numbers of the same points; infinite where there is no fit.
double aicc(const FitResult& base, const Fitted& fitted) {
  if (!fitted.refit.usable) return std::numeric_limits<double>::infinity();
  return corrected_criterion(base.data, fitted.refit.chi2, fitted.candidate.free_count);
}

/// `from` with the mechanism `id` added, fitted from the starts that a diagnosis gives a single
/// cause. Not usable where the data cannot have it.
Fitted with_added(const FitInputs& inputs, const FitResult& base, const Fitted& from,
                  const std::string& id) {
  Fitted with;
  std::vector<std::string> mechanisms = from.candidate.added;
  mechanisms.push_back(id);
  try {
    with.candidate = make_candidate(inputs.spec, inputs.datasets, mechanisms);
  } catch (const InputError&) {
    return with;
  }
  with.refit = refit_candidate(
      with.candidate, base.data, base.weights,
      carried_over(from.candidate.model, from.refit.theta, with.candidate.model), starts);
  return with;
}

/// The change of e from `base` to `with` at the points, in standard deviations.
std::vector<double> effect_of(const FitResult& base, const Fitted& with) {
  std::vector<double> effect;
  const auto squares =
      predict(with.candidate.model, with.refit.theta, base.data.conditions(), false);
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const double e = std::sqrt(std::max(squares[i].restitution_squared, 0.0));
    effect.push_back((e - base.prediction[i]) / base.weights.points[i].sd);
  }
  return effect;
}

}  // namespace

BaselineAnswers baseline_answers(const Case& made) {
  const ScratchFolder scratch;
  const FitInputs inputs = load_inputs(write_case(made, scratch.path()));
  const FitResult base =
      fit(make_model(inputs.spec, inputs.datasets), gather(inputs.datasets, inputs.spec));
  BaselineAnswers answers;
  if (!base.usable) return answers;
  std::vector<std::string> catalogue;
  for (const HiddenEffect& effect : hidden_effects()) {
    if (effect.kind == EffectKind::physics || effect.kind == EffectKind::measurement) {
      catalogue.emplace_back(effect.id);
    }
  }
  std::vector<double> log_velocity, log_diameter;
  for (const Observation& point : base.data.points) {
    log_velocity.push_back(std::log(point.velocity));
    log_diameter.push_back(std::log(point.diameter));
  }
  const std::vector<double> discrepancy =
      discrepancy_mean(log_velocity, log_diameter, base.residuals);
  Fitted current{make_candidate(inputs.spec, inputs.datasets, {}), {}};
  current.refit = refit_candidate(current.candidate, base.data, base.weights, base.theta, 0);
  double least = aicc(base, current);
  for (std::size_t round = 0; round < 2 && answers.stepwise.size() == round; ++round) {
    const Fitted before = current;
    double largest = 0.0;
    for (const std::string& id : catalogue) {
      if (before.candidate.adds(id)) continue;
      Fitted with = with_added(inputs, base, before, id);
      if (!with.refit.usable) continue;
      if (round == 0 && !discrepancy.empty()) {
        const double alike = std::abs(correlation(effect_of(base, with), discrepancy));
        if (alike > largest) {
          largest = alike;
          answers.correlated = id;
        }
      }
      if (!(aicc(base, with) < least)) continue;
      least = aicc(base, with);
      answers.stepwise.resize(round);
      answers.stepwise.push_back(id);
      current = std::move(with);
    }
  }
  return answers;
}

}  // namespace recoil::hidden
