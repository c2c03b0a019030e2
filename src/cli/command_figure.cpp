#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>

#include "analysis/analysis.hpp"
#include "cli/commands.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/quoting.hpp"
#include "document/sentence.hpp"
#include "plot/draw.hpp"
#include "report/fit_report.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

constexpr double letters_per_mm = 13.0 / 2.82;  ///< px of letters of 13 px that are 8 points high
constexpr double height_of_width = 0.8;

/// A new folder that only its owner may enter; it is removed with its files.
class PrivateFolder {
 public:
  PrivateFolder() {
    std::string name = (fs::temp_directory_path() / "recoil-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw cannot_be_written(name, errno);
    path = name;
  }
  ~PrivateFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  fs::path path;
};

/// The SVG file as PDF or PNG, made by rsvg-convert. @throws InputError if there is no such program
std::string converted(const std::string& svg, const std::string& format) {
  const PrivateFolder folder;
  const fs::path from = folder.path / "figure.svg", to = folder.path / "figure";
  write_whole_file(from, svg);
  std::vector<std::string> words = {"rsvg-convert", "--format=" + format, "--dpi-x=600",
                                    "--dpi-y=600",  "--output",           to.string(),
                                    from.string()};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t child = 0;
  int status = posix_spawnp(&child, "rsvg-convert", nullptr, nullptr, arguments.data(), environ);
  if (status != 0) {
    throw InputError({}, fmt::format("no {} can be made", format),
                     "the program rsvg-convert is not installed",
                     "install the package librsvg2-bin, or write a .svg");
  }
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (status != 0) throw ComputationError("rsvg-convert could not convert the figure");
  return read_bytes(to);
}

/// The format that the name of a file states: pdf, svg or png. @throws InputError for another one
std::string format_of(const fs::path& file) {
  const std::string extension = file.extension().string();
  for (const char* known : {"pdf", "svg", "png"}) {
    if (extension == std::string(".") + known) return known;
  }
  throw InputError({file.string()}, "the name states no format of a figure", "",
                   "end it in .pdf, .svg or .png");
}

void run_figure(const GivenOptions& given) {
  if (!given.has("--out")) {
    throw UsageError("it is not known where to write; give --out FILE.pdf, .svg or .png");
  }
  const fs::path out = given.text("--out");
  require_figure(out);
  const double width = given.number("--width") * 1e3;  // [mm]
  const AnalysisOptions options = analysis_options(given);
  const Analysis analysis = analyse(load_inputs(given.text("FIT")), options);
  const int px = pixels_of_figure(width);
  const auto height = static_cast<int>(std::lround(height_of_width * px));
  write_figure(out, plot::draw_svg(restitution_overview(analysis, px, height), width));
  print_line(plain_text(figure_caption(analysis)));
  print_text("{}: written\n", out.string());
}

}  // namespace

void require_figure(const fs::path& file) {
  format_of(file);
  require_free({file});
}

void write_figure(const fs::path& file, const std::string& svg) {
  const std::string format = format_of(file);
  write_whole_file(file, format == "svg" ? svg + "\n" : converted(svg, format));
}

int pixels_of_figure(double width) { return static_cast<int>(std::lround(width * letters_per_mm)); }

void add_figure(Program& program) {
  program.command("figure", "draw e against V for a publication", R"(
Fits as `recoil fit` does, draws the points with their errors, captures, curves and bands, and
prints a caption. Letters are 8 points high at any width. PDF and PNG (600 dpi) need the program
rsvg-convert.

  recoil figure fits/dahneke1975-quartz.toml --out figure.pdf --width 85mm)",
                  run_figure);
}

}  // namespace recoil
