#pragma once

#include <string>
#include <vector>

#include "analysis/analysis.hpp"
#include "document/document.hpp"

namespace recoil {

/// One fit of the index: its files as they were written.
struct IndexEntry {
  std::string page;                 ///< relative address of the page of the fit
  std::string fit_json;             ///< content of fit.json
  std::string diagnosis_json = {};  ///< content of diagnosis.json; empty without a diagnosis
  std::string diagnosis_page = {};  ///< relative address of the page of the diagnosis
  std::string picture = {};         ///< SVG to inline; may be empty
  std::string picture_csv = {};     ///< the numbers in the picture
};

/// A small picture of e(V) for the index, as SVG and as comma-separated values.
std::string thumbnail(const Analysis& analysis);
std::string thumbnail_csv(const Analysis& analysis);

/// One card per fit: origin, verdict, picture, capture velocity and parameters.
/// @throws InputError when a file is not the JSON of a fit or of a diagnosis
Document index_document(const std::vector<IndexEntry>& entries);

/// The file `index.html`.
std::string html_index(const std::vector<IndexEntry>& entries);

}  // namespace recoil
