#include "export/lookup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/numerics.hpp"
#include "estimate/capture_velocity.hpp"
#include "export/export_job.hpp"

namespace recoil {
namespace {

constexpr std::size_t first_nodes = 33;
constexpr std::size_t most_nodes = 513;
constexpr std::size_t first_sizes = 3;
constexpr std::size_t most_sizes = 17;

/// The lower neighbour of `at` among ascending values, and the fraction of the distance to the next
/// one, both clamped.
std::pair<std::size_t, double> between(const std::vector<double>& values, double at) {
  if (values.size() == 1 || at <= values.front()) return {0, 0.0};
  if (at >= values.back()) return {values.size() - 2, 1.0};
  const auto above = std::ranges::upper_bound(values, at);
  const auto i = static_cast<std::size_t>(above - values.begin()) - 1;
  return {i, (at - values[i]) / (values[i + 1] - values[i])};
}

struct Question {
  const ImpactModel& model;
  std::vector<double> theta;
  const LookupRequest& request;
};

/// V* of every size; empty if one is not captured.
std::vector<double> captures(const Question& q, const std::vector<double>& sizes) {
  if (without_adhesion(q.model, q.request.dataset)) return {};
  std::vector<CaptureQuery> queries;
  for (const double d : sizes) queries.push_back({q.request.dataset, d});
  std::vector<double> found;
  for (const CaptureVelocity& capture : capture_velocities(q.model, q.theta, queries)) {
    if (!capture.found || !(capture.value > 0.0)) return {};
    found.push_back(capture.value);
  }
  return found;
}

std::vector<double> spaced_sizes(const LookupRequest& request, std::size_t count) {
  const double first = request.sizes.front();
  const double last = request.sizes.back();
  return last > first ? log_spaced(first, last, count) : std::vector<double>{first};
}

RestitutionLookup with_nodes(const Question& q, std::size_t nodes, std::size_t size_count) {
  RestitutionLookup out;
  out.diameter = spaced_sizes(q.request, size_count);
  out.scale = captures(q, out.diameter);
  out.captures = !out.scale.empty();
  if (!out.captures) out.scale.assign(out.diameter.size(), 1.0);
  out.slowest = q.request.slowest;
  out.fastest = q.request.fastest;
  const double least = *std::ranges::min_element(out.scale);
  const double first = out.captures ? 1.0 : out.slowest;
  const double last = std::max(out.fastest / least, 1.01 * first);
  for (std::size_t k = 0; k < nodes; ++k) {  // densest near capture
    const double part = static_cast<double>(k) / static_cast<double>(nodes - 1);
    out.multiple.push_back(first * std::pow(last / first, part * part));
  }
  for (std::size_t i = 0; i < out.diameter.size(); ++i) {
    std::vector<double> velocity;
    for (const double x : out.multiple) velocity.push_back(x * out.scale[i]);
    std::vector<double> row =
        squares_of_nature(q.model, q.theta, q.request.dataset, out.diameter[i], velocity);
    for (double& square : row) square = std::max(square, 0.0);
    if (out.captures) row.front() = 0.0;
    out.square.push_back(std::move(row));
  }
  return out;
}

/// Computes the errors half way between the nodes in V and d.
void measure(const Question& q, RestitutionLookup& lookup) {
  std::vector<double> sizes = lookup.diameter;
  for (std::size_t i = 0; i + 1 < lookup.diameter.size(); ++i) {
    sizes.push_back(std::sqrt(lookup.diameter[i] * lookup.diameter[i + 1]));
  }
  const std::vector<double> scale = lookup.captures ? captures(q, sizes) : std::vector<double>();
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    std::vector<double> velocity;
    const double unit = scale.empty() ? 1.0 : scale[i];
    for (std::size_t k = 0; k + 1 < lookup.multiple.size(); ++k) {
      const double v = 0.5 * unit * (lookup.multiple[k] + lookup.multiple[k + 1]);
      const bool clear = !lookup.captures || v >= clear_of_capture * unit;
      if (clear && v >= lookup.slowest && v <= lookup.fastest) velocity.push_back(v);
    }
    const std::vector<double> squares =
        squares_of_nature(q.model, q.theta, q.request.dataset, sizes[i], velocity);
    for (std::size_t k = 0; k < velocity.size(); ++k) {
      const double e = std::sqrt(std::max(squares[k], 0.0));
      const double found = lookup.restitution(sizes[i], velocity[k]);
      lookup.error = std::max(lookup.error, std::abs(found - e));
    }
    if (scale.empty() || i < lookup.diameter.size()) continue;
    const std::size_t below = i - lookup.diameter.size();
    const double taken = std::sqrt(lookup.scale[below] * lookup.scale[below + 1]);
    lookup.capture_error = std::max(lookup.capture_error, std::abs(taken / scale[i] - 1.0));
  }
}

std::string array_of(const std::vector<double>& values) {
  return fmt::format("{}", fmt::join(values, ", "));
}

constexpr const char* c_text = R"(/* e^2 at x = V / scale for every diameter; 0: the sphere stays */
#define RECOIL_SIZES @SIZES@
#define RECOIL_NODES @NODES@
static const double recoil_diameter[RECOIL_SIZES] = { @DIAMETER@ }; /* [m] */
static const double recoil_scale[RECOIL_SIZES] = { @SCALE@ }; /* @SCALE_IS@ [m/s] */
static const double recoil_multiple[RECOIL_NODES] = { @MULTIPLE@ };
static const double recoil_square[RECOIL_SIZES][RECOIL_NODES] = {
@SQUARE@
};

/* The lower neighbour of x among n ascending values, and the part of the way to the next. */
static int recoil_between(const double *values, int n, double x, double *part)
{
  int low = 0, high = n - 1;
  *part = 0.0;
  if (n == 1 || x <= values[0]) return 0;
  if (x >= values[n - 1]) { *part = 1.0; return n - 2; }
  while (high - low > 1) {
    int middle = (low + high) / 2;
    if (values[middle] <= x) low = middle; else high = middle;
  }
  *part = (x - values[low]) / (values[high] - values[low]);
  return low;
}

/* e [1] of a sphere of diameter [m] at the normal velocity [m/s]; 0: it stays. Beyond the sizes and
   velocities of the table the value at its end holds. */
static double recoil_restitution(double diameter, double velocity)
{
  double part_d = 0.0, part_x = 0.0, log_scale, square = 0.0;
  int i = 0, j, k;
  if (RECOIL_SIZES > 1) {
    i = recoil_between(recoil_diameter, RECOIL_SIZES, diameter, &part_d);
    if (part_d > 0.0 && part_d < 1.0)
      part_d = log(diameter / recoil_diameter[i]) / log(recoil_diameter[i + 1] / recoil_diameter[i]);
  }
  j = RECOIL_SIZES > 1 ? i + 1 : i;
  log_scale = (1.0 - part_d) * log(recoil_scale[i]) + part_d * log(recoil_scale[j]);
  velocity /= exp(log_scale);
  if (@CAPTURES@ && velocity <= 1.0) return 0.0;
  k = recoil_between(recoil_multiple, RECOIL_NODES, velocity, &part_x);
  square = (1.0 - part_d) * ((1.0 - part_x) * recoil_square[i][k] + part_x * recoil_square[i][k + 1])
         + part_d * ((1.0 - part_x) * recoil_square[j][k] + part_x * recoil_square[j][k + 1]);
  return square > 0.0 ? sqrt(square) : 0.0;
}
)";

}  // namespace

