#include "options/option_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/resumable.hpp"
#include "data/limits.hpp"
#include "data/system.hpp"
#include "estimate/fit_spec.hpp"
#include "estimate/model.hpp"
#include "experiment/import.hpp"
#include "export/exported_impact.hpp"
#include "predict/simulated_impact.hpp"

namespace recoil {
namespace {

using takes::assignments;
using takes::list;
using takes::nothing;
using takes::number;
using takes::one_of;
using takes::path;
using takes::quantity;
using takes::repeated;
using takes::text;
using takes::whole;

OptionType velocity() {
  return quantity(Dimension::velocity, "m/s", velocity_limits.first, velocity_limits.second);
}

OptionType diameter() {
  return quantity(Dimension::length, "um", diameter_limits_um.first, diameter_limits_um.second);
}

OptionType within(Dimension dimension, const Range& range) {
  return quantity(dimension, si_unit(dimension), range.lower, range.upper);
}

}  // namespace

bool has_word(std::string_view words, std::string_view word) {
  return fmt::format(" {} ", words).find(fmt::format(" {} ", word)) != std::string::npos;
}

const std::vector<OptionRow>& option_rows() {
  static const std::vector<OptionRow> rows = {
      // arguments
      {"fit diagnose figure simulate predict export plan coverage", "FIT", takes::fit_file(),
       "a fit file", required},
      {"report", "FIT", repeated(takes::fit_file()), "fit files (default: fits/*.toml)"},
      {"compare", "FIT.json", repeated(path("FIT.json"), 2),
       "two or more fit.json of the same datasets", required},
      {"check init merge", "DIR", path("DIR"),
       "the folder: of a dataset, of a new one, or of the shards", required},
      {"import bounce", "FILE", repeated(path("FILE")),
       "what to read; - for standard input; several files are launches of one ball", required},
      {"pair", "PASSAGES", path("PASSAGES"),
       "CSV file, one row per passage: time, velocity, diameter; optional tangential_velocity and "
       "series (a run; times of different runs are not compared)",
       required},
      {"cluster", "SYSTEM", one_of({"slurm", "parallel"}), "slurm, or parallel (GNU parallel)",
       required},
      {"help", "COMMAND", text("COMMAND"), "a command (default: all of recoil)"},

      // what only one command or a few do
      {"simulate", "--velocity", velocity(), "incident velocity", required},
      {"simulate", "--diameter", diameter(), "sphere diameter", required},
      {"simulate", "--history", path("FILE"), "write the forces against time (CSV)"},
      {"coverage", "--datasets", whole(1, 1000000), "simulated data sets", "100", "coverage",
       "datasets"},
      {"coverage", "--posterior", nothing(),
       "check the posterior instead (posterior SBC): can it be believed for these points?", "",
       "coverage", "posterior"},
      {"diagnose", "--causes", nothing(),
       "for balls from 1 mm on without adhesion: search pairs of causes, too (minutes)"},
      {"diagnose", "--rates", whole(1, 1000000),
       "also measure the error rates of the diagnosis for this design: simulate and diagnose this "
       "many data sets for each cause that is named or listed, at full and at half strength, and "
       "for no cause"},
      {"merge", "--missing", nothing(),
       "only print the missing shards, as --array=3,7-9; print nothing if none is missing"},
      {"cluster", "--shards", whole(1, most_shards), "how many", required},
      {"cluster", "--cpus", whole(1, 4096), "threads of each shard", "1"},
      {"cluster", "--time", takes::clock_time(), "time limit of each shard, at least 00:10:00",
       "01:00:00"},

      {"predict", "--sizes", path("FILE"), "the size distribution (CSV)", required},
      {"predict", "--unit", text("UNIT"),
       "unit of its diameters: um, mm or m (default: from the datapackage.json beside it, "
       "otherwise um)",
       "", "predict", "unit"},
      {"predict", "--height", quantity(Dimension::length, "mm", 0.0, 1e3),
       "height of the measuring plane above the surface (default: from the datapackage.json beside "
       "the sizes, otherwise 1 mm)",
       "", "predict", "height_mm"},
      {"predict", "--midpoints", nothing(),
       "place all spheres of a bin at its midpoint, as in the paper (default: spread them over the "
       "bin)",
       "", "predict", "midpoints"},

      {"export", "--to", one_of(all_names<ExportTarget>()), "the program", required},
      {"export", "--diameter", diameter(),
       "sphere diameter (default: the middle one of the dataset; openfoam, fluent and table: all)"},
      {"export", "--stock", nothing(),
       "lammps, yade: write the nearest of the program's own contact models, for many spheres, "
       "instead of the force law (liggghts: always)"},
      {"figure", "--width", quantity(Dimension::length, "mm", 40.0, 400.0),
       "its width: a column of a journal has 80 to 90 mm", "85"},
      {"report", "--force", nothing(), "write every page again, even if nothing has changed"},

      // datasets
      {"init", "--points", path("FILE"),
       "the points (a table) with a header such as V [m/s],e or the columns of a dataset "
       "(default: example points)"},
      {"init", "--provenance", one_of({"measured", "digitised"}), "where these points come from",
       "measured"},
      {"init bounce", "--diameter", diameter(), "diameter of all spheres"},
      {"import bounce", "--format", one_of(all_names<ImportFormat>()),
       "what the file holds (default: the format that its columns fit)"},
      {"bounce", "--ball", text("NAME"),
       "table-tennis, tennis, golf or squash, with size and mass of the rules; or a material "
       "(recoil materials), with --diameter"},
      {"bounce", "--mass", number(1e-9, 1e4), "mass of the ball [kg]"},
      {"bounce figure", "--out", path("FILE"),
       "draw e against V into this file: .pdf, .svg or .png"},
      {"import", "--into", path("DIR"),
       "the dataset's folder; without it, import says what it finds and what it still needs"},
      {"init import bounce", "--sheet", text("NAME"),
       "sheet of a workbook: its name, or its number from 1 on (default: the first that is not "
       "hidden)"},
      {"init import bounce", "--map", repeated(text("QUANTITY=COLUMN:UNIT")),
       "quantity=column:unit, separated by commas; quantity=a+b+c for repeats in several columns; "
       "quantity=100cm for a constant; a unit may have a factor (0.35mm)"},
      {"import", "--sd-of", one_of({"one", "mean"}),
       "whether the stated standard deviations are those of one impact or of the mean of all "
       "events of a point"},
      {"import", "--diameter", repeated(text("DIAMETER")),
       "diameter of the spheres: 4.9um, or SERIES=4.9um once for each series"},
      {"import", "--diameter-error", text("ERROR"),
       "one standard deviation of the diameters: 1% or 0.1um"},
      {"import bounce", "--series", text("NAME"), "name of the series if the file has none"},
      {"init import", "--particle", text("MATERIAL"),
       "the sphere: a name (recoil materials), a JSON file, or key=value,... with material, "
       "density [kg/m3], youngs_modulus [Pa], poisson_ratio; NAME,key=value changes a constant"},
      {"init import", "--surface", text("MATERIAL"),
       "the surface, in the same form; its density may be left out"},
      {"init import pair", "--like", path("DIR"), "take the materials of this dataset"},
      {"import", "--adhesion-energy", within(Dimension::energy_per_area, limits::adhesion_energy),
       "work of adhesion of the two materials; 0: no adhesion"},
      {"import", "--provenance", one_of({"measured", "digitised", "synthetic"}),
       "where the points come from (default: that of the format)"},
      {"import", "--source", repeated(text("TEXT")),
       "who measured or published the points; once for each source"},
      {"import", "--axis", repeated(text("AXIS")),
       "axis of a figure: x=log,MIN,MAX or y=linear,MIN,MAX,LENGTHpx; once for each axis"},
      {"import", "--reading-error", text("ERROR"),
       "one standard deviation of a reading: 0.5% of an axis, or 2px"},
      {"import", "--error-series", repeated(text("SERIES=UPPER,LOWER")),
       "SERIES=UPPER or SERIES=UPPER,LOWER: these series are the ends of the error bars of SERIES"},
      {"import", "--scatter", text("ERROR"),
       "scatter of e in addition to the errors of reading: 10%, or 0.02"},
      {"import bounce", "--captured-below", number(0.0, 1.0),
       "count a restitution below this as a capture (digitised points, heights)"},
      {"import bounce", "--drop-error", text("ERROR"),
       "one standard deviation of the drop or release height: 1mm or 1%"},
      {"import bounce", "--rebound-error", text("ERROR"),
       "one standard deviation of the rebound height"},
      {"import bounce", "--time-error", text("ERROR"),
       "one standard deviation of the time of one bounce: 1ms"},
      {"import bounce", "--transpose", nothing(), "exchange the rows and columns of the file"},
      {"import bounce", "--average", nothing(), "make one point of all drops from the same height"},
      {"import bounce", "--gravity", quantity(Dimension::acceleration, "m/s2", 1e-3, 1e3),
       "gravity", "9.80665"},
      {"import bounce", "--fps", quantity(Dimension::frequency, "1/s", 1e-3, 1e9),
       "frames per second of a track"},
      {"import bounce", "--scale", quantity(Dimension::length, "m", 1e-12, 1.0),
       "length of a pixel of a track: 0.4mm (default: the fall under gravity gives it)"},
      {"import", "--method", one_of(all_names<Method>()),
       "how velocities were measured (default: depends on the format)"},
      {"import bounce", "--ambient-pressure", within(Dimension::pressure, limits::pressure),
       "air pressure, to remove the effect of drag from heights and intervals (default: 101325 "
       "Pa); 0: vacuum"},
      {"import bounce", "--condition", repeated(text("NAME=VALUE")),
       "condition NAME=VALUE of all points: target_thickness=5mm, relative_humidity=40%, "
       "temperature=20degC"},

      // passages
      {"pair", "--unit", assignments("FIELD=UNIT"),
       "units, e.g. time=ms,velocity=m/s,diameter=um; not needed where datapackage.json beside the "
       "file states them",
       "", "pair", "units"},
      {"pair", "--column", assignments("FIELD=NAME"),
       "names of columns, for files with other names than the fields, e.g. velocity=LDA1", "",
       "pair", "columns"},
      {"import bounce pair", "--decimal-comma", nothing(), "the decimal mark is a comma (2,5)", "",
       "pair", "decimal_comma"},
      {"pair", "--positive", one_of({"towards", "away"}),
       "the direction in which velocities are positive: towards the surface or away from it",
       "towards", "pair", "positive"},
      {"pair", "--height", quantity(Dimension::length, "mm", 1e-3, 1e3),
       "first estimate of the height of the measuring plane above the surface", "1", "pair",
       "height"},
      {"pair", "--height-range", number(1.0, 10.0),
       "the true height lies within this factor of the first estimate; 1: use it unchanged", "1.5",
       "pair", "height_range"},
      {"pair", "--diameter-tolerance", number(1e-3, 2.0),
       "largest relative difference of the two diameters of one sphere; the data set the limit "
       "below this",
       "0.2", "pair", "diameter_tolerance"},
      {"pair", "--velocity-tolerance", number(1e-3, 0.5),
       "largest relative difference between a rebound and its return; the data set the limit below "
       "this",
       "0.15", "pair", "velocity_tolerance"},
      {"pair", "--keep-later", nothing(), "use second and third impacts as well", "", "pair",
       "keep_later"},
      {"pair", "--threshold", quantity(Dimension::velocity, "m/s", 0.0, 1e4),
       "leave out incident velocities below this (at the plane), as the paper does to remove "
       "second impacts; recoil prints the effect",
       "", "pair", "threshold"},
      {"pair", "--angle", quantity(Dimension::angle, "deg", 0.0, 90.0),
       "use only rebounds within this angle of the normal; the paper uses 8 degrees; needs "
       "tangential_velocity",
       "", "pair", "angle"},
      {"pair", "--lost-share", number(0.0, 0.9),
       "share of rebounds that the instrument misses (default: the share that it misses on their "
       "way down)",
       "", "pair", "lost_share"},
      {"pair", "--per-bin", whole(2, 1000000), "approximate number of impacts in one point", "40",
       "pair", "per_bin"},
      {"pair", "--size-classes", whole(1, 100),
       "number of size classes with equally many spheres, each a series of points", "1", "pair",
       "size_classes"},
      {"pair", "--size-edges", list(diameter(), "D,D,...", 1, takes::many),
       "limits of the size classes, e.g. 20,40,60,110; spheres outside them are left out", "",
       "pair", "size_edges"},
      {"pair", "--mean-diameter", nothing(),
       "use the mean diameter of all spheres of a series and size class (d10, as in the paper) "
       "instead of the mean of each point",
       "", "pair", "mean_diameter"},
      {"pair", "--into", path("DIR"),
       "write a dataset folder: points, datapackage.json and, unless there are size classes, "
       "sizes.csv"},
      {"pair", "--provenance", one_of(all_names<Provenance>()),
       "where the passages come from, if no datapackage.json beside them states it"},
      {"pair", "--impacts", path("FILE"), "write all impacts and all unpaired passages here (CSV)"},
      {"pair", "--histograms", path("DIR"),
       "write histograms and size distributions (CSV) into this folder"},

      // plans
      {"plan", "--diameter", list(diameter(), "D,D,...", 1, takes::many),
       "available sphere diameters, e.g. 2,5,10 (default: those of the points)"},
      {"plan", "--error", number(1e-4, 1.0),
       "wanted relative standard error of every free parameter and capture velocity (the median "
       "over what the parameters may be)",
       "0.1"},
      {"plan", "--impacts", whole(1, 10000000),
       "total number of impacts (default: as many as the wanted error needs, at most 10000)"},
      {"plan", "--events", whole(1, 100000), "number of impacts averaged in one point", "20"},
      {"plan", "--checks", number(0.0, 1.0),
       "share of the points that is spread evenly to detect a wrong model", "0.25"},
      {"plan", "--assume", assignments("NAME=VALUE"),
       "assume these values of parameters, to a factor of 2, e.g. C_H=3e-3,f0=9, or W=0.1 with the "
       "laws jkr, dmt and "
       "maugis (default: the initial values of the fit file)"},
      {"plan", "--scatter", number(0.0, 1.0),
       "standard deviation of the e of one impact, relative to e", "0.05"},
      {"plan", "--floor", number(1e-6, 1.0),
       "part of that standard deviation that does not depend on e", "0.01"},
      {"plan", "--spread", number(0.0, 0.5),
       "relative standard deviation of the capture velocity from impact to impact; 0: capture is "
       "sharp",
       "0.05"},

      // what many commands share
      {"export plan", "--velocity", list(velocity(), "MIN,MAX", 2, 2),
       "range of incident velocities (default: that of the points; of a plan without points: 0.8 "
       "to 30 times the capture velocities)"},
      {"simulate predict export", "--dataset", text("ID"),
       "id of the dataset, in a fit of several (default: the first)", "", "predict", "dataset"},
      {"simulate export plan", "--parameters", path("FILE"),
       "take the values from this fit.json, of the same fit and data", "", "model", "fitted"},
      {"fit diagnose predict plan", "--out", path("DIR"),
       "folder for the results (default: nothing is written)"},
      {"export cluster", "--out", path("DIR"), "folder for the files", required},
      {"report", "--out", path("DIR"), "folder for the pages", "reports"},
      {"pair coverage", "--out", path("FILE"),
       "also write the table to this file; coverage --shard: folder for the shards"},
      {"import pair plan", "--replace", nothing(),
       "replace existing points; import keeps the materials, and a reconstruction becomes "
       "digitised"},
      {"fit diagnose coverage", "--shard", takes::shard(),
       "compute only shard K of N (1/N to N/N) and write it to DIR; recoil merge DIR combines the "
       "shards"},
      {"fit diagnose coverage", "--parts", path("DIR"), ""},
      {"fit figure report predict export coverage", "--replicates",
       takes::or_word(whole(0, 1000000), "auto"),
       "number of bootstrap replicates; 0: none; auto: until the intervals are precise enough "
       "(default: from the fit file)",
       "", "fit coverage", "replicates"},
      {"fit", "--scheme", one_of(all_names<Scheme>()),
       "resampling scheme of the bootstrap (default: from the fit file)", "", "fit", "scheme"},
      {"fit diagnose figure report predict export coverage", "--seed", whole(0, 0x1p63),
       "seed of the random numbers, which fixes every digit of the output (default: from the fit "
       "file)",
       "", "fit coverage diagnose", "seed"},
      {"fit diagnose figure report predict export coverage merge", "--threads", whole(0, 4096),
       "threads to use; 0: all cores", "0", "fit coverage diagnose", "threads"},
      {"fit", "--solver", one_of(all_names<Solver>()),
       "how impacts are integrated: fast, or with CVODES as a reference", "fast", "fit", "solver"},
      {"fit diagnose simulate predict compare pair plan coverage", "--json", nothing(),
       "print the result as JSON; notes and warnings go to stderr"},
      {"fit diagnose plan materials", "--verbose", nothing(), "print all details"},
  };
  return rows;
}

std::vector<const OptionRow*> options_of(std::string_view command) {
  std::vector<const OptionRow*> options;
  for (const OptionRow& row : option_rows()) {
    if (has_word(row.commands, command)) options.push_back(&row);
  }
  return options;
}

std::vector<const OptionRow*> arguments_of(std::string_view function) {
  std::vector<const OptionRow*> arguments;
  for (const OptionRow& row : option_rows()) {
    if (has_word(row.functions, function)) arguments.push_back(&row);
  }
  return arguments;
}

std::string meaning_words(const OptionRow& row) {
  if (row.is_required() && row.is_argument()) return std::string(row.meaning);
  if (row.is_required()) return fmt::format("{} (required)", row.meaning);
  if (row.standard.empty()) return std::string(row.meaning);
  return fmt::format("{} (default: {})", row.meaning, row.standard);
}

}  // namespace recoil
