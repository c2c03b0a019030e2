#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/diagnosis_result.hpp"
#include "document/document.hpp"
#include "report/comparison_document.hpp"
#include "report/report.hpp"

namespace recoil {

/// What the index shows of one parameter.
struct ParameterSummary {
  std::string label;
  std::string unit;
  double value = 0.0;
  bool free = true;
  std::optional<Ends> interval;   ///< the recommended one
  std::optional<Ends> two_point;  ///< by two points; of several datasets the range of theirs
};

/// What the index shows of one fit.
struct FitSummary {
  std::string id;
  std::string title;  ///< of its dataset; empty for several
  std::vector<std::string> datasets;
  std::size_t points = 0;
  std::vector<std::pair<std::string, std::string>> provenances;  ///< (label, sentence)
  std::vector<ParameterSummary> parameters;
  double rmse = 0.0;  ///< of e [1]
  std::optional<Ends> two_point_rmse;
  double chi2 = 0.0;
  int dof = 0;
  std::optional<double> p_value;
  std::optional<Verdict> verdict;  ///< of the diagnosis, where there is one
  std::string headline;
  std::vector<ComparedFit> laws =
      {};  ///< the fit under its own law of adhesion and others; may be empty
};

FitSummary summary_of(const Analysis& analysis);

/// The same with the answer of its diagnosis.
FitSummary summary_of(const Analysis& analysis, const Diagnosis& diagnosis);

/// The same from the files that an earlier run has left. @param diagnosis_json empty: there is none
/// @param page names the fit in messages
/// @throws InputError when they are not the JSON of a fit and of a diagnosis
FitSummary read_summary(const std::string& page, const std::string& fit_json,
                        const std::string& diagnosis_json = "");

/// One card of the index.
struct IndexEntry {
  std::string page;  ///< relative address of the fit's page
  FitSummary fit;
  std::string picture;              ///< an SVG thumbnail to inline, may be empty
  std::string diagnosis_page = {};  ///< relative address of the page of the diagnosis
  std::string picture_csv = {};     ///< the numbers in the picture
};

Table summary_table(const FitSummary& fit);

/// A card per fit, side by side.
Document index_document(const std::vector<IndexEntry>& entries);

/// `index.html`.
std::string html_index(const std::vector<IndexEntry>& entries);

}  // namespace recoil
