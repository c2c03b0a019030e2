#include "core/gsl_errors.hpp"

#include <gsl/gsl_errno.h>

#include <mutex>

namespace recoil {

void gsl_errors_are_values() {
  static std::once_flag once;
  std::call_once(once, [] { gsl_set_error_handler_off(); });
}

}  // namespace recoil
