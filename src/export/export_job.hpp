#pragma once

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "export/approximation.hpp"
#include "export/lookup.hpp"

namespace recoil {

/// A file of an export, whole. `name` is relative to the folder that the user names.
struct ExportedFile {
  std::filesystem::path name;
  std::string text;
};

/// What a writer is given.
struct ExportJob {
  ExportedImpact impact;
  ExportForm form = ExportForm::lookup;
  ContactForce force;                       ///< to be held: the fit's, or a refitted one
  std::optional<Approximation> stock;       ///< where that is the form
  std::optional<RefittedForce> refitted;    ///< where that is the form
  std::optional<RestitutionLookup> lookup;  ///< where that is the form
  std::vector<std::string> heading;         ///< plain lines: which fit, what is lost
};

/// Steps of time in the shortest contact of the range. The programs' velocity Verlet schemes take
/// the velocity of a force half a step late, so that errors of e go with the step: about 1e-5
/// here.
inline constexpr double steps_per_contact = 10000.0;

/// The step of time that an exact export states, of two digits [s].
double time_step(const ExportedImpact& impact);

/// How long a run lasts that is not over before: a sphere that is still there then has stayed [s].
double longest_run(const ExportedImpact& impact);

/// An incident velocity to begin with, the middle of the range, of two digits [m/s].
double typical_velocity(const ExportedImpact& impact);

/// Rounded to so many significant digits.
double rounded(double value, int digits);

/// `text` with every @NAME@ replaced by its value. Every name has to have a value, and every value
/// a place: a writer that breaks this is mistaken.
std::string filled(std::string_view text,
                   std::initializer_list<std::pair<std::string_view, std::string>> values);

/// Each line behind `mark` ("# "), with a line end.
std::string commented(const std::vector<std::string>& lines, std::string_view mark);

}  // namespace recoil
