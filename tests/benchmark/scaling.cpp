#include "scaling.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <string>

#include "core/error.hpp"
#include "design.hpp"

namespace recoil::bench {
namespace {

constexpr std::size_t points_for_parameters = 10000;
constexpr int parameters_for_points = 3;
constexpr int most_parameters = 10;

/// What a command prints. @throws ComputationError when it fails.
std::string output_of(const std::string& command) {
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw ComputationError("cannot start " + command);
  std::string text;
  char buffer[512];
  while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) text += buffer;
  if (pclose(pipe) != 0) throw ComputationError("failed: " + command);
  return text;
}

/// The exponent of `cost` over `size` along a list of cases.
double exponent(const std::vector<Json>& cases, const char* size, const char* cost) {
  std::vector<double> sizes, costs;
  for (const Json& one : cases) {
    sizes.push_back(one.at(size));
    costs.push_back(one.at(cost));
  }
  return growth_exponent(sizes, costs);
}

}  // namespace

Json scaling_case(std::size_t points, int free_parameters) {
  const double resting = peak_memory_mb();
  Case large = large_case(points, free_parameters);
  FitOptions options;
  options.several_starts = false;
  FitResult fitted;
  constexpr double budget = 0.3;  // seconds; one fit of many points takes longer, and is run once
  const auto work = [&] {         // the points go to the fit and come back with it
    if (fitted.usable) large.data = std::move(fitted.data);
    fitted = fit(large.model, std::move(large.data), options);
  };
  const double seconds = median_seconds(work, budget);
  if (!fitted.usable) throw ComputationError("the fit did not converge: " + fitted.failure);
  return {{"points", points},
          {"free_parameters", free_parameters},
          {"seconds", seconds},
          {"peak_memory_mb", peak_memory_mb()},
          {"memory_of_data_and_fit_mb", peak_memory_mb() - resting},
          {"reduced_chi2", fitted.chi2 / fitted.dof}};
}

Json measure_scaling(const std::filesystem::path& program, std::size_t most_points) {
  const auto run = [&](std::size_t points, int parameters) {
    Json one = Json::parse(
        output_of(fmt::format("'{}' --scaling-case {} {}", program.string(), points, parameters)));
    fmt::print("  {:>8} points {:>3} free parameters {:>10.4f} s {:>9.1f} MB\n", points, parameters,
               one.at("seconds").get<double>(), one.at("peak_memory_mb").get<double>());
    std::fflush(stdout);
    return one;
  };
  std::vector<Json> by_points, many_points, by_parameters;
  for (std::size_t points = 100; points <= most_points; points *= 10) {
    by_points.push_back(run(points, parameters_for_points));
    if (points >= points_for_parameters) many_points.push_back(by_points.back());
  }
  for (int parameters = 1; parameters <= most_parameters; ++parameters) {
    by_parameters.push_back(run(points_for_parameters, parameters));
  }
  Json all = by_points;
  for (const Json& one : by_parameters) all.push_back(one);
  return {
      {"scaling", all},
      {"scaling_exponents",
       {{"seconds_over_points", exponent(by_points, "points", "seconds")},
        {"memory_over_points",
         many_points.size() < 2
             ? Json()
             : Json(exponent(many_points, "points", "memory_of_data_and_fit_mb"))},
        {"seconds_over_free_parameters", exponent(by_parameters, "free_parameters", "seconds")}}}};
}

}  // namespace recoil::bench
