#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "core/statistics.hpp"
#include "experiment/import_formats.hpp"

namespace recoil {
namespace {

constexpr std::size_t fewest_samples = 4;  // in a flight

struct Sample {
  double time = 0.0;    ///< [s]
  double height = 0.0;  ///< upward [m] or [pixels]
  std::size_t row = 0;  ///< of the table
};

/// The samples of one ball, by time.
struct Track {
  std::string series;
  std::string launch;
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

/// The smallest step between successive heights that is not zero: a pixel, if heights are whole
/// pixels.
double smallest_step(const std::vector<Sample>& samples) {
  double least = INFINITY;
  for (const double step : differences(samples, 1)) {
    if (step != 0.0) least = std::min(least, std::abs(step));
  }
  return std::isfinite(least) ? least : 0.0;
}

/// The standard deviation of a height from third differences: they vanish for a parabola and have
/// 1 + 9 + 9 + 1 = 20 times the variance of independent errors. For normal errors the median of |x|
/// is 0.6745 standard deviations. It is at least that of rounding to the smallest step.
double noise_of(const std::vector<Sample>& samples) {
  std::vector<double> third = differences(samples, 3);
  for (double& value : third) value = std::abs(value);
  return std::max(median(third) / (0.6745 * std::sqrt(20.0)),
                  smallest_step(samples) / std::sqrt(12.0));
}

/// True if sample i shows the frame before it again: the height stands still between two steps of
/// one direction, each of more than two smallest steps. No fall does that, even in whole pixels.
bool stands_still(const std::vector<Sample>& samples, std::size_t i, double least) {
  if (i < 2 || i + 1 >= samples.size() || samples[i].height != samples[i - 1].height) return false;
  const double before = samples[i - 1].height - samples[i - 2].height;
  const double after = samples[i + 1].height - samples[i].height;
  return before * after > 0.0 && std::min(std::abs(before), std::abs(after)) > 2.0 * least;
}

/// Removes repeated frames of a film that was stored at a higher rate than it was taken. They are
/// in it if at least three moving samples, and one moving sample in fifty, stand still.
/// @returns how many samples were removed
std::size_t drop_repeated_frames(std::vector<Track>& tracks) {
  std::size_t still = 0;
  std::size_t moving = 0;
  for (const Track& track : tracks) {
    const double least = smallest_step(track.samples);
    const std::vector<double> steps = differences(track.samples, 1);
    for (std::size_t i = 1; i < track.samples.size(); ++i) {
      still += stands_still(track.samples, i, least) ? 1 : 0;
      moving += std::abs(steps[i - 1]) > 2.0 * least ? 1 : 0;
    }
  }
  if (still < 3 || 50 * still < moving) return 0;
  std::size_t dropped = 0;
  for (Track& track : tracks) {
    const auto same = [](const Sample& a, const Sample& b) { return a.height == b.height; };
    const auto end = std::unique(track.samples.begin(), track.samples.end(), same);
    dropped += static_cast<std::size_t>(track.samples.end() - end);
    track.samples.erase(end, track.samples.end());
  }
  return dropped;
}

/// Mends the times of a track whose rows count frames: a step twice as long as those before and
/// after it holds a lost frame, and one of no length shows a frame twice.
/// @param frame duration [s]
/// @returns how many frames were lost or shown twice
std::size_t mend_frames(Track& track, double frame) {
  constexpr double clear = 10.0;      // smallest step over the noise
  constexpr double tolerance = 0.25;  // of a step
  constexpr double alike = 0.6;       // of the steps before and after; an impact is in none of them
  const std::vector<double> steps = differences(track.samples, 1);
  const double least = clear * noise_of(track.samples);
  std::vector<Sample> mended;
  double shift = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < track.samples.size(); ++i) {
    bool twice = false;
    const bool inside = i >= 2 && i + 1 < track.samples.size();
    if (inside && steps[i - 2] * steps[i] > 0.0 &&
        std::min(std::abs(steps[i - 2]), std::abs(steps[i])) >
            std::max(least, alike * std::max(std::abs(steps[i - 2]), std::abs(steps[i])))) {
      const double frames = 2.0 * steps[i - 1] / (steps[i - 2] + steps[i]);
      twice = std::abs(frames) < tolerance;
      const bool lost = std::abs(frames - 2.0) < tolerance;
      shift += lost ? frame : twice ? -frame : 0.0;
      count += lost || twice ? 1 : 0;
    }
    if (twice) continue;
    mended.push_back(track.samples[i]);
    mended.back().time += shift;
  }
  track.samples = mended;
  return count;
}

/// True if the heights are measured downward: most of the second differences over a span are
/// positive, since an axis that points up shows mostly free fall. The span is the smallest one at
/// which the difference of the counts exceeds three standard deviations of chance, or, if none
/// does, the one at which it exceeds them most.
bool points_down(const std::vector<Track>& tracks) {
  std::size_t longest = 0;
  for (const Track& track : tracks) longest = std::max(longest, track.samples.size());
  double most = 0.0;
  for (std::size_t span = 1; span == 1 || 8 * span <= longest; span *= 2) {
    double sum = 0.0;
    double count = 0.0;
    for (const Track& track : tracks) {
      const std::vector<Sample>& s = track.samples;
      for (std::size_t i = span; i + span < s.size(); ++i) {
        // Divided differences: frames may be missing.
        const double bend = (s[i + span].height - s[i].height) / (s[i + span].time - s[i].time) -
                            (s[i].height - s[i - span].height) / (s[i].time - s[i - span].time);
        if (bend == 0.0) continue;
        sum += bend > 0.0 ? 1.0 : -1.0;
        count += 1.0;
      }
    }
    if (count == 0.0) continue;
    const double excess = sum / std::sqrt(count);
    if (std::abs(excess) > std::abs(most)) most = excess;
    if (std::abs(most) > 3.0) break;
  }
  return most > 0.0;
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
    const auto top = std::max_element(
        first, last, [](const Sample& a, const Sample& b) { return a.height < b.height; });
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

/// @param drift what air drag adds to the height of every sample; empty: nothing
Parabolas fit_parabolas(const std::vector<Sample>& samples, const std::vector<Arc>& arcs,
                        const std::vector<double>& drift = {}) {
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
      heights(row) = samples[i].height - (drift.empty() ? 0.0 : drift[i]);
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
    arc.fall_sd = std::max(noise, std::sqrt(own.variance)) * std::sqrt(own.covariance(2, 2));
    falls.push_back(arc.fall);
  }
  const double usual = median(falls);
  for (Arc& arc : arcs) {
    const double off = std::abs(arc.fall - usual);
    if (off > 0.3 * std::abs(usual) && off > 4.0 * arc.fall_sd) arc.good = false;
  }
}

/// The motion of a ball relative to the middle of its flight.
struct Motion {
  double height = 0.0;
  double speed = 0.0;  ///< upward

