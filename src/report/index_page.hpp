#pragma once

#include <string>
#include <vector>

#include "analysis/analysis.hpp"
#include "document/document.hpp"

namespace recoil {

/// One fit on the index page: the addresses of its pages and the contents of its files.
struct IndexEntry {
  std::string page;                 ///< relative address of the page of the fit
  std::string fit_json;             ///< content of fit.json
  std::string diagnosis_json = {};  ///< content of diagnosis.json; empty without a diagnosis
  std::string diagnosis_page = {};  ///< relative address of the page of the diagnosis
  std::string picture = {};         ///< SVG element; may be empty
  std::string picture_csv = {};     ///< data of the picture
};

/// A small picture of e(V) for the card of a fit.
plot::Picture thumbnail(const Analysis& analysis);

/// The title of a page that recoil wrote; empty for another text.
std::string title_of_page(const std::string& html);

/// The index page with one card for each fit: provenance, verdict, picture, capture velocity and
/// parameters.
/// @param others links to other pages in its folder
/// @throws InputError if a file is not the JSON of a fit or of a diagnosis
Document index_document(const std::vector<IndexEntry>& entries,
                        const std::vector<Sentence>& others = {});

}  // namespace recoil
