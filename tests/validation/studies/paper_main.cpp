// recoil_paper FILE: writes the page "The paper, figure by figure". ./run runs it in the project's
// folder.
#include <cstdio>
#include <exception>

#include "core/files.hpp"
#include "core/numerics.hpp"
#include "document/html.hpp"
#include "validation/studies/paper_page.hpp"

int main(int count, char** words) {
  if (count != 2) {
    std::fputs("usage: recoil_paper FILE.html\n", stderr);
    return 2;
  }
  recoil::gsl_errors_are_values();
  try {
    const recoil::paper::Comparison comparison = recoil::paper::compare_with_paper(".");
    recoil::write_whole_file(words[1],
                             recoil::html_page(recoil::paper::paper_document(comparison)));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "recoil_paper: %s\n", error.what());
    return 1;
  }
  std::printf("%s: written\n", words[1]);
  return 0;
}
