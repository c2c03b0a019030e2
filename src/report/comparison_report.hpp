#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "data/dataset.hpp"
#include "document/document.hpp"
#include "estimate/law_average.hpp"
#include "predict/law_choice.hpp"

/// Comparison of fits of the same data.
namespace recoil {

/// A parameter or capture velocity of a compared fit.
struct ComparedQuantity {
  std::string name;  ///< "C_A", "V* (4.90 um)"
  std::string unit;
  double value = 0.0;
  bool free = true;
  std::optional<std::array<double, 2>> interval = {};  ///< the recommended interval
  RECOIL_FIELDS(name, unit, value, free, interval)
};

/// The part of a fit that is compared.
struct ComparedFit {
  std::string id;
  std::string adhesion;
  std::vector<std::string> mechanisms;
  std::vector<std::string> data;  ///< id and sha256 of every dataset
  double chi2 = 0.0;
  /// `minus_two_log_likelihood`; nullopt without stated standard deviations, because every fit then
  /// estimates its own.
  std::optional<double> minus_two_log_likelihood;
  int points = 0;
  int free_parameters = 0;
  double rmse = 0.0;  ///< rms residual of e [1]
  std::optional<double> held_out_rmse;
  std::optional<LawErrorEstimate> laws;      ///< how wrong the laws are; nullopt: taken as exact
  std::vector<ComparedQuantity> quantities;  ///< parameters, then capture velocities

  RECOIL_FIELDS(adhesion, mechanisms, data, points, free_parameters, chi2, minus_two_log_likelihood,
                rmse, held_out_rmse, quantities)

  /// Akaike's criterion for small samples, -2 ln L + 2 k + 2 k (k + 1) / (n - k - 1) (Hurvich &
  /// Tsai 1989, Biometrika 76, 297). nullopt without a likelihood and for too few points.
  std::optional<double> aicc() const;
};

/// Reads a fit from the text of its fit.json.
/// @param file name of the file, for messages
/// @throws InputError if `fit_json` is not the fit.json of a fit
ComparedFit compared_fit(const std::string& file, const std::string& fit_json);

/// The name of a capture velocity among the quantities: "V* at 4.9 um, DATASET".
/// @param datasets number of datasets of the fits; the name of a single dataset is omitted
std::string capture_name(double diameter_um, const std::string& dataset, std::size_t datasets);

/// The fits of the same data under different laws of adhesion, without failed fits. An interval is
/// the estimate +- 1.96 standard errors, limited to the bounds.
std::vector<ComparedFit> compared_laws(const std::vector<LawFit>& laws,
                                       const std::vector<Dataset>& datasets);

std::string laws_json(const std::vector<ComparedFit>& laws);

/// Names of the quantities that have intervals in several fits.
struct ChoiceDependence {
  std::vector<std::string> depends;  ///< the intervals do not overlap
  std::vector<std::string> holds;    ///< all intervals overlap
};
ChoiceDependence choice_dependence(const std::vector<ComparedFit>& fits);

/// The same fits, with numbers in the ids that several have: "fit (1)", "fit (2)".
std::vector<ComparedFit> told_apart(std::vector<ComparedFit> fits);

/// The comparison of at least two fits: their quality, their quantities, and which quantities
/// depend on the choice of the fit.
/// @throws InputError if the fits are not of the same data
std::vector<Section> comparison_sections(const std::vector<ComparedFit>& fits);

/// The quality of the fits under several laws, and which quantities depend on the law, for the page
/// of a fit. Empty for fewer than two laws.
std::vector<Block> law_blocks(const std::vector<ComparedFit>& laws);

}  // namespace recoil
