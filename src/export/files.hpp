#pragma once

#include "core/files.hpp"
#include "export/export_job.hpp"

/// The files of an export, one function for each program. Paths are relative to the output folder.
namespace recoil {

/// `recoil_rebound.c`: a user-defined function DEFINE_DPM_BC for walls with a discrete phase in
/// Ansys Fluent. e(V, d) is a table with captures, which end the path of a sphere.
std::vector<WholeFile> fluent_files(const ExportJob& job);

/// `impact.lammps`: one impact on the plane z = 0 in `units micro` (um, us, pg). The force law is
/// in atom-style variables and acts through `fix addforce`; the stock model is `pair_style
/// granular` with `jkr`, or `hertz/material` without adhesion, and viscoelastic damping. Tested
/// with LAMMPS 29 Sep 2021 (Update 2). Not used: damping `tsuji`, which does not give the requested
/// e there, and `jkr` of `fix wall/gran`, which parts at a wrong distance there.
std::vector<WholeFile> lammps_files(const ExportJob& job);

/// `impact.liggghts`: one impact on the plane z = 0 in SI units, Hertz with the nearest constant
/// restitution. Tested with LIGGGHTS 3.8.0. Not used: its cohesion `sjkr`, a force proportional to
/// the contact area, which corresponds to no law of adhesion here.
std::vector<WholeFile> liggghts_files(const ExportJob& job);

/// `recoilRebound/`: a patch interaction model for clouds of OpenFOAM (openfoam.com, v1912 and
/// later), a library that `wmake` builds and `libs` of the controlDict loads. e(V, d) is a table
/// with captures: a captured sphere is stopped and made inactive, as by `stick`.
std::vector<WholeFile> openfoam_files(const ExportJob& job);

/// `impact.py`: one impact on the plane z = 0 in SI units, with the force law as an engine in
/// Python, or with a wall of `MindlinPhys` with the nearest constant restitution. Tested with YADE
/// 2023.02a.
std::vector<WholeFile> yade_files(const ExportJob& job);

}  // namespace recoil
