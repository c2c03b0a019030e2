#pragma once

#include <string>

#include "analysis/analysis.hpp"

namespace recoil {

/// `predict.csv`: one row per velocity, units in the column names; a cell is empty where there is
/// no value.
std::string csv_prediction(const PolydispersePrediction& mixture);

/// `predict.json`: everything, no NaN.
std::string json_prediction(const Analysis& analysis, const PolydispersePrediction& mixture);

}  // namespace recoil
