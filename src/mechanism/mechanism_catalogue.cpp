#include <algorithm>

#include "mechanism/mechanism.hpp"

namespace recoil {

// RECOIL_MECHANISMS is X(id) X(id) ..., made by CMakeLists.txt from the files of this folder.
#define X(id) Mechanism id();
RECOIL_MECHANISMS
#undef X

namespace {

std::vector<Mechanism> all_mechanisms() {
  std::vector<Mechanism> all;
#define X(id) all.push_back(id());
  RECOIL_MECHANISMS
#undef X
  std::ranges::sort(all, [](const Mechanism& a, const Mechanism& b) {
    return std::tie(a.info.place, a.info.id) < std::tie(b.info.place, b.info.id);
  });
  for (Mechanism& mechanism : all) {
    for (Parameter& parameter : mechanism.info.parameters) parameter.mechanism = &mechanism;
  }
  return all;
}

}  // namespace

const std::vector<Mechanism>& mechanism_catalogue() {
  static const std::vector<Mechanism> catalogue = all_mechanisms();
  return catalogue;
}

const Mechanism* find_mechanism(std::string_view id) {
  for (const Mechanism& mechanism : mechanism_catalogue()) {
    if (mechanism.info.id == id) return &mechanism;
  }
  return nullptr;
}

const Mechanism* rival_among(const std::vector<std::string>& ids, std::string_view id) {
  const std::string_view rival = find_mechanism(id)->info.not_with;
  for (const std::string& other : ids) {
    const Mechanism* const found = find_mechanism(other);
    if (found->info.id == rival || found->info.not_with == id) return found;
  }
  return nullptr;
}

std::vector<const Mechanism*> chain_of(const std::vector<std::string>& ids) {
  std::vector<const Mechanism*> chain;
  for (const Mechanism& mechanism : mechanism_catalogue()) {
    if (std::ranges::find(ids, mechanism.info.id) != ids.end()) chain.push_back(&mechanism);
  }
  return chain;
}

}  // namespace recoil
