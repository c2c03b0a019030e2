#pragma once

#include <string>
#include <vector>

#include "document/sentence.hpp"
#include "predict/capture_comparison.hpp"
#include "predict/polydisperse.hpp"

/// What predictions have to say, in words.
namespace recoil {

/// "captured spheres count as e = 0", ...
std::string words_of(CaptureConvention convention);

/// "this fit", "JKR", ...: short enough for the key of a picture.
std::string words_of(CaptureModel model);

/// What went into the curve of a model.
Sentence rests_on_words(const CaptureComparison& comparison, CaptureModel model);

/// What could not be drawn, and why.
std::vector<std::string> capture_notes(const CaptureComparison& comparison, const Dataset& dataset);

}  // namespace recoil
