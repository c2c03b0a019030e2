#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "estimate/fit.hpp"
#include "estimate/reweighting.hpp"

namespace recoil {

/// The options for refits of replicates: they start at the estimate and need less precision than
/// their scatter.
LeastSquaresOptions refit_options();

/// The options for the weights of a replicate.
ReweightingOptions refit_reweighting_options();

/// Refits a sample like those of `fitted` from its estimate, together with its weights if they
/// depend on the fit (`reweighted_fit`).
LeastSquaresResult refit(const FitResult& fitted, const Observations& sample);

/// The estimate with the stated value of constant number k `by` standard deviations higher, with
/// the weights of the fit. Nullopt if the refit fails.
std::optional<std::vector<double>> estimate_with_constant_moved(const FitResult& fitted,
                                                                std::size_t k, double by);

/// Was a refit successful? It must converge, and its data must determine the parameters (J'J
/// regular) if those of the fit do; otherwise the refit only stays at its start.
bool has_answer(const LeastSquaresResult& refit, const FitResult& fitted);

}  // namespace recoil
