#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "data/dataset.hpp"
#include "experiment/import.hpp"

namespace recoil {

/// One passage of a sphere through the probe volume, in SI units.
struct Passage {
  double time = 0.0;        ///< [s]
  double velocity = 0.0;    ///< normal to the surface, positive towards it [m/s]
  double tangential = 0.0;  ///< along the surface [m/s]; 0 if not measured
  double diameter = 0.0;    ///< [m]
  std::uint32_t series = 0;
  int line = 0;  ///< in the file
};

/// A row that could not be used.
struct BadRow {
  int line = 0;
  std::string problem;
};

/// The unit of a field, from the command line or the data package.
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
  std::size_t damaged = 0;          ///< rows left out: missing, non-numeric or impossible cells
  std::vector<BadRow> first_damaged;     ///< up to `most_examples`
  std::size_t duplicated = 0;            ///< rows left out because they repeat another row
  std::vector<int> first_duplicated;     ///< their lines, up to `most_examples`
  std::size_t unsorted = 0;              ///< rows out of order in time, which were sorted
  int first_unsorted = 0;                ///< line
  std::vector<std::string> ignored;      ///< names of columns that are not used
  std::optional<Provenance> provenance;  ///< from the data package
  std::vector<FieldUnit> units;          ///< of the fields that were read
  std::vector<ImportNote> notes;         ///< what was skipped above the header, or assumed
};

inline constexpr std::size_t most_examples = 3;

struct PassageFormat {
  /// Units by field (time, velocity, tangential_velocity, diameter, series). They override the
  /// header, which overrides the data package.
  std::map<std::string, std::string> units;
  std::map<std::string, std::string> columns;  ///< names of columns in the file, by field
  bool positive_away = false;                  ///< velocities away from the surface are positive
  bool decimal_comma = false;                  ///< numbers are written 2,5
};

/// Reads the passages of `path`, as `table_text` does. Units are those of `format`, or else of the
/// header ("AT [ms]"), or else of the resource with this name in `datapackage.json` beside the
/// file. The header is the first line with the needed columns, by a name of `columns_of`. Decimal
/// commas are recognised where commas do not separate cells and cannot group thousands. Damaged and
/// repeated rows are left out and counted, and rows are sorted. Reads 1e6 rows in about a second.
/// @throws InputError if the file cannot be read, a column or a unit is missing, several columns
///   could be meant, or most rows are damaged
PassageTable read_passages(const std::filesystem::path& path, const PassageFormat& format);

/// The same from texts. @param package_text the data package beside the file; empty: none
PassageTable parse_passages(const std::string& text, const std::string& file,
                            const std::string& package_text, const PassageFormat& format);

}  // namespace recoil
