#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "diagnosis/candidate.hpp"

namespace recoil {

/// Fits of candidates with exact laws to one set of points, each made once: searches that allow
/// errors of the laws begin with them, too. Safe to use from several threads.
class ExactFits {
 public:
  /// The fit of `candidate` from `near` with `tries` starts (`refit_candidate`): the one made
  /// before, or that of `make`.
  Refit of(const Candidate& candidate, std::span<const double> near, int tries,
           const std::function<Refit()>& make) {
    const Key key = key_of(candidate, near, tries);
    {
      const std::scoped_lock lock(mutex_);
      if (const auto found = made_.find(key); found != made_.end()) return found->second;
    }
    Refit refit = make();
    const std::scoped_lock lock(mutex_);
    return made_.emplace(key, std::move(refit)).first->second;
  }

 private:
  /// Name, released, tries; the start and the bounds.
  using Key = std::tuple<std::string, bool, int, std::vector<double>>;

  static Key key_of(const Candidate& candidate, std::span<const double> near, int tries) {
    std::vector<double> values(near.begin(), near.end());
    for (const ParameterSlot& slot : candidate.model.slots) {
      values.push_back(slot.lower);
      values.push_back(slot.upper);
    }
    return {candidate.name(), candidate.released, tries, std::move(values)};
  }

  std::mutex mutex_;
  std::map<Key, Refit> made_;
};

}  // namespace recoil
