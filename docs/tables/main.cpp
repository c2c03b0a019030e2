// recoil_tables SCHEMAS FOLDER...: writes the JSON Schemas of all results into the folder SCHEMAS,
// and updates what the code makes in every page of the manual and every Python file of the other
// folders. The first of these also gets the man page and the completion for bash.
#include <fmt/format.h>

#include <exception>
#include <filesystem>

#include "cli/commands.hpp"
#include "core/files.hpp"
#include "core/quoting.hpp"
#include "tables/manual_tables.hpp"
#include "tables/result_formats.hpp"

namespace recoil {
namespace {

void write_made_parts(const Program& program, const std::filesystem::path& folder) {
  for (const char* extension : {".md", ".py"}) {
    for (const std::filesystem::path& file : files_in(folder, extension)) {
      const std::string before = read_text_file(file);
      const std::string after = with_made_parts(before, file.string(), program);
      if (after == before) continue;
      write_whole_file(file, after, Replacing::data);
      print_text("wrote {}\n", file.string());
    }
  }
}

void write_schemas(const std::filesystem::path& folder) {
  for (const ResultFormat& format : result_formats()) {
    write_whole_file(folder / fmt::format("{}.schema.json", format.name),
                     json_text(format.schema, 1), Replacing::data);
  }
}

void write_all(const std::vector<std::string>& folders) {
  Program program("", "", "");
  add_commands(program);
  write_schemas(folders.at(0));
  for (std::size_t i = 1; i < folders.size(); ++i) write_made_parts(program, folders[i]);
  if (folders.size() < 2) return;
  for (const auto& [name, text] : {std::pair("recoil.1", man_page(program)),
                                   std::pair("recoil.bash", bash_completion(program))}) {
    const std::filesystem::path file = std::filesystem::path(folders.at(1)) / name;
    if (std::filesystem::exists(file) && read_text_file(file) == text) continue;
    write_whole_file(file, text, Replacing::data);
    print_text("wrote {}\n", file.string());
  }
}

}  // namespace
}  // namespace recoil

int main(int argc, char** argv) {
  try {
    recoil::write_all(std::vector<std::string>(argv + 1, argv + argc));
    return 0;
  } catch (const std::exception& error) {
    recoil::print_text(stderr, "{}\n", error.what());
    return 2;
  }
}
