#pragma once

#include <map>
#include <string>
#include <vector>

#include "validation/recipe/plan.hpp"
#include "validation/recipe/recipe.hpp"

namespace recoil {

/// One fact, evaluated.
struct FactCheck {
  std::string id;
  std::string statement;
  std::string source;
  bool holds = false;
  std::string found;  ///< the number or range that was found, with its limits
};

/// What a check looks at.
struct FactContext {
  const Recipe& recipe;
  const std::vector<GeneratedPoint>& points;
  const std::vector<Recipe>& siblings;
};

using FactLimits = std::map<std::string, double>;

struct FactOutcome {
  bool holds = false;
  std::string found;
};

/// A check of the catalogue: which limits it takes (all of them, SI) and how it decides.
struct FactKind {
  std::string id;
  std::vector<std::string> limits;
  FactOutcome (*evaluate)(const FactContext&, const FactLimits&);
};

/// @throws InputError at the fact when its id is not in the catalogue, or its limits are not those
/// that the check takes.
void require_known_fact(const FactSpec& fact);

/// Evaluates every fact of the recipe on `points` and on the noiseless truth; loads the siblings.
std::vector<FactCheck> check_facts(const Recipe& recipe, const std::vector<GeneratedPoint>& points);

}  // namespace recoil
