#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "estimate/fit.hpp"
#include "estimate/reweighting.hpp"

namespace recoil {

/// How replicates are refitted: they start at the estimate and need no more digits than their own
/// scatter has.
LeastSquaresOptions refit_options();

/// The same for the weights that depend on a replicate.
ReweightingOptions refit_reweighting_options();

/// The refit of a sample from `start`, together with the weights that depend on it
/// (`reweighted_fit`).
LeastSquaresResult refit(const ImpactModel& model, const Observations& sample,
                         std::span<const double> start);

/// The estimate if constant number k were stated `by` standard deviations higher, with the weights
/// of the fit. Nothing when the refit does not end.
std::optional<std::vector<double>> estimate_with_constant_moved(const FitResult& fitted,
                                                                std::size_t k, double by);

/// Did a refit give an answer? It has to end by itself, and its data have to determine the
/// parameters (J'J regular) where those of the fit do: where they do not, it merely stays where it
/// started.
bool has_answer(const LeastSquaresResult& refit, const FitResult& fitted);

}  // namespace recoil
