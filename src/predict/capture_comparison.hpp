#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/names.hpp"
#include "data/dataset.hpp"
#include "data/system.hpp"
#include "estimate/fit.hpp"
#include "uncertainty/bootstrap_result.hpp"

namespace recoil {

/// A published capture velocity. None of the sources states an uncertainty.
struct PublishedCapture {
  std::string particle;   ///< material
  std::string surface;    ///< material
  double diameter = 0.0;  ///< [m]
  double velocity = 0.0;  ///< [m/s]
  bool measured = false;  ///< false: the result of a model
  std::string what;       ///< "JKR", "elastoplastic model", "measured", ...
  std::string source;
};

/// All published capture velocities in this program.
const std::vector<PublishedCapture>& published_captures();

/// Those for a particle and a surface of these materials, by the names in a dataset ("316 stainless
/// steel" is stainless steel, "silicon [100]" silicon).
std::vector<PublishedCapture> published_captures_for(const Material& particle,
                                                     const Material& surface);

/// A published yield pressure p_Y of a material, with its source.
struct PublishedYield {
  double pressure = 0.0;  ///< [Pa]
  std::string source;
};
std::optional<PublishedYield> published_yield_pressure(const Material& particle);

/// The model of a capture velocity.
enum class CaptureModel { fit, jkr, thornton_ning, dahneke, wall };
constexpr auto names_of_values(CaptureModel) {
  return name_list("this fit", "JKR", "Thornton & Ning, yield", "Dahneke, eq. 1",
                   "Wall et al., eq. 4");
}

/// Capture velocity against diameter from one model.
struct CaptureCurve {
  CaptureModel model = CaptureModel::fit;
  std::vector<double> velocity;      ///< [m/s], one per diameter; 0: no sphere is captured
  std::vector<double> lower, upper;  ///< bootstrap band [m/s]; empty without one
};

/// The capture velocities of one system from the fit and from older models.
struct CaptureComparison {
  std::size_t dataset = 0;
  std::vector<double> diameter;  ///< [m], ascending
  std::vector<CaptureCurve> curves;
  std::vector<PublishedCapture> published;
  // Inputs of the older models.
  double adhesion_energy = 0.0;         ///< W_A [J/m2]
  double stiffness = 0.0;               ///< K [Pa]
  std::optional<PublishedYield> yield;  ///< nullopt: `thornton_ning` has no curve
  double restitution = 0.0;    ///< largest e of the fitted curve [1]; 0 if no sphere rebounds:
                               ///< `dahneke` and `wall` then have no curve
  std::size_t unanswered = 0;  ///< number of omitted diameters, at which V* is missing for the fit
                               ///< or for more than 10 % of its replicates
};

struct CaptureComparisonOptions {
  double level = 0.95;   ///< level of the band
  int threads = 0;       ///< 0: all cores
  int diameters = 25;    ///< number of diameters of every curve, log-spaced
  double widened = 1.5;  ///< factor by which the range exceeds the diameters of the data [1]
  int replicates = 499;  ///< largest number of bootstrap replicates for the band
  /// Additional diameters (dataset, [m]) for the range to include, such as those of a mixture.
  std::vector<std::pair<std::size_t, double>> include;
};

/// One comparison for every dataset of a fit that has adhesion.
///
/// The models of Dahneke and Wall need the restitution of the contact and the energies of the bond,
/// which their authors took from other sources. Here e is the largest restitution of the fitted
/// curve up to the fastest point at the reference diameter, and the energies are those of the JKR
/// contact, so that both models give the JKR velocity for e = 1.
std::vector<CaptureComparison> compare_captures(const FitResult& fitted,
                                                const std::vector<Dataset>& datasets,
                                                const BootstrapResult& bootstrap,
                                                const CaptureComparisonOptions& options = {});

}  // namespace recoil
