#include "report/words_predict.hpp"

#include <fmt/format.h>

#include "core/units.hpp"

namespace recoil {

std::string words_of(CaptureConvention convention) {
  switch (convention) {
    case CaptureConvention::captured_as_zero:
      return "captured spheres count as e = 0";
    case CaptureConvention::captured_left_out:
      return "captured spheres left out";
    case CaptureConvention::unseen_left_out:
      return "spheres left out also when too slow to be seen";
  }
  return "";
}

std::string words_of(CaptureModel model) {
  switch (model) {
    case CaptureModel::fit:
      return "this fit";
    case CaptureModel::jkr:
      return "JKR";
    case CaptureModel::thornton_ning:
      return "Thornton & Ning, yield";
    case CaptureModel::dahneke:
      return "Dahneke, eq. 1";
    case CaptureModel::wall:
      return "Wall et al., eq. 4";
  }
  return "";
}

Sentence rests_on_words(const CaptureComparison& comparison, CaptureModel model) {
  if (model == CaptureModel::fit) {
    return say("with its parameters, {f0} of other sizes by eq. 12");
  }
  const Sentence constants = say("{W_A} = {:.3g} {J/m2} and {K} = {:.4g} GPa",
                                 comparison.adhesion_energy, comparison.stiffness / units::GPa);
  if (model == CaptureModel::jkr) {
    return constants +
           ", nothing fitted; the elastic sphere of Thornton & Ning sticks at the same velocity";
  }
  if (model == CaptureModel::thornton_ning) {
    const PublishedYield yield = comparison.yield.value_or(PublishedYield{});
    return say("{}, yield pressure {:.3g} MPa ({}); adhesion helps the sphere to yield", constants,
               yield.pressure / 1e6, yield.source);
  }
  return say("{}, {e} = {:.3g} (the largest of the fitted curve), the bond that of JKR", constants,
             comparison.restitution);
}

std::vector<std::string> capture_notes(const CaptureComparison& comparison,
                                       const Dataset& dataset) {
  std::vector<std::string> notes;
  if (comparison.unanswered > 0) {
    notes.push_back(fmt::format(
        "at {} of {} diameters the fit, or more than a tenth of its replicates, has no capture "
        "velocity: no sphere of these sizes rebounds at any velocity",
        comparison.unanswered, comparison.unanswered + comparison.diameter.size()));
  }
  if (!comparison.yield) {
    notes.push_back(
        fmt::format("Thornton & Ning with yield is not drawn: no published yield pressure of {} is "
                    "known to this program",
                    dataset.system.particle.name));
  }
  if (!(comparison.restitution > 0.0)) {
    notes.emplace_back(
        "the models of Dahneke and of Wall et al. are not drawn: the fitted curve has no rebound "
        "to take e from");
  }
  if (comparison.published.empty()) {
    notes.push_back(fmt::format(
        "no capture velocity of {} on {} is published as a number that is known to this program",
        dataset.system.particle.name, dataset.system.surface.name));
  }
  return notes;
}

}  // namespace recoil