  Motion operator+(const Motion& other) const {
    return {height + other.height, speed + other.speed};
  }
  Motion operator*(double factor) const { return {height * factor, speed * factor}; }
};

/// Flights that fall with a, and with the drag of air if there is any. Lengths are in the unit of
/// the heights.
struct Fall {
  const AirFlight* air = nullptr;
  double a = 0.0;
  double metre = 1.0;

  Motion rate(const Motion& now) const {
    const double drag =
        air == nullptr ? 0.0 : metre * air->deceleration(std::abs(now.speed) / metre);
    return {now.speed, -a - std::copysign(drag, now.speed)};
  }
  /// Moves by `duration`, which may be negative. In air: classical Runge-Kutta steps of at most an
  /// eighth of the time in which drag changes the speed.
  Motion moved(Motion now, double duration) const {
    if (air == nullptr) {
      return {now.height + (now.speed - 0.5 * a * duration) * duration, now.speed - a * duration};
    }
    const double fastest = std::abs(now.speed) + a * std::abs(duration);
    const double change = metre * air->deceleration(fastest / metre) / fastest;
    const double steps = std::ceil(std::min(8.0 * change * std::abs(duration), 1e4)) + 1.0;
    const double dt = duration / steps;
    for (double k = 0.0; k < steps; k += 1.0) {
      const Motion k1 = rate(now);
      const Motion k2 = rate(now + k1 * (0.5 * dt));
      const Motion k3 = rate(now + k2 * (0.5 * dt));
      const Motion k4 = rate(now + k3 * dt);
      now = now + (k1 + k2 * 2.0 + k3 * 2.0 + k4) * (dt / 6.0);
    }
    return now;
  }
};

/// What drag adds to the height of every sample of the good flights of `fit`.
std::vector<double> drift_of(const std::vector<Sample>& samples, const std::vector<Arc>& arcs,
                             const Parabolas& fit, const Fall& fall) {
  std::vector<double> drift(samples.size());
  for (std::size_t k = 0; k < arcs.size(); ++k) {
    const Arc& arc = arcs[k];
    if (!arc.good) continue;
    const double speed = fit.values(fit.first[k] + 1);
    const auto follow = [&](auto first, auto last, const auto& next) {
      Motion now{0.0, speed};
      double time = arc.middle;
      for (auto i = first; i != last; i = next(i)) {
        now = fall.moved(now, samples[i].time - time);
        time = samples[i].time;
        const double t = time - arc.middle;
        drift[i] = now.height - (speed - 0.5 * fall.a * t) * t;
      }
    };
    std::size_t middle = arc.begin;
    while (middle < arc.end && samples[middle].time < arc.middle) ++middle;
    follow(middle, arc.end, [](std::size_t i) { return i + 1; });
    follow(middle - 1, arc.begin - 1, [](std::size_t i) { return i - 1; });
  }
  return drift;
}

/// The intersection of two flights.
struct Meeting {
  double e = 0.0;
  double velocity = 0.0;
  double after = 0.0;  ///< time of the intersection less the time of the minimum [s]
};

/// @param known c_1, b_1, c_2, b_2, a
Meeting meeting_of(const Eigen::Matrix<double, 5, 1>& known, double since_first,
                   double since_second, const Fall& fall) {
  Motion before = fall.moved({known(0), known(1)}, since_first);
  Motion back = fall.moved({known(2), known(3)}, since_second);
  Meeting meeting;
  for (int step = 0; step < 4; ++step) {  // Newton
    const double more = (back.height - before.height) / (before.speed - back.speed);
    before = fall.moved(before, more);
    back = fall.moved(back, more);
    meeting.after += more;
  }
  meeting.velocity = -before.speed;
  meeting.e = back.speed / meeting.velocity;
  return meeting;
}

class TrackReader {
 public:
  TrackReader(const ImportRequest& request, const ImportTable& table, bool scaled, Flights& flights)
      : request_(request),
        table_(table),
        scaled_(scaled),
        flights_(flights),
        out_{{}, table.notes()} {}

