#pragma once

#include "export/export_job.hpp"

namespace recoil {

/// `impact.liggghts`, one impact on the plane z = 0 in SI units: Hertz with the constant
/// restitution that is nearest. Tried with LIGGGHTS 3.8.0. Left alone: its cohesion `sjkr`, a force
/// in proportion to the area of the contact, which neither law of adhesion has.
std::vector<ExportedFile> liggghts_files(const ExportJob& job);

}  // namespace recoil
