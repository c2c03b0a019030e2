#pragma once

#include <string>
#include <vector>

#include "analysis/analysis.hpp"
#include "cli/options.hpp"
#include "core/files.hpp"
#include "document/document.hpp"

namespace recoil {

/// FIT, a required fit file. One that is not there is refused with the name of
/// one that is.
void add_fit_file(const Command& command, std::string& fit_file);

/// The same for any number of them, none required.
Option add_fit_files(const Command& command, std::vector<std::string>& fits,
                     const std::string& meaning);

/// The options that every analysing command shares, as given.
struct AnalysisFlags {
  std::string replicates;  ///< a number or "auto"; empty: the fit file's
  std::string scheme;      ///< empty: the fit file's
  std::int64_t seed = -1;
  int threads = 0;
  std::string solver = "fast";

  AnalysisOptions resolved() const;
};

void add_analysis_flags(const Command& command, AnalysisFlags& flags);

/// --json: the result as JSON on standard output in place of the words.
void add_json_flag(const Command& command, bool& json);

/// --verbose: the details behind the answer, too.
void add_verbose_flag(const Command& command, bool& verbose);

inline Importance importance_of(bool verbose) {
  return verbose ? Importance::detail : Importance::answer;
}

/// Writes the files of a result. If they cannot be written the result is printed, so that the work
/// is not lost, before the error is thrown. @throws InputError
void write_or_print(const std::vector<WholeFile>& files, const std::string& result);

}  // namespace recoil
