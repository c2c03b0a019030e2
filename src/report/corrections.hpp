#pragma once

#include <string>
#include <vector>

#include "report/figures.hpp"

/// What is said and drawn of the way from simulated events to the points of a reconstruction.
namespace recoil {

/// e - truth against V with each correction left out, and C_A with its error: two pictures of one
/// study. @param index makes the names of the pictures differ.
std::vector<Figure> correction_figures(const CorrectionStudy& study, std::size_t index);

/// One sentence per correction: what leaving it out does to e, C_A and the capture velocity.
std::vector<Sentence> correction_words(const CorrectionStudy& study);

/// "velocities taken at the measuring plane", ...: what is done instead.
std::string words_of(Correction left_out);

/// How many spheres in how many size classes a study is about.
std::string study_words(const CorrectionStudy& study);

/// For a fit's page; empty when there is nothing to show.
std::vector<Block> corrections_blocks(const Analysis& analysis);

}  // namespace recoil
