#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "export/approximation.hpp"
#include "export/lookup.hpp"

namespace recoil {

/// The input of the writers in files.hpp.
struct ExportJob {
  ExportedImpact impact;
  ExportForm form = ExportForm::lookup;
  ContactForce force;                       ///< to be written: the fit's, or a refitted one
  std::optional<Approximation> stock;       ///< for ExportForm::approximation
  std::optional<RefittedForce> refitted;    ///< for ExportForm::refitted
  std::optional<RestitutionLookup> lookup;  ///< for ExportForm::lookup
  std::vector<std::string> heading;         ///< lines of text: the fit, and what is omitted
};

/// Time steps in the shortest contact of the range. The velocity Verlet schemes of the programs use
/// the velocity of half a step before in the force, so that the error of e is proportional to the
/// step: about 1e-5 here.
inline constexpr double steps_per_contact = 10000.0;

/// The time step of an exact export, rounded to two digits [s].
double time_step(const ExportedImpact& impact);

/// The longest duration of a run; a sphere still in contact then has stayed [s].
double longest_run(const ExportJob& job);

/// The default incident velocity, the geometric mean of the range, rounded to two digits [m/s].
double typical_velocity(const ExportedImpact& impact);

/// `value` rounded to this number of significant digits.
double rounded(double value, int digits);

/// The shortest decimal text that reads back as the same number.
std::string shortest(double value);

/// `text` with every @NAME@ replaced by its value. @pre every name has a value
std::string filled(std::string_view text,
                   std::initializer_list<std::pair<std::string_view, std::string>> values);

/// The lines as comments, each after `mark` ("# ").
std::string commented(const std::vector<std::string>& lines, std::string_view mark);

}  // namespace recoil
