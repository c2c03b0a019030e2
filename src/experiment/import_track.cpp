#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/statistics.hpp"
#include "experiment/import_formats.hpp"

namespace recoil {
namespace {

constexpr std::size_t fewest_samples = 4;  // in a flight

struct Sample {
  double time = 0.0;    ///< [s]
  double height = 0.0;  ///< upward [m] or [pixels]
  int line = 0;
};

/// The samples of one ball, by time.
struct Track {
  std::string name;
  std::optional<double> diameter;  ///< [m]
  std::vector<Sample> samples;
};

/// The finite differences of this order of the heights.
std::vector<double> differences(const std::vector<Sample>& samples, int order) {
  std::vector<double> values;
  for (const Sample& sample : samples) values.push_back(sample.height);
  for (int k = 0; k < order; ++k) {
    for (std::size_t i = 0; i + 1 < values.size(); ++i) values[i] = values[i + 1] - values[i];
    if (!values.empty()) values.pop_back();
  }
  return values;
}

/// The standard deviation of a height from third differences: they vanish for a parabola and have
/// 1 + 9 + 9 + 1 = 20 times the variance of independent errors. For normal errors the median of |x|
/// is 0.6745 standard deviations.
double noise_of(const std::vector<Sample>& samples) {
  std::vector<double> third = differences(samples, 3);
  for (double& value : third) value = std::abs(value);
  return median(third) / (0.6745 * std::sqrt(20.0));
}

/// The minima from which the height rises on both sides, before it falls below the minimum, by more
/// than six standard deviations of the noise and more than 1 % of the whole range.
std::vector<std::size_t> impacts_of(const std::vector<Sample>& samples) {
  const auto [low, high] = std::ranges::minmax_element(samples, {}, &Sample::height);
  const double least = std::max(6.0 * noise_of(samples), 0.01 * (high->height - low->height));
  const auto rises = [&](std::size_t from, int step) {
    const double level = samples[from].height;
    for (auto i = static_cast<std::ptrdiff_t>(from) + step;
         i >= 0 && i < static_cast<std::ptrdiff_t>(samples.size()); i += step) {
      const double height = samples[static_cast<std::size_t>(i)].height;
      if (height > level + least) return true;
      if (height < level || (height == level && step < 0)) return false;
    }
    return false;
  };
  std::vector<std::size_t> impacts;
  for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
    if (rises(i, -1) && rises(i, 1)) impacts.push_back(i);
  }
  return impacts;
}

/// A flight: the samples [begin, end).
struct Arc {
  std::size_t begin = 0;
  std::size_t end = 0;
  double middle = 0.0;  ///< t_k [s]
  bool good = true;     ///< it has enough samples and falls like the others
  double fall = 0.0;    ///< its own a [m/s2], or pixels/s2
  double fall_sd = 0.0;

