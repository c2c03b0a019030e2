#include "experiment/recording.hpp"

#include <fmt/format.h>
#include <sndfile.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>
#include <memory>
#include <numbers>
#include <numeric>
#include <vector>

#include "core/error.hpp"
#include "core/statistics.hpp"

namespace recoil {
namespace {

constexpr sf_count_t most_samples = 30'000'000;
constexpr int most_channels = 8;
constexpr int lowest_rate = 8000;     // [Hz]
constexpr int highest_rate = 192000;  // [Hz]
constexpr std::size_t most_impacts = 500;
constexpr double lowest_pitch = 200.0;  // [Hz]
constexpr double louder = 8.0;          // energy of an impact over that before it

/// RecordedBytes that libsndfile reads as a file.
struct RecordedBytes {
  std::string_view bytes;
  sf_count_t at = 0;

  static RecordedBytes& of(void* self) { return *static_cast<RecordedBytes*>(self); }
  static sf_count_t size(void* self) { return std::ssize(of(self).bytes); }
  static sf_count_t seek(sf_count_t offset, int whence, void* self) {
    RecordedBytes& file = of(self);
    const sf_count_t from = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? file.at : size(self);
    file.at = std::clamp<sf_count_t>(from + offset, 0, size(self));
    return file.at;
  }
  static sf_count_t read(void* to, sf_count_t count, void* self) {
    RecordedBytes& file = of(self);
    const sf_count_t got = std::clamp<sf_count_t>(count, 0, size(self) - file.at);
    std::memcpy(to, file.bytes.data() + file.at, static_cast<std::size_t>(got));
    file.at += got;
    return got;
  }
  static sf_count_t write(const void* /*from*/, sf_count_t /*count*/, void* /*self*/) { return 0; }
  static sf_count_t tell(void* self) { return of(self).at; }
};

struct Sound {
  std::vector<float> samples;
  double rate = 0.0;  ///< [Hz]
};

/// The mean of the channels.
Sound read_sound(const std::string& bytes, const std::string& file) {
  RecordedBytes source{bytes};
  SF_VIRTUAL_IO access{RecordedBytes::size, RecordedBytes::seek, RecordedBytes::read,
                       RecordedBytes::write, RecordedBytes::tell};
  SF_INFO info{};
  const std::unique_ptr<SNDFILE, decltype(&sf_close)> sound(
      sf_open_virtual(&access, SFM_READ, &info, &source), &sf_close);
  if (sound == nullptr) {
    throw InputError({file}, "this recording cannot be read", sf_strerror(nullptr),
                     "save it as WAV, FLAC or Ogg Vorbis");
  }
  if (info.channels < 1 || info.channels > most_channels || info.samplerate < lowest_rate ||
      info.samplerate > highest_rate || info.frames > most_samples) {
    throw InputError({file},
                     fmt::format("a recording of {} samples at {} Hz in {} channels", info.frames,
                                 info.samplerate, info.channels),
                     fmt::format("limits are {} samples, {} to {} Hz and {} channels", most_samples,
                                 lowest_rate, highest_rate, most_channels),
                     "cut it, or convert it to one channel at 48000 Hz");
  }
  constexpr sf_count_t block = 4096;
  const auto channels = static_cast<std::size_t>(info.channels);
  std::vector<float> frames(block * channels);
  Sound heard{{}, static_cast<double>(info.samplerate)};
  sf_count_t got = 0;
  // The header may state fewer samples than there are.
  while (std::ssize(heard.samples) <= most_samples &&
         (got = sf_readf_float(sound.get(), frames.data(), block)) > 0) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(got); ++i) {
      float sum = 0.0F;
      for (std::size_t c = 0; c < channels; ++c) sum += frames[i * channels + c];
      heard.samples.push_back(std::isfinite(sum) ? sum / static_cast<float>(channels) : 0.0F);
    }
  }
  return heard;
}

/// Removes what is below the lowest pitch, without a look ahead: an impact must not be heard before
/// it happens.
void remove_rumble(Sound& sound) {
  const double keep = std::exp(-2.0 * std::numbers::pi * lowest_pitch / sound.rate);
  double before = sound.samples.empty() ? 0.0 : sound.samples.front();
  double out = 0.0;
  for (float& sample : sound.samples) {
    out = keep * (out + sample - before);
    before = sample;
    sample = static_cast<float>(out);
  }
}

/// An instant and its standard deviation [s].
struct Instant {
  double time = 0.0;
  double sd = 0.0;
};

