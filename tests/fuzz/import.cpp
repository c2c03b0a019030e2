// What people import, on arbitrary texts: every file is refused with one clear line, and then
// nothing is written, or becomes a folder that the loader accepts. The first line of an input names
// the format, with an asterisk if the columns are not mapped; the rest is the file, which may be a
// workbook.
#include "experiment/import.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "check.hpp"
#include "support/temporary_folder.hpp"

namespace {

namespace fs = std::filesystem;

recoil::ImportRequest request_for(const std::string& format, const fs::path& place) {
  recoil::ImportRequest request;
  request.file = place / "input.csv";
  request.into = place / "made";
  request.diameters = {"2um"};
  request.particle = "material=polystyrene,density=1050,youngs_modulus=2.56e9,poisson_ratio=0.35";
  request.surface = "material=silicon,youngs_modulus=131e9,poisson_ratio=0.28";
  request.provenance = recoil::Provenance::measured;
  request.sources = {"a test"};
  const bool programs = format.ends_with('*');
  request.format = recoil::value_named<recoil::ImportFormat>(format.substr(0, format.find('*')))
                       .value_or(request.format);
  switch (request.format) {
    case recoil::ImportFormat::webplotdigitizer:
      request.axes = {"x=log,1,100", "y=linear,0,1"};
      request.reading_error = "0.5%";
      break;
    case recoil::ImportFormat::heights:
      request.map = {"drop_height=h1:m,rebound_height=h2:m"};
      request.drop_error = "1%";
      request.average = true;
      break;
    case recoil::ImportFormat::intervals:
      if (!programs) request.map = {"launch=run,interval=t:s"};
      request.time_error = "1ms";
      break;
    case recoil::ImportFormat::track:
      if (!programs) request.map = {"time=t:s,pixel=y"};
      break;
    case recoil::ImportFormat::rest:
      request.map = {"drop_height=h:m,rest_time=T:s"};
      break;
    case recoil::ImportFormat::tops:
      request.map = {"launch=run,top=h:m"};
      request.rebound_error = "1mm";
      break;
    case recoil::ImportFormat::blocks:
      request.map = {"launch=run,block_time=T:s,bounces=n"};
      request.time_error = "1ms";
      break;
    case recoil::ImportFormat::recording:
      break;
    case recoil::ImportFormat::csv:
      request.map = {"incident_velocity=V:m/s"};
      break;
  }
  return request;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string input(reinterpret_cast<const char*>(data), size);
  const std::size_t line = input.find('\n');
  static const support::TemporaryFolder place;
  const recoil::ImportRequest request = request_for(input.substr(0, line), place.path());
  if (fs::exists(request.into)) fs::remove_all(request.into);
  support::write_text(request.file, line == std::string::npos ? "" : input.substr(line + 1));
  try {
    const recoil::ImportResult result = recoil::import_points(request);
    fuzz::require(!result.dataset.points.empty(), "points");
    fuzz::require(recoil::load_dataset(request.into).sha256 == result.dataset.sha256,
                  "what was returned stands in the folder");
  } catch (const recoil::InputError& error) {
    fuzz::require_one_line(error);
    fuzz::require(!fs::exists(request.into / "datapackage.json"), "a refusal writes nothing");
  }
  return 0;
}
