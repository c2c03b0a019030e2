#include "report/words_import.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/units.hpp"
#include "data/dataset.hpp"
#include "data/text.hpp"
#include "report/words_dataset.hpp"

namespace recoil {
namespace {

std::string release_words(const ReleaseCheck& check) {
  return fmt::format("{:g} mm: e = {:.3f} at the first bounce, {:.3f} at the second, {:+.1f} mm",
                     check.height / units::mm, check.first, check.second,
                     check.missing / units::mm);
}

std::string air_sentence(const AirShare& air) {
  return fmt::format(
      "the drag of the air ({:g} Pa, {:g} K) was taken out; it had lowered e by {:.2g} % at {:.3g} "
      "m/s and by {:.2g} % at {:.3g} m/s (--ambient-pressure 0 for vacuum)",
      air.pressure, air.temperature, 100.0 * air.slow_share, air.slow, 100.0 * air.fast_share,
      air.fast);
}

}  // namespace

std::string note_sentence(const ImportNote& note) {
  switch (note.remark) {
    case ImportRemark::diameter_not_used:
      return "--diameter was not used: the file has a diameter for every point";
    case ImportRemark::diameters_from_names:
      return fmt::format("diameters were taken from the names of the series: {}",
                         listed(note.names));
    case ImportRemark::columns_not_used:
      return fmt::format("columns not used: {}", listed(note.names));
    case ImportRemark::no_reading_error:
      return "no error of the digitisation is known: --axis x=log,1,100 --axis y=linear,0,1 "
             "--reading-error 0.5% would turn one into velocity_sd and restitution_sd";
    case ImportRemark::reading_error_alone:
      return "restitution_sd holds the error of the reading alone; the scatter of the experiment "
             "comes on top of it: state it with --scatter 10%, or let the fit estimate it with "
             "[noise] variance = \"constant\" or \"capture\"";
    case ImportRemark::few_drops:
      return "from some heights there are fewer than five drops, too few for a standard error; "
             "--rebound-error sets the least";
    case ImportRemark::no_drop_error:
      return "no error of the drop height is known: --drop-error 1mm would state one";
    case ImportRemark::without_air:
      return "V = sqrt(2 g h) leaves out the air, and both heights have to be those of the same "
             "point of the ball";
    case ImportRemark::same_point:
      return "both heights have to be those of the same point of the ball";
    case ImportRemark::air_drag:
      return air_sentence(note.air);
    case ImportRemark::turbulent_air:
      return fmt::format(
          "the Reynolds number of the fastest impact, {:.2g}, is beyond the range of the drag law "
          "(up to 2e5); above that the drag of a smooth sphere can fall to a fifth",
          note.air.reynolds);
    case ImportRemark::bounces_missing:
      return fmt::format("{} {} of intervals left out, because a bounce between them is missing",
                         note.count, note.count == 1 ? "pair" : "pairs");
    case ImportRemark::release_heights: {
      std::vector<std::string> heights;
      for (const ReleaseCheck& check : note.releases) heights.push_back(release_words(check));
      return fmt::format(
          "release heights, a check that no point depends on: how much further than stated the "
          "ball seems to have fallen, if its first bounce was like its second. {}. The same "
          "difference at all heights would be an offset of the scale, such as a reading at another "
          "point of the ball",
          fmt::join(heights, "; "));
    }
    case ImportRemark::shared_bounces:
      return "successive points of one launch share the time of a bounce, so their errors are not "
             "independent (an e too high is followed by one too low); a fit takes them as "
             "independent";
    case ImportRemark::no_source:
      return "no source is stated: --source \"Author (year), journal, figure\" would state one";
    case ImportRemark::licence_removed:
      return "the licence of the reconstruction was removed: that of these points is not known";
    case ImportRemark::recipe_set_aside:
      return fmt::format(
          "the folder is no longer a reconstruction; its {} is kept as {}, for comparison only",
          recipe_name, set_aside_recipe_name);
    case ImportRemark::overrides_left_out:
      return left_out_sentence(note.left_out);
  }
  return "";
}

}  // namespace recoil