/// @param squares of the samples around the impact; four milliseconds, the impact, four more
/// @param width samples in a millisecond
/// @param quiet variance before the impact
/// @returns in samples from the first
Instant instant_in(const std::vector<double>& squares, std::size_t width, double quiet,
                   double rate) {
  constexpr std::array rises = {5e-5, 2e-4, 4e-4, 8e-4, 1.6e-3, 3.2e-3};  // [s]
  constexpr std::array decays = {2e-3, 5e-3, 2e-2};                       // [s]
  constexpr std::array powers = {0.5, 1.0, 2.0, 4.0, 8.0};                // of the mean power
  const std::ptrdiff_t half = std::ssize(squares) / 2;
  const std::ptrdiff_t count = std::ssize(squares) - half;
  const double power =
      std::accumulate(squares.begin() + half, squares.end(), 0.0) / static_cast<double>(count);
  std::vector<std::vector<double>> shapes;  // of the variance, by samples after the instant
  for (const double rise : rises) {
    for (const double decay : decays) {
      std::vector<double>& shape = shapes.emplace_back(squares.size());
      for (std::size_t i = 0; i < shape.size(); ++i) {
        const double s = static_cast<double>(i) / rate;
        shape[i] = std::pow(1.0 - std::exp(-s / rise), 2) * std::exp(-2.0 * s / decay);
      }
    }
  }
  // Logarithms of the likelihoods, relative to that of noise alone.
  const std::size_t step = std::max<std::size_t>(1, width / 16);
  std::vector<double> at;
  std::vector<double> logs;
  for (std::size_t start = width; start < 5 * width; start += step) {
    for (const std::vector<double>& shape : shapes) {
      for (const double share : powers) {
        double log = 0.0;
        for (std::size_t i = start; i < squares.size(); ++i) {
          const double more = share * power * shape[i - start] / quiet;
          log += 0.5 * squares[i] / quiet * more / (1.0 + more) - 0.5 * std::log1p(more);
        }
        at.push_back(static_cast<double>(start));
        logs.push_back(log);
      }
    }
  }
  const double largest = *std::ranges::max_element(logs);
  double sum = 0.0;
  double first = 0.0;
  double second = 0.0;
  for (std::size_t k = 0; k < logs.size(); ++k) {
    const double weight = std::exp(logs[k] - largest);
    sum += weight;
    first += weight * at[k];
    second += weight * at[k] * at[k];
  }
  const double time = first / sum;
  const double grid = static_cast<double>(step) * static_cast<double>(step) / 12.0;
  return {time, std::sqrt(std::max(second / sum - time * time, 0.0) + grid)};
}

std::vector<Instant> instants_of(const Sound& sound, const std::string& file) {
  const auto width = static_cast<std::size_t>(std::lround(1e-3 * sound.rate));
  const std::size_t blocks = sound.samples.size() / width;
  std::vector<double> energy(blocks);
  const auto squared = [&](std::size_t i) {
    return static_cast<double>(sound.samples[i]) * static_cast<double>(sound.samples[i]);
  };
  for (std::size_t k = 0; k < blocks; ++k) {
    for (std::size_t i = 0; i < width; ++i) energy[k] += squared(k * width + i);
    energy[k] /= static_cast<double>(width);
  }
  constexpr double silence = 1e-12;
  const double usual = std::max(blocks > 0 ? median(energy) : 0.0, silence);
  const auto mean_energy = [&](std::size_t from, std::size_t to) {
    return std::accumulate(energy.begin() + static_cast<std::ptrdiff_t>(from),
                           energy.begin() + static_cast<std::ptrdiff_t>(to), 0.0) /
           static_cast<double>(to - from);
  };
  const auto ratio = [&](std::size_t k) {
    return mean_energy(k, k + 3) / std::max(mean_energy(k - 5, k - 1), usual);
  };
  constexpr std::size_t dead = 40;  // [ms]
  std::vector<Instant> instants;
  for (std::size_t k = 6; k + 8 < blocks;) {
    if (!(ratio(k) > louder)) {
      ++k;
      continue;
    }
    const std::size_t last = std::min(k + 4, blocks - 4);
    for (std::size_t other = k + 1; other < last; ++other) {
      if (ratio(other) > ratio(k)) k = other;
    }
    if (instants.size() == most_impacts) {
      throw InputError({file}, fmt::format("more than {} impacts in one recording", most_impacts),
                       "noise may be taken for impacts", "cut the recording to a few launches");
    }
    std::vector<double> squares;
    for (std::size_t i = (k - 4) * width; i < (k + 5) * width && i < blocks * width; ++i) {
      squares.push_back(squared(i));
    }
    const double quiet = std::max(mean_energy(k - 6, k - 1), silence);
    const Instant own = instant_in(squares, width, quiet, sound.rate);
    instants.push_back(
        {(static_cast<double>((k - 4) * width) + own.time) / sound.rate, own.sd / sound.rate});
    k += dead;
  }
  return instants;
}

}  // namespace

bool is_recording(std::string_view bytes) {
  return (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WAVE")) ||
         bytes.starts_with("fLaC") || bytes.starts_with("OggS");
}

HeardImpacts hear_impacts(const std::string& bytes, const std::string& file) {
  Sound sound = read_sound(bytes, file);
  remove_rumble(sound);
  const std::vector<Instant> instants = instants_of(sound, file);
  if (instants.size() < 3) {
    throw InputError({file}, fmt::format("{} impacts are heard in this recording", instants.size()),
                     "e needs three: it is the ratio of two intervals",
                     "record nearer to the ball, or without other sounds");
  }
  HeardImpacts heard;
  heard.count = instants.size();
  heard.table = "launch,time\n";
  double squares = 0.0;
  int launch = 1;
  for (std::size_t i = 0; i < instants.size(); ++i) {
    if (i > 1 &&
        instants[i].time - instants[i - 1].time > instants[i - 1].time - instants[i - 2].time) {
      ++launch;
    }
    heard.table += fmt::format("{},{:.9f}\n", launch, instants[i].time);
    squares += instants[i].sd * instants[i].sd;
  }
  heard.time_sd = std::sqrt(squares / static_cast<double>(instants.size()));
  return heard;
}

}  // namespace recoil
