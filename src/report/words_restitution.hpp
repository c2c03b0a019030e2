#pragma once

#include <vector>

#include "data/dataset.hpp"
#include "document/document.hpp"
#include "estimate/fit.hpp"

/// The mean restitution of every series, in words and as a table.
namespace recoil {

/// Without adhesion: the mean e of every series, the dependence of e on V, and the difference
/// between series of one size. With adhesion: e at the slowest and the fastest impacts of every
/// size. Empty if nothing rebounded.
/// @param fitted to these points. A setting or launch that its law follows is not apart.
std::vector<Sentence> restitution_sentences(const std::vector<Dataset>& datasets,
                                            const FitResult& fitted);
/// @param adhesion does the contact have adhesion?
std::vector<Sentence> restitution_sentences(const std::vector<Dataset>& datasets, bool adhesion);

/// The coefficient of friction of every dataset with tangential restitutions; empty without any.
std::vector<Sentence> friction_sentences(const std::vector<Dataset>& datasets);

/// The mean e of every series and setting; empty if there is only one.
Table restitution_table(const std::vector<Dataset>& datasets);

}  // namespace recoil
