#pragma once

#include <CLI/CLI.hpp>

namespace recoil {

/// Each adds one command to the program: its options, its help and what it does. Commands throw
/// InputError (exit status 2) or ComputationError (exit status 3).
void add_check(CLI::App& program);
void add_simulate(CLI::App& program);
void add_fit(CLI::App& program);
void add_diagnose(CLI::App& program);
void add_coverage(CLI::App& program);
void add_init(CLI::App& program);
void add_import(CLI::App& program);
void add_predict(CLI::App& program);
void add_export(CLI::App& program);
void add_compare(CLI::App& program);
void add_report(CLI::App& program);
void add_pair(CLI::App& program);
void add_plan(CLI::App& program);
void add_merge(CLI::App& program);
void add_cluster(CLI::App& program);
/// The manual; made last, since it lists the others.
void add_help(CLI::App& program);

}  // namespace recoil
