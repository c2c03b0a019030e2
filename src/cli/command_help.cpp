#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "cli/commands.hpp"
#include "cli/manual.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/quoting.hpp"
#include "data/text.hpp"
#include "json/results.hpp"

namespace recoil {
namespace {

void list_topics() {
  print_text(
      "Pages of the manual (recoil help TOPIC prints one):\n"
      "\n");
  std::size_t width = 0;
  for (const ManualPage& page : manual_pages()) width = std::max(width, page.topic.size());
  for (const ManualPage& page : manual_pages()) {
    print_text("  {:<{}}  {}\n", page.topic, width, page.title());
  }
  print_text("\nThe options of a command: recoil COMMAND --help\n");
}

void print_topic(const Program& program, const std::string& topic) {
  std::vector<std::string> known;
  for (const ManualPage& page : manual_pages()) {
    known.emplace_back(page.topic);
    if (page.topic != topic) continue;
    print_text("{}", page.text);
    return;
  }
  for (const Command& command : program.commands()) {
    known.push_back(command.name());
    if (command.name() != topic) continue;
    print_text("{}", command.help());
    return;
  }
  const std::string near = nearest_word(topic, known);
  throw InputError(
      {}, fmt::format("the manual has no page {}", quote(topic)), "",
      near.empty() ? "recoil help lists the pages" : fmt::format("did you mean {}?", near));
}

/// Updates the tables that the code makes in every page of `folder`.
void write_pages(const Program& program, const std::filesystem::path& folder) {
  for (const std::filesystem::path& page : files_in(folder, ".md")) {
    const std::string before = read_text_file(page);
    const std::string after = with_manual_tables(before, page.string(), program);
    if (after == before) continue;
    write_whole_file(page, after, Replacing::data);
    print_text("wrote {}\n", page.string());
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
  struct Options {
    std::string topic;
    std::string folder;
    std::string schemas;
  };
  const auto options = std::make_shared<Options>();
  const Command command = program.command("help", "print a page of the manual", R"(
The program contains the pages of docs/.

  recoil help
  recoil help noise)");
  command.option("TOPIC", options->topic, "name of the page (default: list all pages)");
  command.option("--write-docs", options->folder, "the tables that are made from the code")
      .takes("DIR")
      .hidden();
  command.option("--write-schemas", options->schemas, "the JSON Schemas of the results")
      .takes("DIR")
      .hidden();
  command.runs([options, &program] {
    if (!options->schemas.empty()) write_schemas(options->schemas);
    if (!options->folder.empty()) write_pages(program, options->folder);
    if (!options->folder.empty() || !options->schemas.empty()) return;
    if (options->topic.empty()) {
      list_topics();
    } else {
      print_topic(program, options->topic);
    }
  });
}

}  // namespace recoil
