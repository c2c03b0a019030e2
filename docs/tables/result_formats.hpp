#pragma once

#include <string_view>
#include <vector>

#include "core/json.hpp"

namespace recoil {

/// A kind of JSON that recoil writes.
struct ResultFormat {
  std::string_view name;  ///< "fit": its schema is fit.schema.json
  Json schema;            ///< JSON Schema with `$id`
};

const std::vector<ResultFormat>& result_formats();

}  // namespace recoil
