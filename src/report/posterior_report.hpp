#pragma once

#include <string>

#include "document/document.hpp"
#include "report/report.hpp"

/// The sampled posterior, as tables and draws.
namespace recoil {

/// "the draws have not settled: ..."; empty where there is a posterior.
std::string no_posterior_words(const PosteriorResult& posterior);

/// Mean, standard deviation, interval and convergence of every quantity; empty without a posterior.
Table posterior_table(const Analysis& analysis);

/// The joint draws: one column for each slot that moves and each capture velocity, SI units.
std::string posterior_csv(const Analysis& analysis);

}  // namespace recoil
