#pragma once

#include <string>

#include "analysis/analysis.hpp"
#include "experiment/averages.hpp"
#include "experiment/passages.hpp"
#include "options/given_options.hpp"

/// What the command line and Python ask for alike.
namespace recoil {

/// --replicates, --scheme, --seed, --threads and --solver, as far as the command takes them.
AnalysisOptions analysis_options(const GivenOptions& given);

/// --seed, or the seed of the fit file.
std::uint64_t seed_of(const GivenOptions& given, const FitSpec& spec);

/// --unit, --column and --positive of `pair`.
PassageFormat passage_format(const GivenOptions& given);

/// The other options of `pair`. @param file with the passages
/// @throws InputError for limits of size classes that do not ascend, or beside --size-classes
PairRequest pair_request(const std::string& file, const GivenOptions& given);

}  // namespace recoil
