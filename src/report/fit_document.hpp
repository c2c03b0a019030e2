#pragma once

#include <string>
#include <vector>

#include "document/document.hpp"
#include "report/report.hpp"

namespace recoil {

/// The answer in a few sentences: the points, the estimates, how well they fit, the two-point
/// calibration beside them.
Sentence fit_summary(const Analysis& analysis);

/// Where the points come from, one banner per kind.
std::vector<Block> provenance_banners(const std::vector<Dataset>& datasets);

/// What every symbol and word of the page means.
Glossary glossary(const Analysis& analysis);

/// What `recoil fit` prints. An unusable fit has the sections that it can have, and its failure.
std::vector<Section> fit_sections(const Analysis& analysis);

/// The page: pictures first, then the same sections as above, inputs, every point, a glossary.
/// @param diagnosis what the model gets wrong; may be empty
Document fit_document(const Analysis& analysis, std::vector<Block> diagnosis = {});

}  // namespace recoil
