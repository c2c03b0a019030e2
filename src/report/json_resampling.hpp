#pragma once

#include <cstddef>

#include "core/json.hpp"
#include "report/report.hpp"

namespace recoil {

/// The Monte-Carlo errors of both ends, or null where nothing is random.
Json mc_error_json(const Interval& interval);

/// `intervals_mc_error`, `intervals_note`, `intervals_differ` and the numbers behind them.
void put_resampling(Json& parameter, const Analysis& analysis, std::size_t slot);

/// Which replicates failed, with which data, and the minimiser's words; null when none did.
Json failures_json(const BootstrapResult& bootstrap, const Observations& data);

}  // namespace recoil
