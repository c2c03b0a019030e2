#pragma once

#include "export/export_job.hpp"

namespace recoil {

/// `impact.cpp`, a program for Simbody in SI units. Without adhesion and dashpot the contact is
/// Simbody's own HuntCrossleyForce, k x^1.5 (1 + (3/2) c v) with c = C_H / 1.5, which is the same
/// law; with them a Force::Custom holds it. What is no force is a HuntCrossleyForce with the
/// nearest c. Tried with Simbody 3.7.
std::vector<ExportedFile> simbody_files(const ExportJob& job);

}  // namespace recoil
