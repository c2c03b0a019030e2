#pragma once

#include "document/document.hpp"
#include "plot/plot.hpp"
#include "validation/studies/hidden_effects_tally.hpp"

namespace hidden {

recoil::Document hidden_effects_page(const StudyTally& tally);

/// Power against strength, and the confusion matrix, as one picture.
recoil::plot::Picture hidden_effects_picture(const StudyTally& tally);

}  // namespace hidden
