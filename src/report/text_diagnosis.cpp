#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/units.hpp"
#include "report/diagnosis_report.hpp"
#include "report/format.hpp"

namespace recoil {
namespace {

constexpr std::size_t columns = 100;
constexpr std::size_t most_candidates = 12;

std::string candidate_lines(const std::vector<CandidateResult>& candidates) {
  std::string out = fmt::format("    {:<36} {:>9} {:>9} {:>10} {:>9}\n", "cause", "dAICc", "p",
                                "held out", "leaves p");
  std::size_t shown = 0;
  for (const CandidateResult& c : candidates) {
    if (++shown > most_candidates) break;
    out += fmt::format("    {:<36} {:>9.1f} {:>9} {:>10} {:>9}\n", c.candidate.name(), c.delta_aicc,
                       c.p_value ? p_value_text(*c.p_value) : "",
                       c.gain ? fmt::format("{:+.0f} %", 100.0 * c.gain->relative) : "",
                       p_value_text(c.remaining_p));
    if (!c.aside.empty()) out += fmt::format("      {}\n", wrap(c.aside, columns - 6, 6));
  }
  return out;
}

}  // namespace

std::string diagnosis_text(const Diagnosis& d) {
  std::string out = fmt::format("[[Verdict]]\n    {}\n    {}\n", to_string(d.verdict),
                                wrap(d.text, columns - 4, 4));
  for (const auto& [label, sentence] : provenances(d.datasets)) {
    out += fmt::format("    {}: {}\n", label, wrap(sentence, columns - 8, 8));
  }
  for (const std::string& remark : d.remarks) {
    out += fmt::format("    {}\n", wrap(remark, columns - 4, 4));
  }
  out += fmt::format("[[Residuals of the base model]] ({} simulated data sets)\n",
                     d.structure.simulated);
  for (const StructureTest& test : d.structure.tests) {
    out +=
        fmt::format("    {:<10} p = {:<9} {}\n", test.id, p_value_text(test.p_value), test.title);
  }
  out += "[[Where it misses]] e - e_model, in e, in J and in standard errors\n";
  for (const MisfitCell& cell : d.where) {
    out += fmt::format(
        "    {:>7.3g} um {:>8.3g} to {:>6.3g} m/s {:>4} points {:>+9.3f} {:>+11.2e} "
        "{:>+7.1f}\n",
        cell.diameter / units::um, cell.slowest, cell.fastest, cell.points, cell.restitution,
        cell.energy, cell.standardised);
  }
  if (!d.candidates.empty()) out += "[[Causes]]\n" + candidate_lines(d.candidates);
  if (!d.pairs.empty()) out += "[[Two causes at once]]\n" + candidate_lines(d.pairs);
  if (d.gain) {
    out += "[[Gain on held-out blocks]]\n";
    for (const HeldOutGain::PerFold& fold : d.gain->folds) {
      out += fmt::format("    {:<9} {:<22} rms of e {:.4f} -> {:.4f}, ln likelihood {:+.1f}\n",
                         fold.fold.kind, fold.fold.name, fold.rmse_base, fold.rmse_extended,
                         fold.log_score);
    }
  }
  if (d.extended_fit) {
    out += "[[Parameters]] base model -> extended model\n";
    for (std::size_t j = 0; j < d.extended_fit->theta.size(); ++j) {
      const ParameterSlot& slot = d.extended_fit->model.slots[j];
      std::string before = "-";
      for (std::size_t k = 0; k < d.base.theta.size(); ++k) {
        if (d.base.model.slots[k].label() == slot.label()) before = number(d.base.theta[k]);
      }
      out += fmt::format("    {:<22} {:>11} -> {:>11} +/- {:<10} {}\n", slot.label(), before,
                         number(d.extended_fit->theta[j]), number(d.extended_fit->std_error[j], 2),
                         slot.parameter->unit);
    }
  }
  for (const CaptureChange& change : d.capture) {
    out += fmt::format("    V* of {:.3g} um: {} -> {} m/s\n", change.diameter / units::um,
                       change.base ? number(*change.base) : "none",
                       change.extended ? number(*change.extended) : "none");
  }
  if (!d.next.empty()) out += "[[What to measure next]]\n";
  for (const NextMeasurement& next : d.next) {
    out +=
        fmt::format("    {:.3g} um at {:.3g} m/s: {} from {}, {:+.3f} in e, {}\n",
                    next.diameter / units::um, next.velocity, next.one, next.other, next.difference,
                    next.events ? fmt::format("{} events", *next.events) : "beyond 10^6 events");
  }
  for (const std::string& warning : d.warnings) {
    out += fmt::format("[[Warning]] {}\n", wrap(warning, columns - 12, 4));
  }
  return out;
}

}  // namespace recoil
