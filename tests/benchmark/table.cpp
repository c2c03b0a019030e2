#include "table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

namespace recoil::bench {
namespace {

/// A time with two or three digits in the unit that suits it.
std::string time_text(double seconds) {
  if (seconds < 0.9995e-6) return fmt::format("{:.0f} ns", seconds * 1e9);
  if (seconds < 0.9995e-3) return fmt::format("{:.3g} us", seconds * 1e6);
  if (seconds < 0.9995) return fmt::format("{:.3g} ms", seconds * 1e3);
  if (seconds < 600.0) return fmt::format("{:.3g} s", seconds);
  if (seconds < 2.0 * 3600.0) return fmt::format("{:.3g} min", seconds / 60.0);
  return fmt::format("{:.3g} h", seconds / 3600.0);
}

std::string time_of(const Json& seconds) { return time_text(seconds.get<double>()); }

/// A whole number with a comma between thousands.
std::string count_text(double count) {
  std::string digits = fmt::format("{:.0f}", count);
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, ",");
  return digits;
}

/// A ratio to two digits, with a comma between thousands.
std::string ratio_text(double ratio) {
  if (ratio < 100.0) return fmt::format("{:.2g}", ratio);
  double rounding = 1.0;
  while (ratio / rounding >= 100.0) rounding *= 10.0;
  return count_text(std::round(ratio / rounding) * rounding);
}

std::string machine_text(const Json& results) {
  const Json& m = results.at("machine");
  return fmt::format(
      "{} ({} cores, {}), {:.0f} GB, {}, {}; {}; `{}`; load before the start {:.1f}.",
      m.at("processor").get<std::string>(), m.at("cores").get<int>(),
      m.at("vector_instructions").get<std::string>(), m.at("memory_gb").get<double>(),
      m.at("system").get<std::string>(), m.at("compiler").get<std::string>(),
      results.at("date").get<std::string>(), results.at("command").get<std::string>(),
      m.at("load_before").get<double>());
}

std::string versions_text(const Json& versions) {
  std::string text;
  for (const auto& [name, version] : versions.items()) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, version.get<std::string>());
  }
  return text;
}

const Json& largest_case(const Json& scaling) {
  const Json* largest = &scaling.front();
  for (const Json& one : scaling) {
    if (one.at("points").get<double>() > largest->at("points").get<double>()) largest = &one;
  }
  return *largest;
}

/// A row for each law of adhesion beside the ring's.
std::string law_rows(const Json& impact) {
  std::string rows;
  for (const Json& law : impact.value("laws", Json::array())) {
    rows += fmt::format("| the same under `{}` | {} | {} | {} |\n",
                        law.at("adhesion").get<std::string>(),
                        time_text(law.at("fast_ns").get<double>() * 1e-9),
                        time_text(law.at("reference_ns").get<double>() * 1e-9),
                        ratio_text(law.at("ratio").get<double>()));
  }
  return rows;
}

std::string impact_section(const Json& impact) {
  const auto range = [&](const char* key) {
    return fmt::format("{:.2g} to {:.2g}", impact.at(key)[0].get<double>(),
                       impact.at(key)[1].get<double>());
  };
  return fmt::format(
      "## One impact\n\n"
      "{} impacts drawn at random about the shipped fits, {} of them captured: V / V_a from {}, "
      "C_H V from {}, C_A V from {}. One thread; the reference is CVODES at a tolerance of {:g}, "
      "with "
      "forward sensitivities for the gradient. Largest difference between the two on this set: "
      "{:.1e} in e^2, {:.1e} in the gradient (relative to the larger of 1 and the value); {} "
      "impacts "
      "were handed over to the reference.\n\n"
      "| per impact | fast | reference | ratio |\n|---|---|---|---|\n"
      "| e^2 and its gradient | {} | {} | {} |\n"
      "{}"
      "| e^2 alone | {} | {} | {} |\n\n",
      impact.at("impacts").get<int>(), impact.at("captured").get<int>(),
      range("velocity_over_adhesion_velocity"), range("C_H_V"), range("C_A_V"),
      impact.at("reference_tolerance").get<double>(), impact.at("largest_difference").get<double>(),
      impact.at("largest_gradient_difference").get<double>(),
      impact.at("handed_over_to_reference").get<long>(),
      time_text(impact.at("fast_ns").get<double>() * 1e-9),
      time_text(impact.at("reference_ns").get<double>() * 1e-9),
      ratio_text(impact.at("ratio").get<double>()), law_rows(impact),
      time_text(impact.at("e2_fast_ns").get<double>() * 1e-9),
      time_text(impact.at("e2_reference_ns").get<double>() * 1e-9),
      ratio_text(impact.at("e2_ratio").get<double>()));
}

