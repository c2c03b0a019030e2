#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "document/document.hpp"
#include "experiment/correction_study.hpp"
#include "validation/studies/study_stamp.hpp"

namespace recoil {

/// A mean over several streams with its standard error.
struct StreamMean {
  double mean = 0.0;
  double error = 0.0;
};

/// All corrections, with other random numbers than the recipe's.
struct OtherStreams {
  std::string dataset;
  std::size_t size_classes = 1;
  bool usable = false;  ///< every fit has an answer
  StreamMean error_slow, error_fast, C_H, C_A, capture_velocity;
};

/// The whole chain on the reconstructed experiments: events, pairing, points, fit, beside the truth
/// that the recipe put there, and with each correction left out.
struct EventChain {
  struct Chain {
    std::string dataset;
    CorrectionStudy study;
  };
  StudyStamp stamp;
  std::vector<Chain> chains;
  std::vector<OtherStreams> others;
};

/// Of the two steel reconstructions below `root`.
EventChain study_event_chain(const std::filesystem::path& root);

std::string event_chain_json(const EventChain& chain);
/// @throws InputError when `file` is not the JSON of such a study
EventChain read_event_chain(const std::filesystem::path& file);
Document event_chain_page(const EventChain& chain);

}  // namespace recoil
