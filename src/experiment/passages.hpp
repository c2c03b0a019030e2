#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "data/dataset.hpp"

namespace recoil {

/// One passage of a sphere through the probe volume, SI units.
struct Passage {
  double time = 0.0;        ///< [s]
  double velocity = 0.0;    ///< normal to the surface, positive towards it [m/s]
  double tangential = 0.0;  ///< along the surface [m/s]; 0 where it was not measured
  double diameter = 0.0;    ///< [m]
  std::uint32_t series = 0;
  int line = 0;  ///< in the file
};

/// A row that could not be used.
struct BadRow {
  int line = 0;
  std::string problem;
};

/// The unit of a field, as the command line or the data package states it.
struct FieldUnit {
  std::string field;
  std::string unit;
};

/// The passages of one file, cleaned and sorted by series and time.
struct PassageTable {
  std::string file;
  std::vector<Passage> passages;
  std::vector<std::string> series;  ///< names in order of appearance; one, "all", without a column
  bool has_tangential = false;      ///< the second component was measured
  std::size_t rows = 0;             ///< rows below the header
  std::size_t damaged = 0;          ///< left out: cells missing, not numbers, or impossible
  std::vector<BadRow> first_damaged;     ///< up to `most_examples`
  std::size_t duplicated = 0;            ///< left out: equal in every column to a row that was kept
  std::vector<int> first_duplicated;     ///< lines
  std::size_t unsorted = 0;              ///< rows out of order in time, which were sorted
  int first_unsorted = 0;                ///< line
  std::vector<std::string> ignored;      ///< columns without a meaning here
  std::optional<Provenance> provenance;  ///< as the data package states it
  std::vector<FieldUnit> units;          ///< of the fields that were read
};

inline constexpr std::size_t most_examples = 3;

/// The columns of an instrument's file.
struct PassageFormat {
  /// Field -> unit; goes before the data package. Fields: time, velocity, tangential_velocity,
  /// diameter, series.
  std::map<std::string, std::string> units;
  std::map<std::string, std::string> columns;  ///< field -> the column's name in the file
  bool positive_away = false;  ///< the instrument counts velocities away from the surface positive
};

/// Reads the passages of `path`. Units come from `format`, else from the fields of the resource of
/// this name in `datapackage.json` beside the file. Rows that are damaged or repeated are left out
/// and counted; rows out of order are sorted. Reads 10^6 rows in about a second.
/// @throws InputError when the file cannot be read, a column or a unit is missing, or most rows are
///   damaged (a wrong separator, decimal commas).
PassageTable read_passages(const std::filesystem::path& path, const PassageFormat& format);

/// The same from texts; `package_text` is the data package beside the file, empty for none.
PassageTable parse_passages(const std::string& text, const std::string& file,
                            const std::string& package_text, const PassageFormat& format);

}  // namespace recoil
