#pragma once

#include "export/export_job.hpp"

namespace recoil {

/// `impact.py`, one impact on the plane z = 0 in SI units: the force law as an engine in Python, or
/// a wall of `MindlinPhys` with the constant restitution that is nearest. Tried with YADE 2023.02a.
std::vector<ExportedFile> yade_files(const ExportJob& job);

}  // namespace recoil
