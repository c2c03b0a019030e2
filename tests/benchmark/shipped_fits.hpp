#pragma once

#include <filesystem>

#include "measure.hpp"

namespace recoil::bench {

/// What `./run` does once recoil is built: `recoil report` of every fit of the fits/ in `root`,
/// none of it kept from an earlier time, into `pages`, which is emptied first.
/// @return {"fits": ..., "pages": ..., "seconds": ...}, of the wall clock
/// @throws ComputationError when the program fails, or leaves a fit without a page
Json measure_shipped_fits(const std::filesystem::path& recoil, const std::filesystem::path& root,
                          const std::filesystem::path& pages);

}  // namespace recoil::bench
