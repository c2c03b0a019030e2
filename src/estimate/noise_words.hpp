#pragma once

#include "estimate/fit.hpp"

namespace recoil {

/// Adds to `result.noise_text` what was taken as noise beside the stated standard deviations, with
/// numbers, and to its warnings where an approximation is strained.
void describe_noise(FitResult& result);

/// The scale of an estimated variance function in words: "sd(e) = 0.021 for every impact".
std::string scale_in_words(VarianceFunction function, double scale);

/// How far the next best candidate lies behind the chosen one, handicaps included, on -2 ln
/// restricted likelihood; 0 without a choice.
double choice_margin(const NoiseModel& noise);

}  // namespace recoil
