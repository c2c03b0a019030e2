#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "estimate/noise.hpp"
#include "estimate/observation.hpp"

namespace recoil {

struct Observations;

/// The points that have one draw of an error in common.
enum class SharedBy { none, setting, series, size, launch };

/// Relative standard deviations of the inputs of a point, of which one or none is above 0 [1].
struct InputShift {
  double velocity = 0.0;
  double diameter = 0.0;

  double relative() const { return velocity + diameter; }
};

/// e^2 at one point and its first two derivatives in the logarithm of V or d.
struct Local {
  double value = 0.0;
  double slope = 0.0;
  double bend = 0.0;
};

/// One draw of an error at one point, times `factor`.
struct ErrorPart {
  std::uint64_t draw = 0;
  double factor = 1.0;
};

/// A source of error of the measured points. Weights, whitening, simulated data (of the bootstrap,
/// of coverage, of the diagnosis), budget and posterior know the sources only from
/// `error_sources`; a new one is a file and a line of that list. Two kinds of error have no entry:
/// the scatter of each point about the curve, which every point has, and the errors of material
/// constants, which are parameters (ImpactModel::constants).
///
/// One standard deviation of the error changes e^2 by `effect`, to first order. Points with the
/// same number share one draw.
class ErrorSource {
 public:
  /// What a source is called: in JSON, by the column or key that states it, and in a sentence.
  struct Names {
    std::string_view id, stated_by, words;
  };

  ErrorSource(const Names& called, SharedBy sharing) : names(called), shared(sharing) {}
  ErrorSource(const ErrorSource&) = delete;
  ErrorSource& operator=(const ErrorSource&) = delete;
  virtual ~ErrorSource() = default;

  const Names names;
  const SharedBy shared;

  /// Does any point of `data` have this error?
  virtual bool acts(const Observations& data) const = 0;
  /// The input of the point that is wrong, and by how much; 0 for an error of e itself.
  virtual InputShift shift(const Observation&) const { return {}; }
  /// The change of e^2 by one standard deviation. @param at e^2 and its derivatives in the input
  virtual double effect(const Observation& point, const Local& at, const Noise& noise) const = 0;
  /// The draws that act at a point, for a shared error; none if the point does not have it.
  virtual std::vector<ErrorPart> parts(const Observation& point) const;
  /// Is it the whole scatter of the points that have it, instead of an error of their own?
  virtual bool is_scatter() const { return false; }
};

/// All sources, in the order in which they are drawn.
std::span<const ErrorSource* const> error_sources();

}  // namespace recoil
