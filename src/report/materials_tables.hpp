#pragma once

#include "document/document.hpp"
#include "report/report.hpp"

/// Tables about constants that are known with an error; empty where all are exact.
namespace recoil {

/// What is stated of each constant, and what the fit makes of it.
Table constants_table(const Analysis& analysis);

/// The share of every source in the variance of every quantity.
Table budget_table(const Analysis& analysis);

/// The intervals with and without the errors of the materials.
Table conditional_table(const Analysis& analysis);

}  // namespace recoil
