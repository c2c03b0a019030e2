#include "estimate/error_source.hpp"

#include <array>

#include "estimate/input_errors.hpp"
#include "estimate/instant_errors.hpp"
#include "estimate/setting_error.hpp"

namespace recoil {

std::vector<ErrorPart> ErrorSource::parts(const Observation& point) const {
  switch (shared) {
    case SharedBy::setting:
      return {{point.setting}};
    case SharedBy::series:
      return {{point.batch}};
    case SharedBy::size:
      return {{point.size}};
    case SharedBy::launch:
    case SharedBy::none:
      break;
  }
  return {};
}

std::span<const ErrorSource* const> error_sources() {
  static const std::array all = {&velocity_error(),        &diameter_error(),
                                 &setting_error(),         &setting_velocity_error(),
                                 &series_diameter_error(), &batch_diameter_error(),
                                 &instant_error()};
  return all;
}

}  // namespace recoil
