#pragma once

#include "validation/recipe/facts.hpp"

/// Facts about printed constants and two-point calibrations.
namespace recoil {

FactOutcome printed_constants(const FactContext& context, const FactLimits& limits);

FactOutcome contradictory_constants(const FactContext& context, const FactLimits& limits);

FactOutcome two_point_runs_low(const FactContext& context, const FactLimits& limits);

FactOutcome two_point_agrees(const FactContext& context, const FactLimits& limits);

}  // namespace recoil
