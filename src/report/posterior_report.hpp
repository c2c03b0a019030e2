#pragma once

#include <string>

#include "core/json.hpp"
#include "document/document.hpp"
#include "report/report.hpp"

/// The sampled posterior, as tables, JSON and draws.
namespace recoil {

/// "the draws have not settled: ..."; empty where there is a posterior.
std::string no_posterior_words(const PosteriorResult& posterior);

/// Mean, standard deviation, interval and convergence of every quantity; empty without a posterior.
Table posterior_table(const Analysis& analysis);

/// `posterior`: how it was sampled, and how well; null where it was not asked for.
Json posterior_json(const Analysis& analysis);

/// Adds `posterior` to the `intervals` of an entry, with `why` where it is null.
void put_posterior(Json& intervals, const Analysis& analysis, const PosteriorMarginal* marginal);

/// The joint draws: one column for each slot that moves and each capture velocity, SI units.
std::string posterior_csv(const Analysis& analysis);

}  // namespace recoil
