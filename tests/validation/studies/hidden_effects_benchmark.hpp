#pragma once

#include <filesystem>
#include <vector>

#include "validation/studies/diagnosis_answer.hpp"

namespace recoil::hidden {

/// Writes the data sets of the study for other methods. `folder`/cases has one dataset NAME/ and
/// one fit NAME.toml for each, which say nothing of what is hidden. `folder`/truth/truth.csv states
/// it: case, hidden (ids, separated by blanks; empty: nothing), arm, design, signal_to_noise [1],
/// counted (1: a visible effect in a design of several diameters) and nameable (the probability
/// that an ideal judge names it; empty where it is not known). `folder`/answers has METHOD.csv,
/// with case, named and listed, for recoil and for the plain methods that were asked. Data sets of
/// which the wanted strength does not exist, and those with further rounds, are left out.
void write_benchmark(const std::vector<Answered>& answers, const std::filesystem::path& folder,
                     int threads);

}  // namespace recoil::hidden
