#include "validation/recipe/facts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "validation/recipe/facts_monodisperse.hpp"
#include "validation/recipe/facts_polydisperse.hpp"

namespace recoil {
namespace {

const FactKind* find_kind(const std::string& id) {
  for (const auto* catalogue : {&monodisperse_facts(), &polydisperse_facts()}) {
    for (const FactKind& kind : *catalogue) {
      if (kind.id == id) return &kind;
    }
  }
  return nullptr;
}

std::vector<std::string> all_ids() {
  std::vector<std::string> ids;
  for (const auto* catalogue : {&monodisperse_facts(), &polydisperse_facts()}) {
    for (const FactKind& kind : *catalogue) ids.push_back(kind.id);
  }
  return ids;
}

}  // namespace

void require_known_fact(const FactSpec& fact) {
  const FactKind* kind = find_kind(fact.id);
  if (kind == nullptr) {
    const std::string near = nearest_word(fact.id, all_ids());
    throw InputError(fact.where, fmt::format("unknown fact '{}'", fact.id), "",
                     near.empty() ? fmt::format("known: {}", fmt::join(all_ids(), ", "))
                                  : fmt::format("did you mean '{}'?", near));
  }
  for (const std::string& limit : kind->limits) {
    if (!fact.limits.contains(limit)) {
      throw InputError(fact.where,
                       fmt::format("the fact '{}' lacks the limit '{}'", fact.id, limit),
                       "a check without a threshold cannot fail",
                       fmt::format("give {}", fmt::join(kind->limits, ", ")));
    }
  }
  for (const auto& [name, value] : fact.limits) {
    if (std::find(kind->limits.begin(), kind->limits.end(), name) == kind->limits.end()) {
      throw InputError(fact.where, fmt::format("the fact '{}' takes no limit '{}'", fact.id, name),
                       "", fmt::format("it takes {}", fmt::join(kind->limits, ", ")));
    }
  }
}

std::vector<FactCheck> check_facts(const Recipe& recipe,
                                   const std::vector<GeneratedPoint>& points) {
  std::vector<Recipe> siblings;
  for (const std::string& id : recipe.siblings) {
    const std::filesystem::path folder =
        std::filesystem::absolute(recipe.folder).lexically_normal() / ".." / id;
    // A sibling whose points were replaced still has the truth with which this recipe compares.
    const bool aside = !std::filesystem::exists(folder / recipe_name) &&
                       std::filesystem::exists(folder / set_aside_recipe_name);
    siblings.push_back(load_recipe(folder, aside ? set_aside_recipe_name : recipe_name));
  }
  const FactContext context{recipe, points, siblings};
  std::vector<FactCheck> checks;
  for (const FactSpec& fact : recipe.facts) {
    FactCheck check{fact.id, fact.statement, fact.source, false, ""};
    try {
      const FactOutcome outcome = find_kind(fact.id)->evaluate(context, fact.limits);
      check.holds = outcome.holds;
      check.found = outcome.found;
    } catch (const ComputationError& error) {
      check.found = fmt::format("could not be evaluated: {}", error.what());
    }
    checks.push_back(std::move(check));
  }
  return checks;
}

}  // namespace recoil
