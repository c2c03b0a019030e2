#pragma once

#include <string>
#include <vector>

#include "experiment/import.hpp"

namespace recoil {

/// A table to import: a file, or one of the runs that a file has side by side.
struct ImportPart {
  ImportRequest request;  ///< of one file, with its text, and with columns besides those of --map
  std::string launch;     ///< the name of the file or run if there are several; otherwise empty
};

/// The tables of a request, in the order of its files. Tables of some programs need no --map,
/// unless the user names other columns:
///
/// - phyphox, (In)elastic collision and Acoustic stopwatch: times "Bounce 0 (s)" to "Bounce 5 (s)",
///   "Start (s)" and "Stop 1 (s)" to "Stop 5 (s)", where 0 is an impact that was not heard, or
///   "Event time (s)";
/// - Tracker: t [s] and y [m];
/// - Logger Pro and Graphical Analysis: "Latest: Time (s)", "Data Set 1:Position(m)", ..., where
///   the word before the colon is the run; and the text that begins with "Vernier Format".
/// @param notes gets what was assumed
/// @throws InputError as `table_text`
std::vector<ImportPart> import_parts(const ImportRequest& request, std::vector<ImportNote>& notes);

}  // namespace recoil
