#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/names.hpp"
#include "diagnosis/candidate.hpp"
#include "estimate/shared_errors.hpp"
#include "uncertainty/resample.hpp"

namespace recoil {

using Samples = std::vector<std::vector<double>>;  ///< residuals of many data sets

/// A test of the residuals, see `StructureStatistics`.
enum class StructureQuestion {
  scatter,
  size,
  trend,
  curvature,
  capture,
  runs,
  smooth,
  cause,
};
constexpr auto names_of_values(StructureQuestion) {
  return name_list("scatter", "size", "trend", "curvature", "capture", "runs", "smooth", "cause");
}

/// The result of one test.
struct StructureTest {
  StructureQuestion question = StructureQuestion::scatter;
  double statistic = 0.0;
  double p_value = 1.0;  ///< fraction of the simulated data sets with at least this statistic
};

/// The systematic structure in the residuals of a fit.
struct Structure {
  std::vector<StructureTest> tests;
  /// Of the most significant test, corrected for multiple tests: the one for causes has half of the
  /// level, the others share the rest.
  double p_value = 1.0;
  int simulated = 0;    ///< number of calibrating data sets
  int failed = 0;       ///< number of these without a fit
  bool smooth = false;  ///< true: in the shape of the residuals; false: only in their size
};

/// The statistics of `StructureTest`, for residuals in units of their standard deviation, whitened
/// for the errors that they share in the fit. Functions are whitened in the same way.
///
/// With groups g (the points of one diameter in one dataset, ordered by velocity) and P_k the
/// Legendre polynomials over the ln V of a group, made orthonormal on its points:
/// - scatter: sum r^2; only if standard deviations are stated, else it has no information;
/// - size: sum over g of (P_0 . r)^2; trend: of (P_1 . r)^2; curvature: of (P_2 . r)^2;
/// - capture: (b . r)^2, b = (V_min / V)^2 in each group, for all groups together;
/// - runs: sum over neighbours of r_i r_(i+1), positive if neighbouring residuals have the same
///   sign;
/// - smooth: max over m of (T_m - m) / sqrt(2 m), with T_m the part of sum r^2 along the first m of
///   the functions P_j(ln V), P_j(ln V) ln d (j = 0, 1, ...; over all points), which is an adaptive
///   Neyman test (Fan 1996, J. Am. Stat. Assoc. 91, 674-688);
/// - cause: ln of the mean over the shapes s of exp((s . r)^2 / 4), the effects of the causes that
/// a
///   search would try: sqrt(2) times the Bayes factor for an effect of N(0, 1) standard errors.
/// A function is a discrepancy of e^2, weighted like the residuals; residuals of the same velocity
/// and size enter through their mean. All functions are made orthogonal to the columns of the fit's
/// Jacobian, so that they test only deviations that the parameters cannot fit. A test whose
/// functions vanish is omitted: without more distinct pairs of velocity and size than moving
/// parameters, only the scatter is tested.
class StructureStatistics {
 public:
  /// @param fitted the fit, whose Jacobian gives the deviations that the parameters can fit
  /// @param predicted e^2 of every point: a point that is captured in the data and in the model
  ///   does not scatter and is omitted
  /// @param shapes changes of e^2 by single causes [causes][points]
  StructureStatistics(const Observations& data, const Weights& weights, const Refit& fitted,
                      std::span<const double> predicted,
                      const std::vector<std::vector<double>>& shapes = {});

  PerValue<StructureQuestion, double> operator()(std::span<const double> residuals) const;
  std::vector<PerValue<StructureQuestion, double>> operator()(const Samples& residuals) const;

  /// The projection of white noise orthogonal to the fit's Jacobian: the residuals of a correct
  /// model, to first order.
  Samples residuals_of_noise(const Samples& noise) const;

  /// Do these points allow this test?
  bool asks(StructureQuestion question) const;

  /// The free-form discrepancy with the order m that maximises T_m - 2 m, as whitened residuals
  /// [points]; empty if m = 0.
  std::vector<double> free_form(std::span<const double> residuals) const;

 private:
  using Column = std::vector<double>;
  void add_local_functions(const Observations& data);
  std::size_t longest_run() const;
  void add_global_functions(const Observations& data);
  bool orthogonalise(Column& column, const std::vector<Column>& against) const;
  void take(Column column, std::vector<Column>& into) const;
  void keep_to_impacts(Column& column) const;

  bool stated_ = true;
  bool noise_known_ = true;
  std::vector<double> slopes_;  // d residual / d e^2 [points]
  // Index of the combination of series, size and velocity [points].
  std::vector<std::size_t> impact_;
  SharedErrors shared_;                             // whiten functions like the residuals
  std::shared_ptr<const Discrepancy> discrepancy_;  // also whitens functions
  std::vector<bool> used_;
  std::size_t used_count_ = 0;
  std::vector<Column> model_;  // orthonormal basis of the Jacobian's columns
  // [group][velocity, ascending][point]
  std::vector<std::vector<std::vector<std::size_t>>> runs_;
  std::vector<Column> size_, trend_, curvature_, capture_;
  std::vector<Column> smooth_;
  std::vector<Column> causes_;  // not orthogonal to each other
};

/// Computes p-values by comparison with simulated data sets: of each test, and of the smallest of
/// these p-values compared with the smallest ones of the simulated sets.
Structure judge_structure(const StructureStatistics& statistics, std::span<const double> observed,
                          const std::vector<PerValue<StructureQuestion, double>>& simulated);

inline constexpr int quick_samples = 999;  ///< number of white-noise samples for `quick_structure`

/// Standard normal numbers; every sample has its own stream.
Samples white_noise(int samples, std::size_t points, std::uint64_t seed);

/// The structure in the residuals of `fitted`, compared with samples of `noise` after the same
/// projection: without refits, exact for a model that is linear within its errors.
Structure quick_structure(const Observations& data, const Weights& weights, const Refit& fitted,
                          std::span<const double> predicted, const Samples& noise);

}  // namespace recoil
