#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/names.hpp"
#include "diagnosis/candidate.hpp"
#include "estimate/shared_settings.hpp"
#include "uncertainty/resample.hpp"

namespace recoil {

using Samples = std::vector<std::vector<double>>;  ///< residuals of many data sets

/// A question put to the residuals, see `StructureStatistics`.
enum class StructureQuestion { scatter, size, trend, curvature, capture, runs, smooth };
template <>
struct NamesOf<StructureQuestion> {
  static constexpr std::array<std::string_view, 7> names = {"scatter", "size", "trend", "curvature",
                                                            "capture", "runs", "smooth"};
};

/// What the residuals answer to one question.
struct StructureTest {
  StructureQuestion question = StructureQuestion::scatter;
  double statistic = 0.0;
  double p_value = 1.0;  ///< part of the simulated data sets that show as much
};

/// What is systematic in the residuals of a fit.
struct Structure {
  std::vector<StructureTest> tests;
  double p_value = 1.0;  ///< of the most striking test, paid for having looked at all of them
  int simulated = 0;     ///< data sets that calibrate it
  int failed = 0;        ///< of these, without an answer
  bool smooth = false;   ///< is it in the shape of the residuals, or only in their size?
};

/// The statistics of `StructureTest`, for residuals in units of their standard deviation, whitened
/// by what the fit says they share. Functions are whitened as they are.
///
/// With groups g (the points of one diameter in one dataset, ordered by velocity) and P_k the
/// Legendre polynomials over the ln V of a group, made orthonormal on its points:
/// - scatter: sum r^2; only where standard deviations are stated, as it says nothing else
/// elsewhere;
/// - size: sum over g of (P_0 . r)^2; trend: of (P_1 . r)^2; curvature: of (P_2 . r)^2;
/// - capture: (b . r)^2, b = (V_min / V)^2 in each group, all groups together;
/// - runs: sum over neighbours of r_i r_(i+1), positive where residuals come in runs;
/// - smooth: max over m of (T_m - m) / sqrt(2 m), T_m the part of sum r^2 in the first m of the
///   functions P_j(ln V), P_j(ln V) ln d (j = 0, 1, ...; over all points), which is an adaptive
///   Neyman test (Fan 1996, J. Am. Stat. Assoc. 91, 674-688).
/// A function is a discrepancy of e^2, weighted like the residuals, and the residuals of one
/// velocity and size count together, by their mean. All functions are first freed of what the fit's
/// own parameters can follow (the columns of its Jacobian), so that they ask only for what the
/// model cannot do. A question of which nothing is left then is not asked: with no more distinct
/// pairs of velocity and size than moving parameters none is, but for the scatter.
class StructureStatistics {
 public:
  /// @param fitted whose Jacobian says what the model can follow
  /// @param predicted e^2 of every point: a point that is captured in the data and in the model has
  ///   no scatter and is left out
  StructureStatistics(const Observations& data, const Refit& fitted,
                      std::span<const double> predicted);

  PerValue<StructureQuestion, double> operator()(std::span<const double> residuals) const;
  std::vector<PerValue<StructureQuestion, double>> operator()(const Samples& residuals) const;

  /// The projection of white noise onto what the fit leaves: what residuals look like where the
  /// model is right, to first order.
  std::vector<double> residuals_of_noise(std::span<const double> noise) const;
  Samples residuals_of_noise(const Samples& noise) const;

  /// Can these points answer the question?
  bool asks(StructureQuestion question) const;

  /// The free-form discrepancy that the smallest criterion T_m - 2 m chooses, as whitened residuals
  /// [points]; empty when m = 0 is best.
  std::vector<double> free_form(std::span<const double> residuals) const;

 private:
  using Column = std::vector<double>;
  void add_local_functions(const Observations& data);
  std::size_t places() const;
  std::size_t longest_run() const;
  void add_global_functions(const Observations& data);
  bool orthogonalise(Column& column, const std::vector<Column>& against) const;
  bool take(Column column, std::vector<Column>& into) const;
  void keep_to_impacts(Column& column) const;

  bool stated_ = true;
  bool noise_known_ = true;
  std::vector<double> slopes_;       // d residual / d e^2 [points]
  std::vector<std::size_t> impact_;  // number of the series, size and velocity [points]
  SharedSettings settings_;          // whiten functions as they did the residuals
  std::shared_ptr<const Discrepancy> discrepancy_;  // likewise
  std::vector<bool> used_;
  std::size_t used_count_ = 0;
  std::vector<Column> model_;  // orthonormal, spans the Jacobian
  // Groups: of each its velocities in ascending order, of each velocity its points.
  std::vector<std::vector<std::vector<std::size_t>>> runs_;
  std::vector<Column> size_, trend_, curvature_, capture_;
  std::vector<Column> smooth_;
};

/// p-values by comparison with statistics of simulated data sets: of each test, and of the
/// smallest of these p-values among the smallest ones of the simulated sets.
Structure judge_structure(const StructureStatistics& statistics, std::span<const double> observed,
                          const std::vector<PerValue<StructureQuestion, double>>& simulated);

inline constexpr int quick_samples = 999;  ///< of white noise, for `quick_structure`

/// Standard normal numbers; every sample has its own stream.
Samples white_noise(int samples, std::size_t points, std::uint64_t seed);

/// The structure in the residuals of `fitted`, beside samples of `noise` that go through the same
/// projection: no refits, exact for a model that is linear over its errors.
Structure quick_structure(const Observations& data, const Refit& fitted,
                          std::span<const double> predicted, const Samples& noise);

}  // namespace recoil
