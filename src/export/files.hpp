#pragma once

#include "export/export_job.hpp"

/// The files of an export, one function for each program.
namespace recoil {

/// `recoil_rebound.c`: a user-defined function of the kind DEFINE_DPM_BC for the wall of a discrete
/// phase in Ansys Fluent. Its e(V, d) is a table, captures included: a sphere that stays ends its
/// path.
std::vector<ExportedFile> fluent_files(const ExportJob& job);

/// `impact.lammps`, one impact on the plane z = 0 in `units micro` (um, us, pg). The force law
/// stands in atom-style variables and acts through `fix addforce`; where e(V) is not that of a
/// force, `fix wall/gran` with Hertz and viscoelastic damping. Tried with LAMMPS 29 Sep 2021
/// (Update 2). Left alone: damping `tsuji`, which gives another e than asked for there, and `jkr`
/// on walls, which never captures.
std::vector<ExportedFile> lammps_files(const ExportJob& job);

/// `impact.liggghts`, one impact on the plane z = 0 in SI units: Hertz with the constant
/// restitution that is nearest. Tried with LIGGGHTS 3.8.0. Left alone: its cohesion `sjkr`, a force
/// in proportion to the area of the contact, which neither law of adhesion has.
std::vector<ExportedFile> liggghts_files(const ExportJob& job);

/// `recoilRebound/`: a patch interaction model for the clouds of OpenFOAM (openfoam.com, v1912 and
/// later), as a library that `wmake` builds and `libs` of the controlDict loads. Its e(V, d) is a
/// table, captures included: a sphere that stays is stopped and made inactive, as `stick` does.
std::vector<ExportedFile> openfoam_files(const ExportJob& job);

/// `impact.py`, one impact on the plane z = 0 in SI units: the force law as an engine in Python, or
/// a wall of `MindlinPhys` with the constant restitution that is nearest. Tried with YADE 2023.02a.
std::vector<ExportedFile> yade_files(const ExportJob& job);

}  // namespace recoil