  std::size_t size() const { return end > begin ? end - begin : 0; }
};

/// The flights before, between and after the impacts. The first one begins after the release of the
/// ball, and the last one ends before the height rises again.
std::vector<Arc> arcs_of(const std::vector<Sample>& samples,
                         const std::vector<std::size_t>& impacts) {
  std::vector<Arc> arcs;
  for (std::size_t k = 0; k <= impacts.size(); ++k) {
    Arc arc;
    arc.begin = k == 0 ? 0 : impacts[k - 1] + 1;
    arc.end = k == impacts.size() ? samples.size() : impacts[k];
    const auto first = samples.begin() + static_cast<std::ptrdiff_t>(arc.begin);
    const auto last = samples.begin() + static_cast<std::ptrdiff_t>(arc.end);
    const auto top = std::ranges::max_element(first, last, {}, &Sample::height);
    if (k == 0 && first != last) {
      const double drop =
          std::max(6.0 * noise_of(samples), 0.02 * (top->height - std::prev(last)->height));
      for (std::size_t i = arc.begin; i < arc.end; ++i) {
        if (samples[i].height > top->height - drop) arc.begin = i + 1;
      }
    }
    if (k == impacts.size() && first != last) {
      auto end = top;
      while (end + 1 < last && (end + 1)->height < end->height) ++end;
      arc.end = static_cast<std::size_t>(end - samples.begin()) + (end + 1 == last ? 1 : 0);
    }
    if (arc.size() > 0) arc.middle = 0.5 * (samples[arc.begin].time + samples[arc.end - 1].time);
    arc.good = arc.size() >= fewest_samples;
    arcs.push_back(arc);
  }
  return arcs;
}

/// The parabolas of the good flights: coefficients c_k, b_k, k = 0, 1, ..., then a.
struct Parabolas {
  Eigen::VectorXd values;
  Eigen::MatrixXd covariance;         ///< divided by the variance of a height
  double variance = 0.0;              ///< of a height, from the residuals
  double freedom = 0.0;               ///< degrees of freedom of the variance
  std::vector<std::ptrdiff_t> first;  ///< index of c_k of every arc; -1 for one that is not good
};

Parabolas fit_parabolas(const std::vector<Sample>& samples, const std::vector<Arc>& arcs) {
  Parabolas fit;
  std::ptrdiff_t unknowns = 0;
  std::ptrdiff_t rows = 0;
  for (const Arc& arc : arcs) {
    fit.first.push_back(arc.good ? unknowns : -1);
    if (!arc.good) continue;
    unknowns += 2;
    rows += static_cast<std::ptrdiff_t>(arc.size());
  }
  ++unknowns;
  Eigen::MatrixXd design = Eigen::MatrixXd::Zero(rows, unknowns);
  Eigen::VectorXd heights(rows);
  std::ptrdiff_t row = 0;
  for (std::size_t k = 0; k < arcs.size(); ++k) {
    if (!arcs[k].good) continue;
    for (std::size_t i = arcs[k].begin; i < arcs[k].end; ++i, ++row) {
      const double t = samples[i].time - arcs[k].middle;
      design(row, fit.first[k]) = 1.0;
      design(row, fit.first[k] + 1) = t;
      design(row, unknowns - 1) = -0.5 * t * t;
      heights(row) = samples[i].height;
    }
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(design);
  fit.values = solver.solve(heights);
  fit.covariance = (design.transpose() * design).inverse();
  if (rows > unknowns) {
    fit.freedom = static_cast<double>(rows - unknowns);
    fit.variance = (heights - design * fit.values).squaredNorm() / fit.freedom;
  }
  return fit;
}

/// Rejects flights that do not fall like the others (a hand, a rolling ball, a lost marker): those
/// whose own a differs from the median by more than 30 % and more than four standard deviations.
void reject_others(const std::vector<Sample>& samples, std::vector<Arc>& arcs) {
  const double noise = noise_of(samples);
  std::vector<double> falls;
  for (Arc& arc : arcs) {
    if (!arc.good) continue;
    const Parabolas own = fit_parabolas(samples, {arc});
    arc.fall = own.values(2);
    arc.fall_sd = noise * std::sqrt(own.covariance(2, 2));
    falls.push_back(arc.fall);
  }
  const double usual = median(falls);
  for (Arc& arc : arcs) {
    const double off = std::abs(arc.fall - usual);
    if (off > 0.3 * std::abs(usual) && off > 4.0 * arc.fall_sd) arc.good = false;
  }
}

/// The intersection of the parabolas of two flights.
struct Meeting {
  double e = 0.0;
  double velocity = 0.0;
  double after = 0.0;  ///< time of the intersection less the time of the minimum [s]
};

/// @param known c_1, b_1, c_2, b_2, a
Meeting meeting_of(const Eigen::Matrix<double, 5, 1>& known, double since_first,
                   double since_second) {
  const double a = known(4);
  const auto height = [&](int c, double t) {
    return known(c) + known(c + 1) * t - 0.5 * a * t * t;
  };
  const double v1 = known(1) - a * since_first;
  const double v2 = known(3) - a * since_second;
  Meeting meeting;
  meeting.after = (height(2, since_second) - height(0, since_first)) / (v1 - v2);
  meeting.velocity = -(v1 - a * meeting.after);
  meeting.e = (v2 - a * meeting.after) / meeting.velocity;
  return meeting;
}

class TrackReader {
 public:
  TrackReader(const ImportRequest& request, bool scaled, std::vector<ImportNote> notes)
      // A copy of a few notes. NOLINTNEXTLINE(performance-unnecessary-value-param)
      : request_(request), scaled_(scaled), gravity_(request.gravity), out_{{}, notes} {}

  void read(const Track& track) {
    const std::vector<Sample>& samples = track.samples;
    if (samples.size() < 2 * fewest_samples) return;
    const std::vector<std::size_t> impacts = impacts_of(samples);
    std::vector<Arc> arcs = arcs_of(samples, impacts);
    reject_others(samples, arcs);
    if (std::ranges::none_of(arcs, &Arc::good)) return;
    const Parabolas fit = fit_parabolas(samples, arcs);
    const double a = fit.values(fit.values.size() - 1);
    if (!(a > 0.0)) return;
    falls_.push_back(a);
    squares_ += fit.variance * fit.freedom;
    freedom_ += fit.freedom;
    for (std::size_t k = 0; k < impacts.size(); ++k) {
      if (!arcs[k].good || !arcs[k + 1].good || !add_point(track, impacts[k], arcs, k, fit)) {
        ++skipped_;
      }
    }
  }

  /// The variance of a height about the parabolas of all balls; infinite without a flight.
  double variance() const { return freedom_ > 0.0 ? squares_ / freedom_ : INFINITY; }

  ImportedPoints result() {
    if (out_.points.empty()) {
      throw InputError({request_.file.string()}, "no impact was found in these tracks",
                       fmt::format("it needs a minimum with {} samples of free flight on either "
                                   "side",
                                   fewest_samples),
                       "check the columns in --map, or film with more frames per second");
    }
    if (skipped_ > 0) out_.notes.push_back({ImportRemark::impacts_skipped, {}, skipped_});
    ImportNote fall{ImportRemark::track_fall};
    fall.fall = median(falls_);
    fall.gravity = gravity_;
    if (scaled_ && std::abs(fall.fall / gravity_ - 1.0) > 0.02) out_.notes.push_back(fall);
    out_.notes.push_back({ImportRemark::drag_stays});
    out_.notes.push_back({ImportRemark::shared_bounces});
    return out_;
  }

 private:
  /// @returns false if the parabolas do not intersect near the minimum
  bool add_point(const Track& track, std::size_t at, const std::vector<Arc>& arcs, std::size_t k,
                 const Parabolas& fit) {
    const std::vector<Sample>& samples = track.samples;
    const double time = samples[at].time;
    const double since[2] = {time - arcs[k].middle, time - arcs[k + 1].middle};
    const std::array<std::ptrdiff_t, 5> places = {fit.first[k], fit.first[k] + 1, fit.first[k + 1],
                                                  fit.first[k + 1] + 1, fit.values.size() - 1};
    const Eigen::Matrix<double, 5, 1> known = fit.values(places);
    const Eigen::Matrix<double, 5, 5> covariance = fit.variance * fit.covariance(places, places);
    // In m/s, also if the heights have no scale: a is then g.
    const auto answer = [&](const Eigen::Matrix<double, 5, 1>& values) {
      Meeting meeting = meeting_of(values, since[0], since[1]);
      if (!scaled_) meeting.velocity *= gravity_ / values(4);
      return meeting;
    };
    const Meeting best = answer(known);
    const double spacing = samples[at + 1].time - samples[at - 1].time;
    if (!(std::abs(best.after) < spacing) || !(best.velocity > 0.0) || !(best.e > 0.0))
      return false;
    Eigen::Matrix<double, 5, 1> slope_e;
    Eigen::Matrix<double, 5, 1> slope_v;
    for (int i = 0; i < 5; ++i) {
      const double step = 1e-6 * std::max(std::abs(known(i)), 1e-3);
      Eigen::Matrix<double, 5, 1> up = known;
      Eigen::Matrix<double, 5, 1> down = known;
      up(i) += step;
      down(i) -= step;
      slope_e(i) = (answer(up).e - answer(down).e) / (2.0 * step);
      slope_v(i) = (answer(up).velocity - answer(down).velocity) / (2.0 * step);
    }
    ImportedPoint point =
        imported_point(track.name, samples[at].line, track.diameter, best.velocity, best.e);
    const double sd_e = std::sqrt(slope_e.dot(covariance * slope_e));
    const double sd_v = std::sqrt(slope_v.dot(covariance * slope_v));
    if (sd_e > 0.0) point.value[Quantity::restitution_sd] = sd_e;
    if (sd_v > 0.0) point.value[Quantity::velocity_sd] = sd_v;
    out_.points.push_back(point);
    return true;
  }

  const ImportRequest& request_;
  bool scaled_;
  double gravity_;
  std::vector<double> falls_;  ///< a of each ball [m/s2], or pixels/s2
  double squares_ = 0.0;       ///< of the residuals
  double freedom_ = 0.0;
  std::size_t skipped_ = 0;
  ImportedPoints out_;
};

std::vector<Track> read_tracks(ImportTable& table, const ImportRequest& request) {
  const bool frames = table.has("frame");
  const bool pixels = table.has("pixel");
  const double pixel = request.scale.empty()
                           ? 1.0
                           : parse_quantity(request.scale, Dimension::length, "m", "--scale");
  std::vector<Track> tracks;
  std::map<std::string, std::size_t> index;
  const std::string clock = frames ? "frame" : "time";
  for (std::size_t r = 0; r < table.size(); ++r) {
    const auto time = table.value(r, clock);
    const auto height = table.value(r, pixels ? "pixel" : "height");
    if (!time || !height) {
      table.leave_out(r);
      continue;
    }
    const std::string name = table.name(r, "series");
    const auto [known, added] = index.try_emplace(name, tracks.size());
    if (added) tracks.push_back({name, table.value(r, "diameter"), {}});
    std::vector<Sample>& samples = tracks[known->second].samples;
    const double seconds = frames ? *time / *request.fps : *time;
    if (!samples.empty() && !(seconds > samples.back().time)) {
      table.fail(r, clock, fmt::format("a time of {:g} s", seconds),
                 "the times of one ball have to ascend",
                 "name the column that tells balls or launches apart: --map series=COLUMN");
    }
    samples.push_back({seconds, *height * (pixels ? pixel : 1.0), table.line(r)});
  }
  return tracks;
}

}  // namespace

ImportedPoints read_track(const ImportRequest& request) {
  ImportTable table(request, {{"series", Dimension::text},
                              {"time", Dimension::time},
                              {"frame", Dimension::count},
                              {"height", Dimension::length},
                              {"pixel", Dimension::count},
                              {"diameter", Dimension::length}});
  table.require_one_of("time", "frame",
                       "name one with --map time=COLUMN:s, or frame=COLUMN and --fps");
  table.require_one_of("height", "pixel", "name one with --map height=COLUMN:m, or pixel=COLUMN");
  if (table.has("frame") && !request.fps) {
    throw InputError({}, "the frames per second are not known", "frames are no times",
                     "give --fps 240");
  }
  if (!request.scale.empty() && !table.has("pixel")) {
    throw InputError({}, "--scale without pixels", "heights have a unit of their own",
                     "leave it out, or name the column with --map pixel=COLUMN");
  }
  std::vector<Track> tracks = read_tracks(table, request);
  const bool scaled = table.has("height") || !request.scale.empty();
  TrackReader upward(request, scaled, table.notes());
  TrackReader downward(request, scaled, table.notes());
  for (Track& track : tracks) {
    upward.read(track);
    for (Sample& sample : track.samples) sample.height = -sample.height;
    downward.read(track);
  }
  if (!(downward.variance() < upward.variance())) return upward.result();
  ImportedPoints points = downward.result();
  if (table.has("height")) points.notes.push_back({ImportRemark::axis_points_down});
  return points;
}

}  // namespace recoil
