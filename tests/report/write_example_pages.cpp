// Writes the pages of the example analyses into a folder, to be looked at:
//   write_example_pages DIR

#include <fmt/format.h>

#include "core/files.hpp"
#include "example_analysis.hpp"
#include "report/fit_report.hpp"
#include "report/index_page.hpp"
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
    recoil::write_whole_file(folder / (id + ".html"), recoil::fit_html(analysis));
    recoil::write_whole_file(folder / (id + ".json"), recoil::fit_json(analysis));
    recoil::write_whole_file(folder / (id + ".txt"),
                             recoil::fit_text(analysis, recoil::Importance::detail));
    entries.push_back({id + ".html", recoil::fit_json(analysis)});
    entries.back().picture = recoil::thumbnail(analysis);
  }
  recoil::write_whole_file(folder / "index.html", recoil::html_index(entries));
}
