#pragma once

#include <vector>

#include "analysis/analysis.hpp"
#include "core/random.hpp"
#include "support/synthetic.hpp"

namespace recoil::synthetic {

/// A fit with a known answer and one draw of noise.
struct Case {
  std::vector<Dataset> datasets;
  Observations data;
  FitResult fitted;
};

inline Case noisy_case(std::uint64_t seed = 7) {
  Case made;
  made.datasets = {dataset(Design{})};
  RandomStream random(seed, RandomPurpose::coverage, 0);
  for (ImpactPoint& point : made.datasets[0].points) {
    point.restitution += *point.restitution_sd * random.normal();
  }
  made.data = gather(made.datasets);
  made.fitted = fit(make_model(spec(), made.datasets), made.data);
  return made;
}

/// Few replicates, enough for any interval.
inline UncertaintyOptions small(int threads) {
  UncertaintyOptions options;
  options.replicates = 39;
  options.threads = threads;
  return options;
}

}  // namespace recoil::synthetic