  void read(const Track& track) {
    const std::size_t before = out_.points.size();
    read_impacts(track);
    if (out_.points.size() == before) {
      without_.names.push_back(track.launch.empty() ? request_.file.stem().string() : track.launch);
    }
  }

  ImportedPoints result() {
    if (!without_.names.empty()) out_.notes.push_back(without_);
    if (skipped_ > 0) out_.notes.push_back({ImportRemark::impacts_skipped, {}, skipped_});
    ImportNote fall{ImportRemark::track_fall};
    if (!falls_.empty()) fall.fall = median(falls_);
    fall.gravity = request_.gravity;
    if (scaled_ && !falls_.empty() && std::abs(fall.fall / fall.gravity - 1.0) > 0.02)
      out_.notes.push_back(fall);
    flights_.add_notes(out_.notes);
    out_.notes.push_back({ImportRemark::shared_values});
    return out_;
  }

 private:
  void read_impacts(const Track& track) {
    const std::vector<Sample>& samples = track.samples;
    if (samples.size() < 2 * fewest_samples) return;
    const std::vector<std::size_t> impacts = impacts_of(samples);
    std::vector<Arc> arcs = arcs_of(samples, impacts);
    reject_others(samples, arcs);
    if (std::ranges::none_of(arcs, &Arc::good)) return;
    const Parabolas vacuum = fit_parabolas(samples, arcs);
    if (!(fall_of(vacuum, nullptr).a > 0.0)) return;
    const auto air = flights_.in_air(track.series, track.diameter);
    const Parabolas fit = air ? fit_in_air(samples, arcs, vacuum, *air) : vacuum;
    const double a = fall_of(fit, nullptr).a;
    if (a > 0.0) falls_.push_back(a);
    for (std::size_t k = 0; k < impacts.size(); ++k) {
      const bool flies = a > 0.0 && arcs[k].good && arcs[k + 1].good;
      const std::optional<ImportedPoint> point =
          flies ? point_of(track, impacts[k], arcs, k, fit, air ? &*air : nullptr) : std::nullopt;
      if (!point) {
        ++skipped_;
        continue;
      }
      out_.points.push_back(*point);
      if (!air) continue;
      const auto bare = point_of(track, impacts[k], arcs, k, vacuum, nullptr);
      const double e = *point->value[Quantity::restitution];
      flights_.note_drag(table_, samples[impacts[k]].row, table_.has("pixel") ? "pixel" : "height",
                         *air, *point->value[Quantity::incident_velocity], e,
                         bare ? *bare->value[Quantity::restitution] : e);
    }
  }

