#include "example_analysis.hpp"

namespace recoil::sample {

CorrectionStudy corrections(std::size_t size_classes) {
  CorrectionStudy study;
  study.passages = 1700;
  study.rebounds_per_velocity = 40.0;
  study.size_classes = size_classes;
  study.velocities = {0.4, 0.6, 1.0, 2.0, 4.0};
  study.diameter = 49e-6;
  study.C_H = 0.005;
  study.C_A = 0.025;
  study.capture_velocity = 0.278;
  for (const Correction left_out : values_of<Correction>()) {
    const auto k = static_cast<double>(left_out);
    CorrectionRow row;
    row.left_out = left_out;
    row.points = 14;
    row.captured = left_out == Correction::survivors ? 0 : 36;
    row.error_slow = -0.002 - 0.01 * k;
    row.error_fast = -0.001;
    for (std::size_t i = 0; i < study.velocities.size(); ++i) row.error.emplace_back(-0.01 * k);
    row.error.back().reset();
    row.usable = left_out != Correction::second_impacts;
    row.C_H = 0.006;
    row.C_H_sd = 0.004;
    row.C_A = left_out == Correction::all_left_out ? 0.0 : 0.02 + 0.004 * k;
    row.C_A_sd = left_out == Correction::all_left_out ? 0.0 : 0.008;
    row.capture_velocity = 0.28;
    row.rmse = 0.02;
    study.rows.push_back(row);
  }
  return study;
}

}  // namespace recoil::sample
