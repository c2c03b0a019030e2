#pragma once

#include <string>
#include <vector>

#include "report/report.hpp"

/// What is said of the way from simulated events to the points of a reconstruction.
namespace recoil {

/// "velocities taken at the measuring plane", ...: what is done instead.
std::string words_of(Correction left_out);

/// One sentence per correction: what leaving it out does to e, C_A and the capture velocity.
std::vector<Sentence> correction_words(const CorrectionStudy& study);

/// How many spheres in how many size classes a study is about.
std::string study_words(const CorrectionStudy& study);

/// For a fit's page; empty when there is nothing to show.
std::vector<Block> corrections_blocks(const Analysis& analysis);

}  // namespace recoil
