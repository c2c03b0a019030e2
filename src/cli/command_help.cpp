#include <algorithm>
#include <filesystem>

#include "cli/commands.hpp"
#include "cli/manual.hpp"
#include "core/files.hpp"
#include "core/quoting.hpp"
#include "json/results.hpp"

namespace recoil {
namespace {

/// Updates what the code makes in every page of the manual and every Python file of `folder`.
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

}  // namespace

void add_help(Program& program) {
  program.command("help", "show the help of recoil or of a command", R"(
  recoil help
  recoil help fit)",
                  [&program](const GivenOptions& given) {
                    for (const std::string& folder : given.texts("--write-docs")) {
                      write_made_parts(program, folder);
                    }
                    if (given.has("--write-schemas")) write_schemas(given.text("--write-schemas"));
                    if (given.has("--write-docs") || given.has("--write-schemas")) return;
                    const auto commands = program.commands();
                    const auto named = [&](const Program::CommandText& command) {
                      return command.name == given.text("COMMAND");
                    };
                    if (!given.has("COMMAND")) {
                      program.run({"--help"});
                    } else if (std::ranges::any_of(commands, named)) {
                      program.run({given.text("COMMAND"), "--help"});
                    } else {
                      program.run({given.text("COMMAND")});  // says what is wrong with it
                    }
                  });
}

}  // namespace recoil
