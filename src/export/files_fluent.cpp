#include "export/export_job.hpp"
#include "export/files.hpp"

namespace recoil {
namespace {

constexpr const char* udf_text = R"(/*
@HEADING@
   Use: compile this as a user-defined function and choose "recoil_rebound" as the discrete-phase
   boundary condition (user_defined) of the wall. Velocities count relative to a wall at rest; the
   tangential one is kept. Not for axisymmetric swirl, where the normal turns with the particle.
*/
#include <math.h>

#include "udf.h"

@TABLE@
DEFINE_DPM_BC(recoil_rebound, p, t, f, f_normal, dim)
{
  int i;
  real normal_velocity = 0.0, e;
  for (i = 0; i < dim; i++) normal_velocity += P_VEL(p)[i] * f_normal[i];
  if (normal_velocity <= 0.0) return PATH_ACTIVE;
  e = recoil_restitution(P_DIAM(p), normal_velocity);
  if (e <= 0.0) {
    for (i = 0; i < dim; i++) P_VEL(p)[i] = 0.0;
    return PATH_END; /* it stays */
  }
  for (i = 0; i < dim; i++) P_VEL(p)[i] -= (1.0 + e) * normal_velocity * f_normal[i];
  for (i = 0; i < dim; i++) P_VEL0(p)[i] = P_VEL(p)[i];
  return PATH_ACTIVE;
}
)";

}  // namespace

std::vector<WholeFile> fluent_files(const ExportJob& job) {
  const std::string heading = commented(job.heading, "   ");
  return {{"recoil_rebound.c",
           filled(udf_text, {{"HEADING", heading}, {"TABLE", lookup_in_c(*job.lookup)}})}};
}

}  // namespace recoil
