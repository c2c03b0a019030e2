#include "peer.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>

#include "core/error.hpp"
#include "core/files.hpp"
#include "estimate/impact_problem.hpp"

namespace recoil::bench {
namespace {

constexpr std::array<const char*, 3> names = {"C_H", "C_A", "f0"};
constexpr int refits = 1999;

/// C_H, C_A and f0 in the order of `names`, however theta is laid out.
std::vector<double> in_order(const ImpactModel& model, const std::vector<double>& theta) {
  return {theta[model.slot_C_H[0]], theta[model.slot_C_A[0]], theta[model.slot_adhesion[0]]};
}

Json named(const std::vector<double>& values) {
  Json json;
  for (std::size_t j = 0; j < names.size(); ++j) json[names[j]] = values[j];
  return json;
}

/// lmfit's default tolerances (ftol = xtol = 1.5e-8 of MINPACK's lmdif), as near as Ceres has them.
LeastSquaresOptions peer_options() {
  LeastSquaresOptions options;
  options.function_tolerance = 1.5e-8;
  options.parameter_tolerance = 1.5e-8;
  options.finish = false;  // no peer does
  return options;
}

/// recoil's fit and how far the others are from it.
class Comparison {
 public:
  explicit Comparison(const Case& the_case) : case_(the_case), exact_(the_case.model) {
    exact_.solver.kind = Solver::reference;
    FitOptions options;
    options.several_starts = false;
    const FitResult fitted = fit(exact_, case_.data, options);
    if (!fitted.usable) throw ComputationError("the peers' data: " + fitted.failure);
    estimate_ = in_order(exact_, fitted.theta);
    std_error_ = in_order(exact_, fitted.std_error);
    least_ = fitted.chi2;
  }

  Json yardstick() const {
    return {{"what", "recoil on CVODES at its default tolerance"},
            {"estimate", named(estimate_)},
            {"std_error", named(std_error_)},
            {"chi2", least_}};
  }

  /// Adds to `result`: the differences in standard errors, chi2 by CVODES above that of the
  /// yardstick, and a sentence about it.
  void judge(Json& result) const {
    double largest = 0.0;
    std::vector<double> off, theta(exact_.slots.size());
    for (std::size_t j = 0; j < names.size(); ++j) {
      const double value = result["estimate"][names[j]];
      off.push_back((value - estimate_[j]) / std_error_[j]);
      largest = std::max(largest, std::abs(off.back()));
    }
    theta[exact_.slot_C_H[0]] = result["estimate"]["C_H"];
    theta[exact_.slot_C_A[0]] = result["estimate"]["C_A"];
    theta[exact_.slot_adhesion[0]] = result["estimate"]["f0"];
    result["difference_in_std_errors"] = named(off);
    result["largest_difference"] = largest;
    result["chi2_above_yardstick"] = chi2(theta) - least_;
    double low = 1e300, high = 0.0;
    for (std::size_t j = 0; j < names.size(); ++j) {
      const Json& error = result["std_error"][names[j]];
      if (!error.is_number()) continue;
      low = std::min(low, error.get<double>() / std_error_[j]);
      high = std::max(high, error.get<double>() / std_error_[j]);
    }
    if (high > 0.0) result["std_error_ratio"] = {low, high};
    result["agrees"] = largest <= agreement;
    result["verdict"] = verdict(result);
  }

 private:
  /// The sum of squares by CVODES; infinite where it has no answer.
  double chi2(const std::vector<double>& theta) const {
    std::vector<double> residuals(case_.data.points.size());
    const Weights weights = first_weights(case_.data);
    if (!impact_problem(exact_, case_.data, weights).evaluate(theta, residuals, {})) {
      return HUGE_VAL;
    }
    double sum = 0.0;
    for (const double r : residuals) sum += r * r;
    return sum;
  }

  /// Who is wrong, and why as far as the peer's own account of its errors tells.
  static std::string verdict(const Json& result) {
    const double largest = result["largest_difference"];
    if (largest <= agreement) return "agrees";
    const double excess = result["chi2_above_yardstick"];
    // At d standard errors along one parameter a parabola is at least d^2 above its minimum.
    if (!(excess > 0.25 * largest * largest)) {
      return fmt::format("differs, though chi2 is only {:.2g} higher", excess);
    }
    if (!result.contains("difference_error")) return "wrong: this is no minimum";
    return fmt::format(
        "wrong: its integrator's errors are up to {:.2g} in a residual and {:.0f} % in their "
        "differences",
        result["residual_error"].get<double>(), 100.0 * result["difference_error"].get<double>());
  }

