#pragma once

#include <optional>
#include <string>
#include <vector>

#include "predict/published_captures.hpp"
#include "data/dataset.hpp"
#include "estimate/fit.hpp"
#include "uncertainty/bootstrap_result.hpp"

namespace recoil {

/// Capture velocity against diameter by one model.
struct CaptureCurve {
  std::string id;                    ///< "fit", "jkr", "thornton_ning", "dahneke", "wall"
  std::string label;                 ///< for the key of the picture
  std::string rests_on;              ///< what went in, one sentence
  std::vector<double> velocity;      ///< [m/s], one per diameter; 0: nothing is captured
  std::vector<double> lower, upper;  ///< band of the bootstrap [m/s]; empty where there is none
};

/// What a fit and the older models say about one system.
struct CaptureComparison {
  std::size_t dataset = 0;
  std::vector<double> diameter;  ///< [m], ascending
  std::vector<CaptureCurve> curves;
  std::vector<PublishedCapture> published;
  std::vector<std::string> notes;  ///< what could not be drawn, and why
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
std::vector<CaptureComparison> compare_captures(const FitResult& fitted, const Observations& data,
                                                const std::vector<Dataset>& datasets,
                                                const BootstrapResult& bootstrap,
                                                const CaptureComparisonOptions& options = {});

}  // namespace recoil
