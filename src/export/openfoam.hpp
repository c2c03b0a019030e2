#pragma once

#include "export/export_job.hpp"

namespace recoil {

/// `recoilRebound/`: a patch interaction model for the clouds of OpenFOAM (openfoam.com, v1912 and
/// later), as a library that `wmake` builds and `libs` of the controlDict loads. Its e(V, d) is a
/// table, captures included: a sphere that stays is stopped and made inactive, as `stick` does.
std::vector<ExportedFile> openfoam_files(const ExportJob& job);

}  // namespace recoil
