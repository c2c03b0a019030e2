#pragma once

#include <optional>
#include <utility>

#include "impact/impact.hpp"

namespace recoil {

/// Are these numbers an impact that `options` can be asked about? An inadmissible trial point of an
/// optimiser is a failure, not a crash.
bool is_admissible(const ImpactGroups& groups, const ImpactOptions& options);

/// The impact to simulate instead where the adhesion is so weak that its law cannot be followed and
/// does not matter: Hertz's contact, which every law becomes.
std::optional<std::pair<ImpactGroups, ImpactOptions>> without_adhesion(
    const ImpactGroups& groups, const ImpactOptions& options);

}  // namespace recoil