  /// The fall of a fit. Without a scale, the fall with g tells the length of a metre.
  Fall fall_of(const Parabolas& fit, const AirFlight* air) const {
    const double a = fit.values(fit.values.size() - 1);
    return {air, a, scaled_ ? 1.0 : a / request_.gravity};
  }

  /// Fits parabolas to the heights less what drag adds to them, until that no longer changes.
  /// The coefficients are NaN if it does not come to rest: the air nearly stops such a ball.
  Parabolas fit_in_air(const std::vector<Sample>& samples, const std::vector<Arc>& arcs,
                       const Parabolas& vacuum, const AirFlight& air) const {
    constexpr int most_rounds = 60;
    constexpr double small = 1e-9;
    Parabolas fit = vacuum;
    for (int round = 0; round < most_rounds; ++round) {
      const Eigen::VectorXd before = fit.values;
      fit = fit_parabolas(samples, arcs, drift_of(samples, arcs, fit, fall_of(fit, &air)));
      if (!fit.values.allFinite() || !(fall_of(fit, &air).a > 0.0)) break;
      if ((fit.values - before).norm() < small * before.norm()) return fit;
    }
    fit.values.setConstant(NAN);
    return fit;
  }

  /// nullopt if the flights do not meet near the minimum
  std::optional<ImportedPoint> point_of(const Track& track, std::size_t at,
                                        const std::vector<Arc>& arcs, std::size_t k,
                                        const Parabolas& fit, const AirFlight* air) const {
    const std::vector<Sample>& samples = track.samples;
    const double time = samples[at].time;
    const double since[2] = {time - arcs[k].middle, time - arcs[k + 1].middle};
    const std::array<std::ptrdiff_t, 5> places = {fit.first[k], fit.first[k] + 1, fit.first[k + 1],
                                                  fit.first[k + 1] + 1, fit.values.size() - 1};
    const Eigen::Matrix<double, 5, 1> known = fit.values(places);
    const Eigen::Matrix<double, 5, 5> covariance = fit.variance * fit.covariance(places, places);
    const auto answer = [&](const Eigen::Matrix<double, 5, 1>& values) {
      const double metre = scaled_ ? 1.0 : values(4) / request_.gravity;
      Meeting meeting = meeting_of(values, since[0], since[1], {air, values(4), metre});
      meeting.velocity /= metre;
      return meeting;
    };
    const Meeting best = answer(known);
    const double spacing = samples[at + 1].time - samples[at - 1].time;
    if (!(std::abs(best.after) < spacing) || !(best.velocity > 0.0) || !(best.e > 0.0)) {
      return std::nullopt;
    }
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
    ImportedPoint point = imported_point(track.series, table_.line(samples[at].row), track.diameter,
                                         best.velocity, best.e);
    const double sd_e = std::sqrt(slope_e.dot(covariance * slope_e));
    const double sd_v = std::sqrt(slope_v.dot(covariance * slope_v));
    if (sd_e > 0.0) point.value[Quantity::restitution_sd] = sd_e;
    if (sd_v > 0.0) point.value[Quantity::velocity_sd] = sd_v;
    return point;
  }