std::string bootstrap_section(const Json& bootstrap) {
  std::string text = fmt::format(
      "## Bootstrap\n\n{} refits of {} points, C_H, C_A and f0 free; {} of them failed. Efficiency "
      "is "
      "the time on one thread over the number of threads times the time on them.\n\n"
      "| threads | time | efficiency |\n|---|---|---|\n",
      bootstrap.at("replicates").get<int>(), bootstrap.at("points").get<int>(),
      bootstrap.at("failed").get<int>());
  for (const Json& row : bootstrap.at("scaling")) {
    text += fmt::format("| {} | {} | {:.0f} % |\n", row.at("threads").get<int>(),
                        time_of(row.at("seconds")), 100.0 * row.at("efficiency").get<double>());
  }
  return text + "\n";
}

std::string peer_row(const Json& one) {
  std::string setting = one.at("method");
  if (one.contains("rtol")) setting += fmt::format(", rtol {:g}", one.at("rtol").get<double>());
  if (one.contains("epsfcn")) {
    setting += one.at("epsfcn").is_null()
                   ? std::string(", epsfcn of the machine")
                   : fmt::format(", epsfcn {:g}", one.at("epsfcn").get<double>());
  }
  const auto ratio = [&](std::size_t i) { return one.at("std_error_ratio")[i].get<double>(); };
  return fmt::format(
      "| {} | {} | {} | {:.2g} | {:.2g} | {} | {} |\n", one.at("name").get<std::string>(), setting,
      time_of(one.at("seconds")), one.at("largest_difference").get<double>(),
      one.at("chi2_above_yardstick").get<double>(),
      one.contains("std_error_ratio") ? fmt::format("{:.3g} to {:.3g}", ratio(0), ratio(1))
                                      : "none",
      one.at("verdict").get<std::string>());
}

std::string peer_section(const Json& peer) {
  std::string text = fmt::format(
      "## The same fit elsewhere\n\n"
      "{} points, {} free parameters, the same start and the same residuals; one process and one "
      "thread each, without the start of the process. Distances are from recoil's fit on CVODES, "
      "in "
      "its standard errors, the largest of the three parameters; chi2 is computed with CVODES at "
      "everybody's estimate. lmfit and R take differences, recoil has the gradient. `leastsq` and "
      "`nls.lm` stop at 1.5e-8, recoil at the same number. recoil's whole `fit`, from nine starts "
      "and to the last digit, takes {}.\n\n"
      "| fit | setting | time | distance | chi2 above that fit's | std. errors, ratio | verdict |\n"
      "|---|---|---|---|---|---|---|\n",
      peer.at("points").get<int>(), peer.at("free_parameters").get<int>(),
      time_of(peer.at("fits")[0].at("seconds_of_full_fit")));
  for (const Json& one : peer.at("fits")) text += peer_row(one);
  if (peer.contains("lmfit_versions")) {
    text += "\nWith " + versions_text(peer.at("lmfit_versions")) + ".";
  }
  if (peer.contains("r_versions")) text += " With " + versions_text(peer.at("r_versions")) + ".";
  if (peer.contains("missing")) {
    for (const Json& name : peer.at("missing")) {
      text += fmt::format("\nNot run: {}.", name.get<std::string>());
    }
  }
  return text + "\n\n";
}

std::string scaling_section(const Json& results) {
  std::string text =
      "## Cost against size\n\nOne fit from one start, as `recoil fit` runs it before its "
      "bootstrap; "
      "every row in a process of its own. Memory is the largest resident size of the process.\n\n"
      "| points | free parameters | time | peak memory |\n|---|---|---|---|\n";
  for (const Json& one : results.at("scaling")) {
    text +=
        fmt::format("| {} | {} | {} | {:.0f} MB |\n", count_text(one.at("points").get<double>()),
                    one.at("free_parameters").get<int>(), time_of(one.at("seconds")),
                    one.at("peak_memory_mb").get<double>());
  }
  const Json& exponents = results.at("scaling_exponents");
  text += fmt::format(
      "\nSlopes of straight lines in log-log: the time grows like points^{:.2f} and like (free "
      "parameters)^{:.2f}",
      exponents.at("seconds_over_points").get<double>(),
      exponents.at("seconds_over_free_parameters").get<double>());
  if (!exponents.at("memory_over_points").is_null()) {
    text += fmt::format(
        ", the memory above that of the idle program, from 10,000 points on, like "
        "points^{:.2f}",
        exponents.at("memory_over_points").get<double>());
  }
  return text + ".\n\n";
}

