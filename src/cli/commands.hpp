#pragma once

#include "cli/options.hpp"

namespace recoil {

/// Each adds one command to the program: its options, its help and its action.
/// Commands throw InputError (exit status 2) or ComputationError (exit status
/// 3).
void add_check(Program& program);
void add_simulate(Program& program);
void add_fit(Program& program);
void add_diagnose(Program& program);
void add_coverage(Program& program);
void add_init(Program& program);
void add_import(Program& program);
void add_materials(Program& program);
void add_predict(Program& program);
void add_export(Program& program);
void add_compare(Program& program);
void add_report(Program& program);
void add_pair(Program& program);
void add_plan(Program& program);
void add_merge(Program& program);
void add_cluster(Program& program);
/// The manual, which also describes the commands that were added before.
void add_help(Program& program);

/// The commands whose pieces several processes can share.
void add_shared_commands(Program& program);

}  // namespace recoil
