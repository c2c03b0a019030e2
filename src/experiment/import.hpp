#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/names.hpp"
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
};

/// The names of the formats on the command line.
template <>
struct NamesOf<ImportFormat> {
  static constexpr std::array<std::string_view, 5> names = {"webplotdigitizer", "heights",
                                                            "intervals", "csv", "track"};
};

/// What to import, and what the file does not state, as on the command line. Values with units are
/// words such as "4.9um", errors are "2%" (of the value) or "0.5mm".
struct ImportRequest {
  std::filesystem::path file;
  std::string text;  ///< what is in the file, where it is not to be read
  ImportFormat format = ImportFormat::csv;
  std::filesystem::path into;  ///< the dataset's folder
  bool replace = false;        ///< replace the points of the dataset in the folder

  std::vector<std::string> map;  ///< "quantity=column:unit"
  bool decimal_comma = false;    ///< numbers are written 2,5
  std::string
      sd_of;  ///< restitution_sd is that of "one" impact, or of their "mean"; "": not stated
  std::vector<std::string> diameters;  ///< "4.9um" for all, "SERIES=4.9um" for one
  std::string diameter_error;
  std::string series;  ///< name of the series when the file has none

  /// A JSON file, a name of the table of materials, both with "key=value" of other constants behind
  /// a name, or "material=...,density=...,youngs_modulus=...".
  std::string particle;
  std::string surface;
  std::filesystem::path like;             ///< a dataset whose materials are the same
  std::optional<double> adhesion_energy;  ///< [J/m2]; 0: no adhesion

  std::optional<Provenance> provenance;  ///< if not stated, that of the format
  std::string title;
  std::vector<std::string> sources;

  std::vector<std::string> axes;          ///< "x=log,1,100" or "y=linear,0,1,600px"
  std::vector<std::string> error_series;  ///< "SERIES=UPPER" or "SERIES=UPPER,LOWER": ends of bars
  std::string reading_error;              ///< "0.5%" of an axis, or "2px"
  std::string scatter;                    ///< of e, in addition to the errors of the reading
  double captured_below = 0.0;            ///< a restitution below this is a capture [1]

  std::string drop_error, rebound_error;   ///< of the heights
  std::string time_error;                  ///< of one bounce
  bool average = false;                    ///< repeated drops from one height become one point
  std::string gravity = "9.80665";         ///< [m/s2]
  std::optional<double> ambient_pressure;  ///< [Pa]; 0: vacuum
  std::optional<double> temperature;       ///< [K]
  std::optional<double> fps;               ///< frames per second of a track [1/s]
  std::string scale;                       ///< length of a pixel of a track: "0.4mm"
  std::string method;                      ///< how velocities were measured, if not by the format
  std::vector<std::string> conditions;     ///< "target_thickness=5mm"
};

/// An assumption, an omission or the result of a check.
enum class ImportRemark {
  encoding_assumed,      ///< the file is not UTF-8 and was read as Windows-1252
  workbook_converted,    ///< `names`: the program that made a table of its first sheet
  lines_skipped,         ///< `names`: comments, and titles above the header
  rows_left_out,         ///< `names`: a cell that is needed is empty
  signed_velocities,     ///< directions were told by signs; their magnitudes were taken
  diameter_not_used,     ///< --diameter, though every point has its own
  diameters_from_names,  ///< `names`: the series whose names hold their diameters
  columns_not_used,      ///< `names`
  no_reading_error,      ///< of a figure
  reading_error_alone,   ///< restitution_sd holds no scatter of the experiment
  few_drops,             ///< fewer than five from some heights
  no_drop_error,
  without_air,             ///< heights: V = sqrt(2 g h)
  same_point,              ///< heights: both of the same point of the ball
  air_drag,                ///< `air`: the effect of the air's drag on e
  turbulent_air,           ///< `air`: faster than the range of the drag law
  bounces_missing,         ///< `count` pairs of intervals left out
  release_heights,         ///< `releases`: a check of them
  first_bounces_missed,    ///< `names`: launches whose first bounces are not in the file
  bounces_suspected,       ///< `names`: places where a bounce may be missing
  first_bounces_not_used,  ///< no error of the release height is stated
  shared_bounces,          ///< errors of successive points are not independent
  impacts_skipped,         ///< tracks: `count` without enough of a flight on either side
  track_fall,              ///< tracks: `fall` is not `gravity`
  drag_stays,              ///< tracks: the drag of the air is not taken out
  no_source,
  licence_removed,  ///< that of the reconstruction
  recipe_set_aside,
  overrides_left_out,  ///< `left_out`: they contradict the materials
  adhesion_left_out,   ///< nothing is stated of it, and it is too weak to change e of these balls
};

/// Launches from one stated height, if their first bounces were like their second ones.
struct ReleaseCheck {
  double height = 0.0;   ///< as stated [m]
  double first = 0.0;    ///< mean e of the first bounce, with the stated height [1]
  double second = 0.0;   ///< mean e of the second [1]
  double missing = 0.0;  ///< by how much the ball seems to have fallen farther [m]
};

/// The effect of the drag of the air on a restitution that is read without it.
struct AirShare {
  double pressure = 0.0;                ///< [Pa]
  double temperature = 0.0;             ///< [K]
  double slow = 0.0, slow_share = 0.0;  ///< slowest impact [m/s], by which part of e too low [1]
  double fast = 0.0, fast_share = 0.0;  ///< the same of the fastest
  double reynolds = 0.0;                ///< the largest
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
};

/// What was written.
struct ImportResult {
  Dataset dataset;  ///< as `load_dataset` reads it
  std::vector<ImportNote> notes;
};

/// Reads the points, makes them a dataset and writes it into the folder: points.csv, then
/// datapackage.json, each whole or not at all; nothing is written before both are known to be
/// valid.
///
/// With `replace` the existing package keeps its name, its materials and its other resources. An
/// override of K, W_A or f0 that contradicts the materials is never taken over, neither from it nor
/// from `like`. The recipe.toml of a reconstruction is renamed to recipe-set-aside.toml: it is no
/// longer the folder's recipe, but recipes of other folders may still compare with it.
///
/// @throws InputError for a mistake in the file, and for missing information with the name of the
///   option that states it.
ImportResult import_points(const ImportRequest& request);

}  // namespace recoil