  const Case& case_;
  ImpactModel exact_;
  std::vector<double> estimate_, std_error_;
  double least_ = 0.0;
};

Json recoil_fit(const Case& the_case, const Comparison& comparison) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const Weights weights = first_weights(the_case.data);
  const LeastSquaresProblem problem = impact_problem(the_case.model, the_case.data, weights);
  LeastSquaresResult refit;
  const double seconds = median_seconds(
      [&] { refit = minimise(problem, the_case.model.initial(), peer_options()); }, 1.0, 5);
  if (!refit.converged) throw ComputationError("recoil's fit: " + refit.message);
  std::vector<double> error;
  for (std::size_t j = 0; j < refit.theta.size(); ++j) {
    error.push_back(std::sqrt(refit.covariance[j * refit.theta.size() + j]));
  }
  Json result = {{"name", "recoil"},
                 {"method", "fast path"},
                 {"seconds", seconds},
                 {"iterations", refit.iterations},
                 {"chi2", refit.sum_of_squares},
                 {"estimate", named(in_order(the_case.model, refit.theta))},
                 {"std_error", named(in_order(the_case.model, error))}};
  comparison.judge(result);
  const double full = median_seconds([&] { fit(the_case.model, the_case.data); }, 1.0, 3);
  result["seconds_of_full_fit"] = full;
  return result;
}

/// Runs a peer's script on `folder`; whether it left `result`.
bool run_script(const std::string& command, const std::filesystem::path& folder,
                const std::filesystem::path& result, const std::string& log) {
  std::filesystem::remove(result);
  const std::string line = fmt::format("{} '{}' >'{}' 2>&1 </dev/null", command, folder.string(),
                                       (folder / log).string());
  return std::system(line.c_str()) == 0 && std::filesystem::is_regular_file(result);
}

/// One number per column of a CSV file of two lines.
Json read_row(const std::filesystem::path& file) {
  std::string text = read_text_file(file);
  std::erase(text, '"');
  const std::size_t end = text.find('\n');
  Json row;
  std::size_t a = 0, b = end + 1;
  while (a < end) {
    const std::size_t a_end = std::min(text.find(',', a), end);
    const std::size_t b_end = text.find_first_of(",\n", b);
    row[text.substr(a, a_end - a)] = text.substr(b, b_end - b);
    a = a_end + 1;
    b = b_end + 1;
  }
  return row;
}

double number(const Json& row, const std::string& key) {
  return std::stod(row.at(key).get<std::string>());
}

Json r_fit(const std::filesystem::path& folder, const Comparison& comparison) {
  const Json row = read_row(folder / "peer_r.csv");
  std::vector<double> estimate, error;
  for (const char* name : names) {
    estimate.push_back(number(row, name));
    error.push_back(number(row, std::string("se_") + name));
  }
  Json result = {
      {"name", "R"},
      {"method", "lsodar"},
      {"rtol", number(row, "tolerance")},
      {"seconds", number(row, "seconds")},
      {"iterations", number(row, "iterations")},
      {"chi2", number(row, "chi2")},
      {"estimate", named(estimate)},
      {"std_error", named(error)},
      {"boot_replicates", number(row, "replicates")},
      // boot() computes the statistic once more, of the data themselves
      {"boot_seconds_per_refit", number(row, "boot_seconds") / (number(row, "replicates") + 1.0)}};
  for (const char* name : {"R", "deSolve", "minpack.lm", "boot"}) {
    result["versions"][name] = row.at(name);
  }
  comparison.judge(result);
  return result;
}

}  // namespace

Json measure_peers(const Case& the_case, const std::filesystem::path& folder,
                   const std::filesystem::path& scripts) {
  const Comparison comparison(the_case);
  const Json own = recoil_fit(the_case, comparison);
  const double own_seconds = own["seconds"];
  Json result = {{"points", the_case.data.points.size()},
                 {"free_parameters", names.size()},
                 {"lmfit_seconds_per_fit", nullptr},
                 {"recoil_seconds_per_fit", own_seconds},
                 {"ratio", nullptr},
                 {"yardstick", comparison.yardstick()},
                 {"fits", Json::array({own})}};

  fmt::print("  Python: lmfit and scipy ...\n");
  std::fflush(stdout);
  // Debian's own Python: packages of another one on the PATH are not those that ./run bench has
  // installed.
  if (run_script(fmt::format("/usr/bin/python3 '{}'", (scripts / "peer_lmfit.py").string()), folder,
                 folder / "peer_lmfit.json", "peer_lmfit.log")) {
    Json peer = Json::parse(read_text_file(folder / "peer_lmfit.json"));
    for (Json& one : peer["fits"]) {
      comparison.judge(one);
      one["name"] = fmt::format("lmfit, {}", one["name"].get<std::string>());
      result["fits"].push_back(one);
    }
    const double seconds = peer["fits"][0]["seconds"];
    result["lmfit_seconds_per_fit"] = seconds;
    result["ratio"] = seconds / own_seconds;
    result["lmfit_seconds_per_1999_refits"] = refits * seconds;
    result["lmfit_versions"] = peer["versions"];
  } else {
    result["missing"].push_back("Python with lmfit and scipy (benchmark/peer_lmfit.log)");
  }

  fmt::print("  R: minpack.lm, deSolve and boot ...\n");
  std::fflush(stdout);
  if (run_script(fmt::format("Rscript --vanilla '{}'", (scripts / "peer_r.R").string()), folder,
                 folder / "peer_r.csv", "peer_r.log")) {
    const Json peer = r_fit(folder, comparison);
    const double seconds = peer["seconds"];
    result["fits"].push_back(peer);
    result["r_seconds_per_fit"] = seconds;
    result["r_ratio"] = seconds / own_seconds;
    result["r_seconds_per_1999_refits"] = refits * peer["boot_seconds_per_refit"].get<double>();
    result["r_versions"] = peer["versions"];
  } else {
    result["missing"].push_back("R with minpack.lm, deSolve and boot (benchmark/peer_r.log)");
  }
  result["recoil_seconds_per_1999_refits_one_after_another"] = refits * own_seconds;
  return result;
}

}  // namespace recoil::bench
