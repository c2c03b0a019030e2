#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/names.hpp"
#include "core/units.hpp"
#include "data/datapackage.hpp"
#include "data/dataset.hpp"

namespace recoil {

/// The content of the file to be imported.
enum class ImportFormat {
  webplotdigitizer,  ///< points read off a figure, one or several series
  heights,           ///< drop and rebound heights
  intervals,         ///< times of successive bounces, or between them
  csv,               ///< any table, with a map of its columns
  track,             ///< heights over time
  recording,         ///< the sound of a ball that bounces
  rest,              ///< drop heights and times to rest
  tops,              ///< heights of successive tops
  blocks,            ///< times of several bounces together
};

/// The names of the formats on the command line.
constexpr auto names_of_values(ImportFormat) {
  return name_list("webplotdigitizer", "heights", "intervals", "csv", "track", "recording", "rest",
                   "tops", "blocks");
}

/// The file to import and the information that it lacks, as on the command line. Quantities are
/// words such as "4.9um"; errors are "2%" (of the value) or "0.5mm". A number without a unit counts
/// in um if it is a diameter, otherwise in the SI unit. One member for each option of the command.
struct ImportRequest {
  std::filesystem::path file;
  std::vector<std::filesystem::path> more_files;  ///< each is another launch
  std::optional<std::string> text;  ///< the content to import instead of reading `file`
  ImportFormat format = ImportFormat::csv;
  std::filesystem::path into;  ///< the dataset's folder
  bool replace = false;        ///< replace the points of the dataset in the folder

  std::string sheet;         ///< name or number, from 1, in a workbook; empty: the first
  bool usual_units = false;  ///< columns without a unit are in um, m/s and SI units

  std::vector<std::string> map;  ///< "quantity=column:unit"
  bool decimal_comma = false;    ///< numbers are written 2,5
  bool transpose = false;        ///< exchange the rows and columns of the file
  std::string sd_of;  ///< restitution_sd is of "one" impact, of the "mean", or "": unknown
  std::vector<std::string> diameters;  ///< "4.9um" for all, "SERIES=4.9um" for one
  std::string diameter_error;
  std::string series;  ///< name of the series when the file has none

  /// A JSON file, a name of the table of materials ("steel", or "steel,density=7700" with changed
  /// constants), or "material=...,density=...,youngs_modulus=...".
  std::string particle;
  std::string surface;
  std::filesystem::path like;             ///< a dataset whose materials are the same
  std::optional<double> adhesion_energy;  ///< [J/m2]; 0: no adhesion

  std::optional<Provenance> provenance;  ///< empty: that of the format
  std::string title;
  std::vector<std::string> sources;

  std::vector<std::string> axes;          ///< "x=log,1,100" or "y=linear,0,1,600px"
  std::vector<std::string> error_series;  ///< "SERIES=UPPER" or "SERIES=UPPER,LOWER": ends of bars
  std::string reading_error;              ///< "0.5%" of an axis, or "2px"
  std::string scatter;                    ///< of e, in addition to reading errors
  double captured_below = 0.0;            ///< a restitution below this is a capture [1]