  const ImportRequest& request_;
  const ImportTable& table_;
  bool scaled_;
  Flights& flights_;
  std::vector<double> falls_;  ///< a of each ball [m/s2], or pixels/s2
  std::size_t skipped_ = 0;
  ImportNote without_{ImportRemark::tracks_without_impact};
  ImportedPoints out_;
};

std::vector<Track> read_tracks(ImportTable& table, const ImportRequest& request) {
  const bool pixels = table.has("pixel");
  const double pixel = request.scale.empty()
                           ? 1.0
                           : parse_quantity(request.scale, Dimension::length, "m", "--scale");
  std::vector<Track> tracks;
  std::map<std::pair<std::string, std::string>, std::size_t> index;
  std::vector<double> rows;  // of every track, also without a height
  const std::string clock = table.has("time") ? "time" : "frame";
  for (std::size_t r = 0; r < table.size(); ++r) {
    const std::string series = table.name(r, "series");
    const std::string launch = table.text(r, "launch");
    const auto [known, added] = index.try_emplace({series, launch}, tracks.size());
    if (added) {
      tracks.push_back({series, launch, table.value(r, "diameter"), {}});
      rows.push_back(0.0);
    }
    const double number = rows[known->second]++;
    const auto time = table.has(clock) ? table.value(r, clock) : number;
    const auto height = table.value(r, pixels ? "pixel" : "height");
    if (!time || !height) {
      table.leave_out(r);
      continue;
    }
    std::vector<Sample>& samples = tracks[known->second].samples;
    const double seconds = clock == "frame" ? *time / *request.fps : *time;
    if (!samples.empty() && !(seconds > samples.back().time)) {
      table.fail(r, clock, fmt::format("a time of {:g} s", seconds),
                 "the times of one ball have to ascend",
                 "name the column that tells balls or launches apart: --map launch=COLUMN");
    }
    samples.push_back({seconds, *height * (pixels ? pixel : 1.0), r});
  }
  return tracks;
}

}  // namespace

ImportedPoints read_track(const ImportRequest& request, const SphereInAir& sphere) {
  ImportTable table(request, {{"series", Dimension::text},
                              {"launch", Dimension::text},
                              {"time", Dimension::time},
                              {"frame", Dimension::count},
                              {"height", Dimension::length},
                              {"pixel", Dimension::count},
                              {"diameter", Dimension::length}});
  if (!request.fps || table.has("time")) {
    table.require_one_of("time", "frame",
                         "name one with --map time=COLUMN:s, or give --fps: a row is then a frame");
  }
  table.require_one_of("height", "pixel", "name one with --map height=COLUMN:m, or pixel=COLUMN");
  if (table.has("frame") && !request.fps) {
    throw InputError({}, "the frames per second are not known", "frames are no times",
                     "give --fps 240");
  }
  if (table.has("time") && request.fps) {
    throw InputError({}, "--fps, but the table has times", "they would contradict each other",
                     "leave it out, or name a column of frames with --map frame=COLUMN");
  }
  if (!request.scale.empty() && !table.has("pixel")) {
    throw InputError({}, "--scale without pixels", "heights have a unit of their own",
                     "leave it out, or name the column with --map pixel=COLUMN");
  }
  std::vector<Track> tracks = read_tracks(table, request);
  const std::size_t repeated = drop_repeated_frames(tracks);
  std::size_t mended = 0;
  if (!table.has("time") && !table.has("frame")) {
    for (Track& track : tracks) mended += mend_frames(track, 1.0 / *request.fps);
  }
  const bool down = points_down(tracks);
  Flights flights(request, sphere);
  TrackReader reader(request, table, table.has("height") || !request.scale.empty(), flights);
  for (Track& track : tracks) {
    for (Sample& sample : track.samples) {
      if (down) sample.height = -sample.height;
    }
    reader.read(track);
  }
  ImportedPoints points = reader.result();
  if (repeated > 0) points.notes.push_back({ImportRemark::frames_repeated, {}, repeated});
  if (mended > 0) points.notes.push_back({ImportRemark::frames_mended, {}, mended});
  if (down && table.has("height")) points.notes.push_back({ImportRemark::axis_points_down});
  return points;
}

}  // namespace recoil
