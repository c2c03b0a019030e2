// Efficiency and purity of the pairing against crowding and number of events, on simulated streams
// of which the truth is known. Prints Markdown.
#include <fmt/format.h>

#include <chrono>
#include <string>

#include "event_stream.hpp"
#include "score.hpp"

namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void line(const stream::Design& design) {
  const stream::Stream events = stream::simulate(design);
  const auto start = std::chrono::steady_clock::now();
  const recoil::EventTable table = stream::read(events);
  const double reading = seconds_since(start);
  const recoil::PairResult result = recoil::pair_events(table.events, {});
  const double all = seconds_since(start);
  const stream::Score score = stream::score(events, table, result);
  fmt::print(
      "| {:g} | {:.4f} | {} | {} | {:.2f} % | {:.2f} % | {:.2f} % | {:.2f} % | {:.2f} +- {:.2f} | "
      "{:.2f} + {:.2f} s |\n",
      design.rate, events.crowding, table.events.size(), score.reported, 100.0 * score.efficiency(),
      100.0 * score.purity(), 100.0 * score.first_purity(), 100.0 * result.purity(),
      result.height * 1e6, result.height_sd * 1e6, reading, all - reading);
  fmt::print(stderr,
             "  returns {} by chance {:.1f} usable {} cand {:.2f} hs {:.4f} ds {:.4f} decoy {:.4f} "
             "missed {:.4f}\n",
             result.returns, result.expected_returns, result.returns_usable, result.candidates,
             result.height_spread, result.diameter_spread, result.decoy_share, result.missed_share);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 4 && std::string(argv[1]) == "events") {
    stream::Design design;
    design.spheres = std::stoul(argv[2]);
    design.rate = std::stod(argv[3]);
    fmt::print("{}", stream::simulate(design).csv);
    return 0;
  }
  for (const double rate : {1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0, 3000.0}) {
    stream::Design design;
    design.rate = rate;
    design.spheres = 20000;
    line(design);
  }
  for (const std::size_t spheres : {50UL, 500UL, 5000UL, 50000UL, 500000UL}) {
    stream::Design design;
    design.spheres = spheres;
    line(design);
  }
}
