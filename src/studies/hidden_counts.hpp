#pragma once

#include <functional>
#include <string>
#include <vector>

#include "studies/hidden_effects_study.hpp"

namespace hidden {

using Answers = std::vector<const Answered*>;
using Test = std::function<bool(const Answered&)>;

/// Of the data sets that could be made, those that pass.
Answers those(const std::vector<Answered>& all, const Test& test);
int count(const Answers& answers, const Test& test);
Test marked(std::vector<Mark> marks);
bool is_visible(const Answered& a);

/// "83 % (73 to 91), 58 of 70": with `recoil::share_limits`.
std::string share(int k, int n);

/// The bars, how many of those that were not named nobody could have named, and what other
/// thresholds would give: parts of the report in Markdown.
std::string bars(const std::vector<Answered>& all);
std::string why_not_named(const std::vector<Answered>& all);
std::string other_thresholds(const std::vector<Answered>& all);

}  // namespace hidden
