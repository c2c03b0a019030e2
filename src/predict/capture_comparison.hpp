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

/// A capture velocity that is published as a number. No uncertainty is given in what could be read.
struct PublishedCapture {
  std::string particle;   ///< material
  std::string surface;    ///< material
  double diameter = 0.0;  ///< [m]
  double velocity = 0.0;  ///< [m/s]
  bool measured = false;  ///< false: the result of a model
  std::string what;       ///< "JKR", "elastoplastic model", "measured", ...
  std::string source;
};

/// All that are known to this program.
const std::vector<PublishedCapture>& published_captures();

/// Those of a particle and a surface of these materials, by the names that a dataset gives them
/// ("316 stainless steel" is stainless steel, "silicon [100]" silicon).
std::vector<PublishedCapture> published_captures_for(const Material& particle,
                                                     const Material& surface);

/// A published yield pressure p_Y [Pa] of a material, with where it stands.
struct PublishedYield {
  double pressure = 0.0;  ///< [Pa]
  std::string source;
};
std::optional<PublishedYield> published_yield_pressure(const Material& particle);

/// What gives a capture velocity.
enum class CaptureModel { fit, jkr, thornton_ning, dahneke, wall };
template <>
struct NamesOf<CaptureModel> {
  static constexpr std::array<std::string_view, 5> names = {"fit", "jkr", "thornton_ning",
                                                            "dahneke", "wall"};
};

/// Capture velocity against diameter by one model.
struct CaptureCurve {
  CaptureModel model = CaptureModel::fit;
  std::vector<double> velocity;      ///< [m/s], one per diameter; 0: nothing is captured
  std::vector<double> lower, upper;  ///< band of the bootstrap [m/s]; empty where there is none
};

/// What a fit and the older models say about one system.
struct CaptureComparison {
  std::size_t dataset = 0;
  std::vector<double> diameter;  ///< [m], ascending
  std::vector<CaptureCurve> curves;
  std::vector<PublishedCapture> published;
  // What the models rest on beside the fit.
  double adhesion_energy = 0.0;         ///< W_A [J/m2]
  double stiffness = 0.0;               ///< K [Pa]
  std::optional<PublishedYield> yield;  ///< none: `thornton_ning` has no curve
  double restitution = 0.0;             ///< the largest of the fitted curve [1]; 0 where nothing
                                        ///< rebounds: `dahneke` and `wall` have no curve
  std::size_t unanswered = 0;  ///< diameters, left out, at which no sphere rebounds under the fit,
                               ///< or under more than a tenth of its replicates
};

struct CaptureComparisonOptions {
  double level = 0.95;   ///< of the band
  int threads = 0;       ///< 0: all cores
  int diameters = 25;    ///< of every curve, log-spaced
  double widened = 1.5;  ///< the range goes this factor beyond the diameters of the data [1]
  int replicates = 499;  ///< of the bootstrap that make the band, at most
  /// Further diameters (dataset, [m]) that its range should hold, such as those of a mixture.
  std::vector<std::pair<std::size_t, double>> include;
};

/// One comparison for every dataset of a fit; without adhesion there is none.
///
/// The models of Dahneke and Wall need the restitution of the contact itself and the energies of
/// the bond, which their authors took from elsewhere. Here e is the largest restitution that the
/// fitted curve reaches in the range of the data at the reference diameter, and the energies are
/// those of the JKR contact, so that both become JKR's velocity for e = 1.
std::vector<CaptureComparison> compare_captures(const FitResult& fitted,
                                                const std::vector<Dataset>& datasets,
                                                const BootstrapResult& bootstrap,
                                                const CaptureComparisonOptions& options = {});

}  // namespace recoil
