#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace recoil {

/// The options of `recoil.pair`, in the units of the command's options of the same names.
struct PairArguments {
  std::map<std::string, std::string> units, columns;
  bool positive_away = false;
  double height = 1.0;  ///< [mm]
  double height_range = 1.5;
  bool keep_height = false;
  double diameter_tolerance = 0.2;
  double velocity_tolerance = 0.15;
  bool keep_later = false;
  std::optional<double> threshold;  ///< [m/s]
  std::optional<double> angle;      ///< [degrees]
  std::optional<double> lost_share;
  std::size_t per_bin = 40;
  std::size_t size_classes = 1;
  std::vector<double> size_edges;  ///< [um]
  bool mean_diameter = false;
};

/// What it gives: the texts that the command prints and writes, and its pictures as JSON.
struct PairTexts {
  std::string json, text, points, impacts, pictures;
};

/// @throws InputError, ComputationError as the command.
PairTexts pair_texts(const std::string& file, const PairArguments& arguments);

}  // namespace recoil
