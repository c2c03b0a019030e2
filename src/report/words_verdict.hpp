#pragma once

#include <string>

#include "document/sentence.hpp"
#include "estimate/model_verdict.hpp"

namespace recoil {

/// Whether the model fits: the one sentence of `judge_model`. Every place that says so uses it.
Sentence verdict_sentence(const FitResult& fitted);

/// "2.1 [1.5, 3.8] %" or, if no error is seen, "below 0.8 %".
std::string law_error_range(const LawErrorEstimate& laws);

/// How wrong the laws are: "The laws are wrong by 2.1 [1.5, 3.8] % of the loss."; empty if the fit
/// was not averaged over their error.
Sentence law_error_words(const ModelJudgement& judged);

}  // namespace recoil
