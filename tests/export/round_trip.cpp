#include "round_trip.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

const std::vector<double> RoundTrip::velocities = {0.55, 0.9, 1.2, 1.7, 2.4, 5.0, 12.0, 25.0};

RoundTrip::RoundTrip(const std::string& fit, bool adhesion) {
  if (!adhesion) {
    place_.change("data/datapackage.json", "\"recoil\": {",
                  "\"recoil\": { \"adhesion_energy\": 0,");
  }
  place_.write("fit.toml", fit);
  const support::Outcome fitted =
      place_.run({"fit", "fit.toml", "--replicates", "0", "--out", "fitted"});
  EXPECT_EQ(fitted.status, 0) << fitted.err;
}

std::string RoundTrip::write(const std::string& target, const std::string& out,
                             const std::string& range, const std::vector<std::string>& more) const {
  std::vector<std::string> words = {"export",     "fit.toml", "--parameters", "fitted/fit.json",
                                    "--to",       target,     "--diameter",   "4",
                                    "--velocity", range,      "--out",        out};
  words.insert(words.end(), more.begin(), more.end());
  const support::Outcome run = place_.run(words);
  EXPECT_EQ(run.status, 0) << run.err;
  // one line, whatever its breaks
  return std::regex_replace(run.out, std::regex("\n *"), " ");
}

double RoundTrip::expected(double velocity) const {
  const support::Outcome run =
      place_.run({"simulate", "fit.toml", "--parameters", "fitted/fit.json", "--diameter", "4",
                  "--velocity", fmt::format("{}", velocity)});
  EXPECT_EQ(run.status, 0) << run.err;
  const double e = number_after(run.out, "restitution: ");
  return run.out.find("outcome: captured") == std::string::npos ? e : 0.0;
}

double RoundTrip::run(const std::vector<std::string>& command) const {
  const support::Outcome run = support::run_command(command, place_.path());
  EXPECT_EQ(run.status, 0) << fmt::format("{}", fmt::join(command, " ")) << ": " << run.out
                           << run.err;
  const std::size_t last = run.out.rfind("\nrestitution ");
  if (last == std::string::npos && run.out.rfind("restitution ", 0) != 0) {
    ADD_FAILURE() << fmt::format("{}", fmt::join(command, " ")) << " printed no restitution:\n"
                  << run.out << run.err;
    return std::nan("");
  }
  return number_after(last == std::string::npos ? run.out : run.out.substr(last), "restitution ");
}

double RoundTrip::lammps(const std::string& out, double velocity, const std::string& dt) const {
  // Each run keeps what Open MPI makes to itself: two that start at once can be in each other's
  // way.
  std::vector<std::string> command = {"env",
                                      "TMPDIR=" + place_.path().string(),
                                      "OMPI_MCA_ess_singleton_isolated=1",
                                      "lmp",
                                      "-nocite",
                                      "-log",
                                      "none",
                                      "-in",
                                      out + "/impact.lammps",
                                      "-var",
                                      "V",
                                      fmt::format("{}", velocity)};
  if (!dt.empty()) command.insert(command.end(), {"-var", "dt", dt});
  return run(command);
}

double RoundTrip::liggghts(const std::string& out, double velocity) const {
  return run({"env", "TMPDIR=" + place_.path().string(), "OMPI_MCA_ess_singleton_isolated=1",
              "liggghts", "-log", "none", "-in", out + "/impact.liggghts", "-var", "V",
              fmt::format("{}", velocity)});
}

double number_after(const std::string& text, const std::string& words) {
  const std::size_t at = text.find(words);
  if (at == std::string::npos) {
    ADD_FAILURE() << "'" << words << "' is missing in:\n" << text;
    return std::nan("");
  }
  return std::strtod(text.c_str() + at + words.size(), nullptr);
}
