#pragma once

#include <string>

#include "estimate/fit.hpp"

namespace recoil {

/// What a fit took as the noise of its points and what speaks for it, in clauses with semicolons;
/// empty when there is nothing to say.
std::string noise_words(const FitResult& fitted);

/// The scale of an estimated variance function: "sd(e) = 0.021 for every impact".
std::string scale_words(VarianceFunction function, double scale);

/// The factor by which a misfit widens all intervals, and why.
std::string widened_words(const FitResult& fitted);

}  // namespace recoil
