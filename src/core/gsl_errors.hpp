#pragma once

namespace recoil {

/// Makes GSL report by return codes instead of aborting the process; once per process, from any
/// thread. Every caller of GSL here checks what it gets back.
void gsl_errors_are_values();

}  // namespace recoil
