#pragma once

namespace recoil {

/// The files of a dataset's folder that more than one stage speaks of.
inline constexpr const char* package_file_name = "datapackage.json";
/// The recipe of a reconstruction, and the same after other points took the place of its own.
inline constexpr const char* recipe_name = "recipe.toml";
inline constexpr const char* set_aside_recipe_name = "recipe-set-aside.toml";

}  // namespace recoil