std::string shipped_section(const Json& shipped) {
  return fmt::format(
      "## Every fit that is shipped\n\nWhat `./run` does once recoil is built, nothing kept from "
      "an earlier time: {} fits with their uncertainties and diagnoses, as {} pages. It took {} on "
      "all cores.\n",
      shipped.at("fits").get<int>(), shipped.at("pages").get<int>(),
      time_of(shipped.at("seconds")));
}

/// Seconds and, where it was measured, memory.
std::string cost_text(double seconds, double memory_mb) {
  const std::string time = time_text(seconds);
  return memory_mb > 0.0 ? fmt::format("{}, {:.0f} MB", time, memory_mb) : time;
}

/// The figures of this run by the keys of earlier ones: seconds, and memory [MB] where it is kept.
std::map<std::string, std::pair<double, double>> figures_of(const Json& results) {
  std::map<std::string, std::pair<double, double>> figures;
  const Json& impact = results.at("impact_with_gradient");
  figures["ring"] = {impact.at("fast_ns").get<double>() * 1e-9, 0.0};
  figures["reference"] = {impact.at("reference_ns").get<double>() * 1e-9, 0.0};
  for (const Json& law : impact.value("laws", Json::array())) {
    figures[law.at("adhesion").get<std::string>()] = {law.at("fast_ns").get<double>() * 1e-9, 0.0};
  }
  figures["full_fit"] = {results.at("peer").at("fits")[0].at("seconds_of_full_fit").get<double>(),
                         0.0};
  for (const Json& row : results.at("bootstrap").at("scaling")) {
    figures[fmt::format("refits_{}", row.at("threads").get<int>())] = {
        row.at("seconds").get<double>(), 0.0};
  }
  const Json& largest = largest_case(results.at("scaling"));
  figures[fmt::format("points_{}", largest.at("points").get<std::size_t>())] = {
      largest.at("seconds").get<double>(), largest.at("peak_memory_mb").get<double>()};
  figures["shipped_fits"] = {results.at("shipped_fits").at("seconds").get<double>(), 0.0};
  return figures;
}

}  // namespace

std::string earlier_section(const Json& results, const Json& earlier) {
  const auto now = figures_of(results);
  std::string text = fmt::format(
      "## Beside what it was\n\nThe same measurements by `./run bench` of {}. The last column "
      "takes "
      "the machine out: it counts both times in those of the reference, an impact by CVODES, which "
      "has not changed.\n\n"
      "| what | was | is | ratio | in the reference's time |\n|---|---|---|---|---|\n",
      earlier.at("of").get<std::string>());
  const double machine = now.at("reference").first / earlier.at("reference_seconds").get<double>();
  for (const Json& one : earlier.at("figures")) {
    const auto found = now.find(one.at("key").get<std::string>());
    if (found == now.end()) continue;
    const auto& [seconds, memory] = found->second;
    const double before = one.at("seconds");
    text += fmt::format("| {} | {} | {} | {} | {} |\n", one.at("what").get<std::string>(),
                        cost_text(before, one.value("memory_mb", 0.0)), cost_text(seconds, memory),
                        ratio_text(before / seconds), ratio_text(before / seconds * machine));
  }
  return text + "\n";
}

std::string common_section(const Json& rows) {
  std::string text =
      "## Common fits\n\nCPU time of `recoil fit --threads 1`, the whole program with all "
      "intervals, median of three runs. lmfit: one fit of the same points by its careful setting, "
      "without intervals and without the start of the process.\n\n"
      "| `recoil fit` of | CPU time | lmfit | ratio |\n|---|---|---|---|\n";
  for (const Json& row : rows) {
    const double seconds = row.at("seconds");
    text += fmt::format("| {} | {} |", row.at("what").get<std::string>(), time_text(seconds));
    if (row.contains("lmfit_seconds")) {
      const double lmfit = row.at("lmfit_seconds");
      text += fmt::format(" {} | {} |\n", time_text(lmfit), ratio_text(lmfit / seconds));
    } else {
      text += " | |\n";
    }
  }
  return text + "\n";
}

