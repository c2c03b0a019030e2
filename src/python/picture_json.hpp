#pragma once

#include <vector>

#include "core/json.hpp"
#include "document/document.hpp"

namespace recoil {

/// Pictures as data, for who draws them with a library of his own: every layer is an object with
/// its `kind` and the fields of its struct in plot/plot.hpp; a number that is not finite is null.
Json pictures_json(const Document& document);
Json pictures_json(const std::vector<Figure>& figures);

}  // namespace recoil
