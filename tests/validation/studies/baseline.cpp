#include "validation/studies/baseline.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "core/files.hpp"
#include "core/json.hpp"
#include "validation/studies/program_run.hpp"
#include "validation/synthetic/case_files.hpp"

namespace hidden {
namespace {

namespace fs = std::filesystem;
using recoil::Json;

/// A fit of the built command with some mechanisms.
struct PlainFit {
  double aicc = std::numeric_limits<double>::infinity();
  std::vector<double> predicted, residuals;            ///< e, and weighted [points]
  std::vector<double> sd, log_velocity, log_diameter;  ///< [points]
};

PlainFit plain_fit(const fs::path& fit, const std::vector<std::string>& mechanisms,
                   const fs::path& binary) {
  std::string ids;
  for (const std::string& id : mechanisms) ids += (ids.empty() ? "\"" : ", \"") + id + "\"";
  std::string text = recoil::read_text_file(fit);
  const std::string model = "[model]\n";
  text.insert(text.find(model) + model.size(), "mechanisms = [" + ids + "]\n");
  const fs::path changed = fs::path(fit).replace_extension(".with.toml");
  recoil::write_whole_file(changed, text);
  const fs::path out = fit.parent_path() / "out";
  const ProgramRun run = run_program({binary.string(), "fit", changed.string(), "--replicates", "0",
                                      "--threads", "1", "--out", out.string()});
  PlainFit found;
  if (run.status != 0) return found;
  std::ifstream in(out / "fit.json");
  const Json answer = Json::parse(in);
  double k = 0.0;
  for (const auto& [name, parameter] : answer.at("parameters").items()) {
    if (parameter.at("free").get<bool>()) k += 1.0;
  }
  for (const Json& point : answer.at("residuals")) {
    found.predicted.push_back(point.at("predicted"));
    found.residuals.push_back(point.at("weighted_residual"));
    found.sd.push_back(point.at("sd_used"));
    found.log_velocity.push_back(std::log(point.at("incident_velocity").get<double>()));
    found.log_diameter.push_back(std::log(point.at("diameter_um").get<double>()));
  }
  const auto n = static_cast<double>(found.residuals.size());
  found.aicc = answer.at("goodness").at("chi2").get<double>() + 2.0 * k +
               2.0 * k * (k + 1.0) / (n - k - 1.0);
  return found;
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

BaselineAnswers baseline_answers(const Case& made, const fs::path& binary) {
  const ScratchFolder scratch;
  const fs::path fit = write_case(made, scratch.path());
  std::vector<std::string> catalogue;
  for (const HiddenEffect& effect : hidden_effects()) {
    if (effect.kind == EffectKind::physics || effect.kind == EffectKind::measurement) {
      catalogue.emplace_back(effect.id);
    }
  }
  const PlainFit base = plain_fit(fit, {}, binary);
  BaselineAnswers answers;
  if (base.residuals.empty()) return answers;
  const std::vector<double> discrepancy =
      discrepancy_mean(base.log_velocity, base.log_diameter, base.residuals);
  double least = base.aicc;
  for (std::size_t round = 0; round < 2 && answers.stepwise.size() == round; ++round) {
    double largest = 0.0;
    std::string added;
    for (const std::string& id : catalogue) {
      std::vector<std::string> mechanisms = answers.stepwise;
      if (std::find(mechanisms.begin(), mechanisms.end(), id) != mechanisms.end()) continue;
      mechanisms.push_back(id);
      const PlainFit with = plain_fit(fit, mechanisms, binary);
      if (with.aicc < least) {
        least = with.aicc;
        added = id;
      }
      if (round > 0 || discrepancy.empty() || with.predicted.empty()) continue;
      std::vector<double> effect;
      for (std::size_t i = 0; i < with.predicted.size(); ++i) {
        effect.push_back((with.predicted[i] - base.predicted[i]) / base.sd[i]);
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
