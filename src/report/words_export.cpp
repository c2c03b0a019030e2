#include "report/words_export.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/program.hpp"
#include "core/units.hpp"
#include "document/terminal.hpp"
#include "report/format.hpp"
#include "report/words_dataset.hpp"

namespace recoil {
namespace {

constexpr std::size_t comment_columns = 78;
constexpr double poor_rms = 0.1;  // of e, from which an approximation is called poor

std::string stock_words(const Approximation& stock) {
  switch (stock.model) {
    case StockModel::constant_restitution:
      return fmt::format("the constant restitution e = {:.4f}", stock.value);
    case StockModel::hertz_dashpot:
      return fmt::format("Hertz with the damping -D n^(1/2) n', D = {:.5g} N s m^(-3/2)",
                         stock.value);
    case StockModel::jkr:
      return fmt::format(
          "granular jkr with the damping -eta m a n' and the surface energy gamma, eta = {:.5g} "
          "1/(m s), gamma = {:.5g} J/m2",
          stock.value, stock.energy);
  }
  return "";
}

std::string why_no_force(ExportTarget target, const ExportedImpact& impact) {
  if (target == ExportTarget::liggghts) {
    return "LIGGGHTS has no way to state a force law in its input";
  }
  if (impact.of_nature.empty()) return "the program cannot run this law of adhesion";
  return fmt::format(
      "{} {} no force in the equation of motion",
      joined(impact.of_nature, " and ", [](const Mechanism* one) { return one->info.id; }),
      impact.of_nature.size() == 1 ? "is" : "are");
}

std::string range_words(const ExportRequest& request) {
  return fmt::format("V from {:.4g} to {:.4g} m/s", request.slowest, request.fastest);
}

/// @param elsewhere the capture velocity in the other program [m/s]; 0: it captures none
std::string capture_words(const ExportedImpact& impact, double elsewhere) {
  if (elsewhere > 0.0) {
    return impact.captures
               ? fmt::format("Captures are kept, with V* = {:.4g} m/s instead of {:.4g} m/s.",
                             elsewhere, impact.capture_velocity)
               : fmt::format("This export captures below V* = {:.4g} m/s, the fit does not.",
                             elsewhere);
  }
  if (!impact.captures) return "Neither the fit nor this export captures spheres of this size.";
  return fmt::format(
      "The capture velocity is LOST: in the fit a sphere slower than V* = {:.4g} m/s stays, here "
      "it bounces.",
      impact.capture_velocity);
}

void wrap_into(std::vector<std::string>& lines, const std::string& text) {
  for (std::string& line : lines_of(wrap(text, comment_columns, 0))) {
    lines.push_back(std::move(line));
  }
}

std::string parameter_words(const ExportedParameter& p) {
  const std::string unit = p.unit.empty() || p.unit == "1" ? "" : " " + p.unit;
  if (p.std_error) {
    return fmt::format("  {} = {:.6g} +/- {:.2g}{}", p.label, p.value, *p.std_error, unit);
  }
  return fmt::format("  {} = {:.6g}{} ({})", p.label, p.value, unit,
                     p.free ? "no standard error" : "not fitted");
}

/// The error of e(V) in the other program, and the treatment of captures.
std::vector<std::string> export_losses(ExportTarget target, const ExportJob& job) {
  std::vector<std::string> out;
  const ExportedImpact& impact = job.impact;
  const bool stock_asked = impact.force_is_all && target != ExportTarget::liggghts;
  if (job.form == ExportForm::force) {
    out.push_back(fmt::format(
        "The force law is the model's own: e differs only by the error of the time step of {:.2g} "
        "ns, which is below 1e-4 from 5 % above capture on and proportional to the step.",
        time_step(impact) / units::ns));
    out.push_back(
        impact.captures
            ? fmt::format("The capture velocity is kept: V* = {:.4g} m/s.", impact.capture_velocity)
            : "Neither the fit nor this export captures spheres of this size.");
  } else if (job.form == ExportForm::refitted) {
    const RefittedForce& other = *job.refitted;
    out.push_back(fmt::format(
        "An approximation, as {}: the ring law with C_H = {:.5g} s/m, C_A = {:.5g} s/m and f0 = "
        "{:.5g} N/m, which at this size, and over {}, has the same e up to {:.4f} (rms over log "
        "V); the largest error is {:.4f} at {:.4g} m/s ({:.4f} where the fit rebounds). These "
        "three are not parameters of the fit.",
        why_no_force(target, impact), other.force.hertz_damping, other.force.adhesion_damping,
        other.force.adhesion_force, range_words(impact.request), other.error.rms,
        other.error.largest, other.error.at, other.error.rebounding));
    out.push_back(capture_words(impact, other.capture_velocity));
  } else if (job.form == ExportForm::approximation) {
    const RestitutionError& error = job.stock->error;
    out.push_back(fmt::format("An approximation, as {}: {}.",
                              stock_asked ? "--stock was given" : why_no_force(target, impact),
                              stock_words(*job.stock)));
    out.push_back(fmt::format(
        "{} error of e over {}, evenly spaced in log V: {:.4f} (rms); the largest error is {:.4f} "
        "at "
        "{:.4g} m/s ({:.4f} where the fit rebounds).",
        job.stock->model == StockModel::jkr ? "Chosen by least squares of e^2; the"
                                            : "This value has the smallest rms",
        range_words(impact.request), error.rms, error.largest, error.at, error.rebounding));
    out.push_back(capture_words(impact, job.stock->capture_velocity));
  } else if (target != ExportTarget::table) {
    out.push_back(
        fmt::format("e(V, d) is looked up in a table: e is within {:.1g} of the fit between its "
                    "nodes{}, for {}.",
                    job.lookup->error, job.lookup->captures ? " from 1 % above capture" : "",
                    range_words(impact.request)));
    if (!job.lookup->captures) {
      out.push_back("Below the range of velocities the first value of the table holds.");
    } else if (job.lookup->diameter.size() > 1) {
      out.push_back(fmt::format(
          "Captures are kept; between the sizes the relative error of V* is at most {:.1g}.",
          job.lookup->capture_error));
    } else {
      out.push_back(fmt::format("Captures are kept: V* = {:.4g} m/s.", job.lookup->scale.front()));
    }
    out.push_back("The model covers normal impact only, without a tangential velocity.");
  }
  for (const Mechanism* mechanism : impact.of_measurement) {
    out.push_back(
        fmt::format("{} is an error of the measurement and is not exported.", mechanism->info.id));
  }
  return out;
}

/// The values that an engineer copies into another input; empty if they are a table.
std::string copied_words(ExportTarget target, const ExportJob& job) {
  const ContactForce& force = job.force;
  if (job.form == ExportForm::lookup) return "";
  if (job.form != ExportForm::approximation) {
    std::string values;
    const auto add = [&](const char* name, double value, const char* unit) {
      if (value != 0.0) values += fmt::format("{} = {:.5g} {}, ", name, value, unit);
    };
    add("C_H", force.hertz_damping, "s/m");
    add("C_A", force.adhesion_damping, "s/m");
    add("f0", force.adhesion_force, "N/m");
    add("D", force.dashpot, "N s m^(-3/2)");
    return fmt::format("To copy: {}K = {:.5g} Pa.", values, force.stiffness);
  }
  const Approximation& stock = *job.stock;
  std::string values;
  switch (stock.model) {
    case StockModel::constant_restitution:
      values = fmt::format("{} = {:.5g}, K = {:.5g} Pa",
                           target == ExportTarget::liggghts ? "coefficientRestitution" : "e",
                           stock.value, force.stiffness);
      break;
    case StockModel::hertz_dashpot:
      values = fmt::format("D = {:.5g} N s m^(-3/2), K = {:.5g} Pa", stock.value, force.stiffness);
      break;
    case StockModel::jkr:
      values = fmt::format(
          "jkr with E = {:.5g} Pa, eta = {:.5g} 1/(m s), nu = 0, gamma = {:.5g} J/m2, damping "
          "viscoelastic",
          1.5 * force.stiffness, stock.value, stock.energy);
      break;
  }
  return "To copy: " + values + ".";
}

/// Where the copied values hold, and how well.
std::string quality_words(const ExportJob& job) {
  if (job.form != ExportForm::approximation) return "";
  const RestitutionError& error = job.stock->error;
  const auto capture = [](double v) { return v > 0.0 ? fmt::format("{:.4g} m/s", v) : "none"; };
  return fmt::format(
      "{}For {:.4g} um, {}: error of e {:.3f} (rms), {:.3f} (largest); V* {}, of the fit {}.",
      error.rms > poor_rms ? "A POOR APPROXIMATION. " : "", 2.0 * job.force.radius / units::um,
      range_words(job.impact.request), error.rms, error.largest,
      capture(job.stock->capture_velocity), capture(job.impact.capture_velocity));
}

}  // namespace

std::vector<std::string> export_heading(ExportTarget target, const ExportSource& source,
                                        const ExportJob& job) {
  std::vector<std::string> lines;
  wrap_into(lines, fmt::format("recoil {}: the impact of {} for {}", version(), source.fit,
                               to_string(target)));
  for (const std::string& words : {copied_words(target, job), quality_words(job)}) {
    if (!words.empty()) wrap_into(lines, words);
  }
  wrap_into(lines,
            fmt::format("Fitted to {} ({}). {}", source.dataset, to_string(source.provenance),
                        provenance_sentence(source.provenance)));
  wrap_into(lines, fmt::format("Parameters, {}:", source.parameters));
  for (const ExportedParameter& value : source.values) lines.push_back(parameter_words(value));
  if (std::isfinite(source.rmse)) {
    wrap_into(lines, fmt::format("Its e differs from these points by {:.2g} (rms).", source.rmse));
  }
  if (!source.misfit.empty()) wrap_into(lines, source.misfit);
  if (job.form != ExportForm::lookup) {
    wrap_into(lines, fmt::format("A sphere of {:.6g} um, {:.6g} kg/m3; K = {:.6g} GPa. Adhesion: "
                                 "{}, its damping acts in phase \"{}\".",
                                 2.0 * job.force.radius / units::um, job.force.density,
                                 job.force.stiffness / units::GPa, to_string(job.force.adhesion),
                                 to_string(job.force.phase)));
  }
  if (job.impact.surface_diameter > 0.0) {
    wrap_into(
        lines,
        fmt::format(
            "Both bodies are spheres, of {:.6g} um and {:.6g} um. e is that of their relative "
            "velocity; a force law is that of one sphere on a flat that has their R* and m*.",
            job.impact.request.diameter / units::um, job.impact.surface_diameter / units::um));
  }
  for (const std::string& sentence : export_losses(target, job)) wrap_into(lines, sentence);
  return lines;
}

std::string export_use(ExportTarget target) {
  using enum ExportTarget;
  static constexpr Phrase<ExportTarget> phrases[] = {
      {lammps, "lmp -in impact.lammps -var V 2.4"},
      {liggghts, "liggghts -in impact.liggghts -var V 2.4"},
      {yade, "yade -n -x impact.py 2.4"},
      {openfoam, "wmake in recoilRebound, then libs (\"librecoilRebound.so\"); in controlDict"},
      {fluent, "compile recoil_rebound.c as a user-defined function of the wall"},
      {table, "restitution.csv has e(V, d), capture.csv V*(d)"}};
  return phrase_for(phrases, target).words;
}

}  // namespace recoil