std::string short_table(const Json& results) {
  const Json& impact = results.at("impact_with_gradient");
  const Json& bootstrap = results.at("bootstrap");
  const Json& peer = results.at("peer");
  const Json& largest = largest_case(results.at("scaling"));
  std::string text = "| what | recoil | the same elsewhere | ratio |\n|---|---|---|---|\n";
  text += fmt::format(
      "| one impact: e^2 and its gradient, one thread | {} | {}: CVODES with forward sensitivities "
      "| "
      "{} |\n",
      time_text(impact.at("fast_ns").get<double>() * 1e-9),
      time_text(impact.at("reference_ns").get<double>() * 1e-9),
      ratio_text(impact.at("ratio").get<double>()));
  const std::string own = time_of(peer.at("recoil_seconds_per_fit"));
  const std::string fit =
      fmt::format("one fit: {} points, {} free parameters, one thread",
                  peer.at("points").get<int>(), peer.at("free_parameters").get<int>());
  if (!peer.at("ratio").is_null()) {
    text += fmt::format("| {} | {} | {}: Python, lmfit and scipy | {} |\n", fit, own,
                        time_of(peer.at("lmfit_seconds_per_fit")),
                        ratio_text(peer.at("ratio").get<double>()));
  }
  if (peer.contains("r_ratio")) {
    text += fmt::format("| {} | {} | {}: R, minpack.lm and deSolve | {} |\n", fit, own,
                        time_of(peer.at("r_seconds_per_fit")),
                        ratio_text(peer.at("r_ratio").get<double>()));
  }
  text += fmt::format("| {} such refits (bootstrap), {} threads | {} | {} | |\n",
                      bootstrap.at("replicates").get<int>(), bootstrap.at("threads").get<int>(),
                      time_of(bootstrap.at("seconds")),
                      peer.contains("lmfit_seconds_per_1999_refits")
                          ? "*" + time_of(peer.at("lmfit_seconds_per_1999_refits")) +
                                "*: Python, one thread, *extrapolated*"
                          : std::string("not run"));
  text += fmt::format("| one fit of {} points, {} free parameters | {}, {:.0f} MB | | |\n",
                      count_text(largest.at("points").get<double>()),
                      largest.at("free_parameters").get<int>(), time_of(largest.at("seconds")),
                      largest.at("peak_memory_mb").get<double>());
  return text +
         fmt::format(
             "\nThe last column holds ratios of the two times before it, measured in one run on "
             "one machine; what is extrapolated is the time of one fit times {}, and was not "
             "run. Machine: {}\n",
             bootstrap.at("replicates").get<int>(), machine_text(results));
}

std::string benchmark_page(const Json& results, const Json& earlier) {
  return std::string("# How fast\n\n") + begin_marker + short_table(results) + end_marker + "\n" +
         earlier_section(results, earlier) + impact_section(results.at("impact_with_gradient")) +
         bootstrap_section(results.at("bootstrap")) + peer_section(results.at("peer")) +
         common_section(results.at("common")) + scaling_section(results) +
         shipped_section(results.at("shipped_fits"));
}

namespace {

/// Where the block begins and how long it is.
std::pair<std::size_t, std::size_t> block_of(const std::string& text) {
  const std::string begin = begin_marker;
  const std::size_t first = text.find(begin);
  const std::size_t last = text.find(end_marker);
  if (first == std::string::npos || last == std::string::npos || last < first + begin.size() ||
      text.find(begin, first + 1) != std::string::npos ||
      text.find(end_marker, last + 1) != std::string::npos) {
    throw std::invalid_argument("the markers of the benchmark table are not there once each");
  }
  return {first + begin.size(), last - first - begin.size()};
}

}  // namespace

std::string between_markers(const std::string& text) {
  const auto [begin, length] = block_of(text);
  return text.substr(begin, length);
}

std::string with_block(const std::string& text, const std::string& block) {
  const auto [begin, length] = block_of(text);
  return std::string(text).replace(begin, length, block);
}

}  // namespace recoil::bench
