#pragma once

#include <string>
#include <vector>

#include "document/document.hpp"
#include "predict/law_choice.hpp"
#include "report/comparison_document.hpp"

namespace recoil {

/// A fit under its own law of adhesion and others, as `recoil compare` would see them, but for the
/// intervals: these are 1.96 standard errors wide on either side. Laws without an answer are left
/// out.
std::vector<ComparedFit> compared_laws(const std::vector<LawFit>& laws,
                                       const std::vector<Dataset>& datasets);

/// The laws side by side, and what depends on the choice. Nothing to say of fewer than two.
Section laws_section(const std::vector<ComparedFit>& laws);

/// laws.json: what `laws_section` says, for scripts and for the index of a later run.
std::string laws_json(const std::vector<ComparedFit>& laws);

/// @param page names it in messages
/// @throws InputError when it is not what `laws_json` has written.
std::vector<ComparedFit> read_laws(const std::string& page, const std::string& json);

}  // namespace recoil
