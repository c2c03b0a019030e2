#pragma once

#include <string>
#include <utility>
#include <vector>

#include "support/workplace.hpp"

/// A fit that is exported, run elsewhere, and compared with recoil's own answers.
class RoundTrip {
 public:
  /// @param fit the text of the fit file; its values are used as they stand in fit.json after a fit
  /// @param adhesion false: the materials attract each other no more
  explicit RoundTrip(const std::string& fit, bool adhesion = true);

  /// `recoil export` of 4 um, from 0.5 to 25 m/s unless `range` says otherwise, into `out`; what it
  /// printed.
  std::string write(const std::string& target, const std::string& out,
                    const std::string& range = "0.5,25",
                    const std::vector<std::string>& more = {}) const;
  /// e as `recoil simulate` has it; 0 for a capture.
  double expected(double velocity) const;
  /// The last "restitution E" that a command prints; fails the test when there is none.
  double run(const std::vector<std::string>& command) const;

  double lammps(const std::string& out, double velocity, const std::string& dt = "") const;
  double liggghts(const std::string& out, double velocity) const;

  const support::Workplace& place() const { return place_; }

  /// Eight velocities; the first is captured by every fit of these tests that captures at all.
  static const std::vector<double> velocities;

 private:
  support::Workplace place_;
};

/// The number that follows `words` in `text`; fails the test when it is missing.
double number_after(const std::string& text, const std::string& words);