  std::string drop_error, rebound_error;  ///< of the heights
  std::string time_error;                 ///< of one bounce
  bool average = false;                   ///< repeated drops from one height become one point
  double gravity = standard_gravity;      ///< [m/s2]
  std::optional<double> fps;              ///< frames per second of a track [1/s]
  std::string scale;                      ///< length of a pixel of a track: "0.4mm"
  std::string method;                     ///< how velocities were measured; empty: by the format
  std::vector<std::string> conditions;    ///< "target_thickness=5mm"
};

/// A note about an import: an assumption, an omission or the result of a check.
enum class ImportRemark {
  encoding_assumed,      ///< the file is not UTF-8 and was read as Windows-1252
  sheet_read,            ///< `names`: the sheet of a workbook, and those that were not read
  columns_known,         ///< `names`: "time = t [s]": columns taken by their names
  decimal_commas,        ///< the numbers have decimal commas, though none was stated
  lines_skipped,         ///< `names`: comments, and titles above the header
  rows_left_out,         ///< `names`: a needed cell is empty
  rebounds_empty,        ///< `names`: of these, only the rebound, and no column states captures
  signed_velocities,     ///< velocities were signed; their magnitudes were taken
  diameter_not_used,     ///< --diameter, though every point has its own
  diameters_from_names,  ///< `names`: the series whose names contain their diameters
  columns_not_used,      ///< `names`
  no_reading_error,      ///< of a figure
  reading_error_alone,   ///< restitution_sd holds no scatter of the experiment
  few_drops,             ///< fewer than five from some heights
  no_drop_error,
  without_air,             ///< heights: V = sqrt(2 g h)
  same_point,              ///< heights: both have to refer to the same point of the ball
  air_drag,                ///< `air`: the effect of air drag on e
  turbulent_air,           ///< `air`: faster than the range of the drag law
  impossible_left_out,     ///< `names`: single impacts with an e above the limit
  bounces_missing,         ///< `count` pairs of intervals left out
  release_heights,         ///< `releases`: a check of them
  first_bounces_missed,    ///< `names`: launches whose first bounces are not in the file
  bounces_suspected,       ///< `names`: places where a bounce may be missing
  first_bounces_not_used,  ///< no error of the release height is stated
  shared_bounces,          ///< errors of successive points are not independent
  shared_values,           ///< the same, and no fit can know it
  mean_of_bounces,         ///< e is assumed to be the same at all bounces of a point
  impacts_skipped,         ///< tracks: `count` impacts without a long enough flight on both sides
  axis_points_down,        ///< tracks: heights are measured downward
  track_fall,              ///< tracks: `fall` differs from `gravity`
  frames_repeated,         ///< tracks: `count` frames show the one before again
  frames_mended,           ///< tracks: `count` rows are not one frame after the row before
  impacts_heard,           ///< recording: `count` impacts, with the error `time_sd` of an instant
  tracks_without_impact,   ///< `names`: launches or files
  no_source,
  licence_removed,  ///< that of the reconstruction
  recipe_set_aside,
  overrides_left_out,  ///< `left_out`: they contradict the materials
  adhesion_left_out,   ///< it is not stated, and is negligible for these balls
};

/// A check of a release height, which assumes that e of the first and second bounces are equal.
struct ReleaseCheck {
  double height = 0.0;   ///< as stated [m]
  double first = 0.0;    ///< mean e of the first bounce, with the stated height [1]
  double second = 0.0;   ///< mean e of the second [1]
  double missing = 0.0;  ///< apparent height of the fall less the stated one [m]
};

/// The relative error of e if air drag is neglected.
struct AirShare {
  double pressure = 0.0;                ///< [Pa]
  double temperature = 0.0;             ///< [K]
  double slow = 0.0, slow_share = 0.0;  ///< slowest impact [m/s], and how much e is too low [1]
  double fast = 0.0, fast_share = 0.0;  ///< the same for the fastest impact
  double reynolds = 0.0;                ///< largest Reynolds number [1]
};

struct ImportNote {
  ImportRemark remark = ImportRemark::no_source;
  std::vector<std::string> names = {};
  std::size_t count = 0;
  std::vector<ReleaseCheck> releases = {};
  std::vector<LeftOverride> left_out = {};
  AirShare air = {};
  double fall = 0.0;     ///< measured acceleration [m/s2]
  double gravity = 0.0;  ///< [m/s2]
  double time_sd = 0.0;  ///< [s]
};

struct ImportResult {
  Dataset dataset;  ///< the written dataset as `load_dataset` reads it
  std::vector<ImportNote> notes;
};

/// Reads the points, makes a dataset of them, validates it and writes it into the folder, first
/// points.csv and then datapackage.json, each as a whole.
///
/// With `replace` the existing package keeps its name, its materials and its other resources. An
/// override of K, W_A or f0 that contradicts the materials is never copied, neither from it nor
/// from `like`. The recipe.toml of a reconstruction is renamed to recipe-set-aside.toml, because
/// the points are no longer computed from it, while other recipes may still refer to it.
///
/// @throws InputError for a mistake in the file, and for missing information, with the option that
///   states it
ImportResult import_points(const ImportRequest& request);

/// Reads the impacts of balls that bounce, and writes nothing. The materials are not known, and the
/// dataset has no other use than the summary of its points.
/// @param density of the balls, for the drag of air [kg/m3]
/// @throws InputError for a mistake in the file
ImportResult read_bounces(const ImportRequest& request, double density);

}  // namespace recoil
