#pragma once

#include "export/export_job.hpp"

namespace recoil {

/// `impact.lammps`, one impact on the plane z = 0 in `units micro` (um, us, pg). The force law
/// stands in atom-style variables and acts through `fix addforce`; where e(V) is not that of a
/// force, `fix wall/gran` with Hertz and viscoelastic damping. Tried with LAMMPS 29 Sep 2021
/// (Update 2). Left alone: damping `tsuji`, which gives another e than asked for there, and `jkr`
/// on walls, which never captures.
std::vector<ExportedFile> lammps_files(const ExportJob& job);

}  // namespace recoil
