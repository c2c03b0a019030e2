#pragma once

#include <string>
#include <vector>

#include "analysis/analysis.hpp"
#include "document/sentence.hpp"

/// Model, noise and warnings of a fit in words.
namespace recoil {

/// The equation of motion with its source.
Sentence equation_words(AdhesionLaw law);

/// Does the model fit? With the p-value, or the reason why it cannot be tested.
Sentence quality_words(const FitResult& fitted);

/// Which law of loss the points chose, and how near the others are; empty where they chose none.
Sentence loss_words(const Analysis& analysis);

/// The noise that the fit used and the evidence for it, in clauses with semicolons.
std::string noise_words(const FitResult& fitted);

/// The scale of an estimated variance function: "sd(e) = 0.021".
std::string scale_words(VarianceFunction function, double scale);

/// How the two-point iteration on `dataset` ended, with numbers.
Sentence two_point_words(const FitResult& fitted, std::size_t dataset,
                         const TwoPointResult& result);

/// The warning about residuals that are larger than stated.
Sentence noise_warning(const FitResult& fitted);

/// Warnings about the fit itself, the gravest first.
std::vector<Sentence> fit_warnings(const FitResult& fitted);

/// Warnings of every stage, the gravest first, without repetition. Contradictions of the inputs are
/// not among them.
std::vector<Sentence> all_warnings(const Analysis& analysis);

/// Contradictions among the stated inputs, "dataset: sentence".
std::vector<Sentence> all_contradictions(const Analysis& analysis);

}  // namespace recoil
