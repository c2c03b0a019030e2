#include "estimate/input_errors.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "estimate/observations.hpp"

namespace recoil {
namespace {

/// A stated error of V or d. If e is the quotient of two velocities, an error of the incident one
/// also changes e, by 2 e^2 per d ln V in e^2. If settings share the error, so do both velocities
/// of a point, whatever instrument measured them.
class ErrorOfInput : public ErrorSource {
 public:
  using Sd = double InputErrors::*;
  using Input = double Observation::*;
  using Part = double InputShift::*;

  ErrorOfInput(const Names& called, SharedBy sharing, Sd sd, Input input, Part part)
      : ErrorSource(called, sharing), sd_(sd), input_(input), part_(part) {}

  bool acts(const Observations& data) const override {
    return std::any_of(data.points.begin(), data.points.end(),
                       [this](const Observation& point) { return point.*sd_ > 0.0; });
  }
  InputShift shift(const Observation& point) const override {
    InputShift relative;
    relative.*part_ = point.*sd_ / (point.*input_);
    return relative;
  }
  double effect(const Observation& point, const Local& at, const Noise&) const override {
    const bool of_ratio =
        input_ == &Observation::velocity && (point.rebound_measured || shared == SharedBy::setting);
    const double by_ratio = of_ratio ? 2.0 * std::max(at.value, 0.0) : 0.0;
    return (at.slope + by_ratio) * shift(point).relative();
  }
  std::vector<ErrorPart> parts(const Observation& point) const override {
    return point.*sd_ > 0.0 ? ErrorSource::parts(point) : std::vector<ErrorPart>{};
  }

 private:
  Sd sd_;
  Input input_;
  Part part_;
};

}  // namespace

const ErrorSource& velocity_error() {
  static const ErrorOfInput source({"velocity", "velocity_sd", "errors of the velocities"},
                                   SharedBy::none, &Observation::velocity_sd,
                                   &Observation::velocity, &InputShift::velocity);
  return source;
}

const ErrorSource& setting_velocity_error() {
  static const ErrorOfInput source(
      {"setting_velocity", "setting_velocity_sd", "errors of the velocities of settings"},
      SharedBy::setting, &Observation::setting_velocity_sd, &Observation::velocity,
      &InputShift::velocity);
  return source;
}

const ErrorSource& diameter_error() {
  static const ErrorOfInput source({"diameter", "diameter_sd", "errors of the diameters"},
                                   SharedBy::none, &Observation::diameter_sd,
                                   &Observation::diameter, &InputShift::diameter);
  return source;
}

const ErrorSource& series_diameter_error() {
  static const ErrorOfInput source(
      {"series_diameter", "series_diameter_sd", "errors of the diameters of series"},
      SharedBy::series, &Observation::series_diameter_sd, &Observation::diameter,
      &InputShift::diameter);
  return source;
}

const ErrorSource& batch_diameter_error() {
  static const ErrorOfInput source(
      {"batch_diameter", "diameter_sd", "errors of the diameters of batches"}, SharedBy::size,
      &Observation::batch_diameter_sd, &Observation::diameter, &InputShift::diameter);
  return source;
}

void find_batches(std::vector<Observation>& points) {
  std::map<std::pair<std::size_t, double>, std::vector<Observation*>> sizes;
  for (Observation& point : points) sizes[{point.dataset, point.diameter}].push_back(&point);
  std::size_t number = 0;
  for (auto& [size, own] : sizes) {
    const double sd = own.front()->diameter_sd;
    const bool batch = own.size() > 1 && std::ranges::all_of(own, [sd](const Observation* point) {
                         return point->diameter_sd == sd && point->series_diameter_sd == 0.0;
                       });
    for (Observation* point : own) {
      point->size = number;
      if (batch) std::swap(point->diameter_sd, point->batch_diameter_sd);
    }
    ++number;
  }
}

}  // namespace recoil
