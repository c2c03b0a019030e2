#pragma once

#include <string>

#include "report/report.hpp"

/// The sections of a fit's page that are tables and words; each returns HTML, empty when there is
/// nothing to say.
namespace recoil {

std::string parameters_table(const Analysis& analysis);
std::string intervals_table(const Analysis& analysis);
std::string correlations_table(const Analysis& analysis);
std::string goodness_table(const Analysis& analysis);
std::string capture_table(const Analysis& analysis);
std::string two_point_tables(const Analysis& analysis);
std::string bootstrap_table(const Analysis& analysis);
std::string inputs_tables(const Analysis& analysis);
std::string starts_table(const Analysis& analysis);
std::string points_table(const Analysis& analysis);
std::string glossary(const Analysis& analysis);

}  // namespace recoil
