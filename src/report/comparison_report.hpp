#pragma once

#include <optional>
#include <string>
#include <vector>

#include "data/dataset.hpp"
#include "document/document.hpp"
#include "json/fit_file.hpp"
#include "predict/law_choice.hpp"

/// Fits of the same data side by side.
namespace recoil {

/// A parameter or capture velocity of a fit that is compared with others.
struct ComparedQuantity {
  std::string name;  ///< "C_A", "V* (4.90 um)"
  std::string unit;
  double value = 0.0;
  bool free = true;
  std::optional<Ends> interval = {};  ///< the recommended one
  RECOIL_FIELDS(name, unit, value, free, interval)
};

/// The part of a fit that is compared.
struct ComparedFit {
  std::string id;
  std::string adhesion;
  std::vector<std::string> mechanisms;
  std::vector<std::string> data;  ///< id and sha256 of every dataset
  double chi2 = 0.0;
  int points = 0;
  int free_parameters = 0;
  bool sd_stated = false;
  double rmse = 0.0;  ///< of e [1]
  std::optional<double> held_out_rmse;
  std::vector<ComparedQuantity> quantities;  ///< parameters, then capture velocities

  RECOIL_FIELDS(adhesion, mechanisms, data, points, free_parameters, chi2, sd_stated, rmse,
                held_out_rmse, quantities)

  /// Akaike's criterion for small samples, chi^2 + 2 k + 2 k (k + 1) / (n - k - 1) (Hurvich & Tsai
  /// 1989, Biometrika 76, 297); none where no standard deviations are stated, as every fit then
  /// has its own, or where there are too few points.
  std::optional<double> aicc() const;
};

/// @param file names it in messages
/// @throws InputError when `fit_json` is not the fit.json of a fit
ComparedFit compared_fit(const std::string& file, const std::string& fit_json);

/// The name of a capture velocity among compared quantities: "V* at 4.9 um, DATASET".
/// @param datasets how many the fits have; of one it is not named
std::string capture_name(double diameter_um, const std::string& dataset, std::size_t datasets);

/// The same of one fit under every law of adhesion that has an answer. Intervals extend by 1.96
/// standard errors to either side, to first order, and stop at the bounds.
std::vector<ComparedFit> compared_laws(const std::vector<LawFit>& laws,
                                       const std::vector<Dataset>& datasets);

/// The text of `laws.json`.
std::string laws_json(const std::vector<ComparedFit>& laws);

/// The names of all quantities in the fits, without repetition.
std::vector<std::string> compared_names(const std::vector<ComparedFit>& fits);

/// @throws InputError when the fits are not of the same data
void require_same_data(const std::vector<ComparedFit>& fits);

/// Quantities by whether the intervals of all fits that have one overlap (`holds`).
struct ChoiceDependence {
  std::vector<std::string> depends, holds;
};
ChoiceDependence choice_dependence(const std::vector<ComparedFit>& fits);

/// Fits of the same data side by side: quality, quantities, and which of them depend on the choice.
/// @throws InputError when they are not of the same data. @pre two or more
std::vector<Section> comparison_sections(const std::vector<ComparedFit>& fits);

/// Their quality, and whether the choice matters, for the page of a fit; none without another law.
std::vector<Block> law_blocks(const std::vector<ComparedFit>& laws);

}  // namespace recoil
