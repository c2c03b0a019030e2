#include "import_folder.hpp"

#include "support/mistake.hpp"

namespace import_folder {

recoil::ImportRequest Place::request(const std::string& text, recoil::ImportFormat format) const {
  write("input.csv", text);
  recoil::ImportRequest request;
  request.file = path() / "input.csv";
  request.format = format;
  request.into = path() / "made";
  request.diameters = {"2um"};
  request.particle = "material=polystyrene,density=1050,youngs_modulus=2.56e9,poisson_ratio=0.35";
  request.surface = "material=silicon,youngs_modulus=131e9,poisson_ratio=0.28";
  request.provenance = recoil::Provenance::measured;
  request.sources = {"A test"};
  const bool flights =
      format != recoil::ImportFormat::webplotdigitizer && format != recoil::ImportFormat::csv;
  if (flights) request.conditions = {"ambient_pressure=0"};  // air would stop such spheres at once
  return request;
}

std::string complaint(const recoil::ImportRequest& request) {
  return support::message_of([&] { recoil::import_points(request); });
}

}  // namespace import_folder