double RestitutionLookup::restitution(double diameter_at, double velocity) const {
  auto [i, part] = between(diameter, diameter_at);
  const std::size_t j = diameter.size() > 1 ? i + 1 : i;
  if (part > 0.0 && part < 1.0) {
    part = std::log(diameter_at / diameter[i]) / std::log(diameter[j] / diameter[i]);
  }
  const double x =
      velocity / std::exp((1.0 - part) * std::log(scale[i]) + part * std::log(scale[j]));
  if (captures && x <= 1.0) return 0.0;
  const auto [k, along] = between(multiple, x);
  const double low = (1.0 - along) * square[i][k] + along * square[i][k + 1];
  const double high = (1.0 - along) * square[j][k] + along * square[j][k + 1];
  return std::sqrt(std::max((1.0 - part) * low + part * high, 0.0));
}

RestitutionLookup restitution_lookup(const ImpactModel& model, std::span<const double> theta,
                                     const LookupRequest& request) {
  const Question q = {model, of_nature(model, {theta.begin(), theta.end()}), request};
  std::size_t nodes = first_nodes;
  std::size_t sizes = first_sizes;
  for (;;) {
    RestitutionLookup lookup = with_nodes(q, nodes, sizes);
    measure(q, lookup);
    if (lookup.error <= lookup_error || (nodes >= most_nodes && sizes >= most_sizes)) return lookup;
    nodes = std::min(2 * nodes - 1, most_nodes);
    sizes = std::min(2 * sizes - 1, most_sizes);
  }
}

std::string lookup_in_c(const RestitutionLookup& lookup) {
  std::vector<std::string> rows;
  for (const std::vector<double>& row : lookup.square) {
    rows.push_back("  { " + array_of(row) + " }");
  }
  return filled(c_text, {{"SIZES", fmt::format("{}", lookup.diameter.size())},
                         {"NODES", fmt::format("{}", lookup.multiple.size())},
                         {"DIAMETER", array_of(lookup.diameter)},
                         {"SCALE", array_of(lookup.scale)},
                         {"SCALE_IS", lookup.captures ? "V*, below which a sphere stays" : "unit"},
                         {"MULTIPLE", array_of(lookup.multiple)},
                         {"SQUARE", fmt::format("{}", fmt::join(rows, ",\n"))},
                         {"CAPTURES", lookup.captures ? "1" : "0"}});
}

}  // namespace recoil
