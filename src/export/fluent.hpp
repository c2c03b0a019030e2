#pragma once

#include "export/export_job.hpp"

namespace recoil {

/// `recoil_rebound.c`: a user-defined function of the kind DEFINE_DPM_BC for the wall of a discrete
/// phase in Ansys Fluent. Its e(V, d) is a table, captures included: a sphere that stays ends its
/// path.
std::vector<ExportedFile> fluent_files(const ExportJob& job);

}  // namespace recoil
