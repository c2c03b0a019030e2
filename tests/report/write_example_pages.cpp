// Writes the pages of the example analyses into a folder, to be looked at:
//   write_example_pages DIR

#include <fmt/format.h>

#include "core/files.hpp"
#include "example_analysis.hpp"
#include "report/index_document.hpp"
#include "report/result_json.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: write_example_pages DIR\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  std::vector<recoil::IndexEntry> entries;
  for (const recoil::Analysis& analysis :
       {recoil::sample::four_diameters(), recoil::sample::two_datasets()}) {
    const std::string id = analysis.spec.id;
    recoil::write_whole_file(folder / (id + ".html"), recoil::html_report(analysis));
    recoil::write_whole_file(folder / (id + ".json"), recoil::fit_json(analysis));
    recoil::write_whole_file(folder / (id + ".txt"), recoil::text_report(analysis));
    entries.push_back({id + ".html", recoil::summary_of(analysis), recoil::thumbnail(analysis)});
  }
  recoil::write_whole_file(folder / "index.html", recoil::html_index(entries));
}
