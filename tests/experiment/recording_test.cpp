// Recordings of bouncing balls, made from bursts of noise or tones whose loudness, rise, decay,
// echo, background noise and clipping vary: whether e lies within its stated error.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "import_folder.hpp"

namespace {

using import_folder::complaint;
using import_folder::Place;
using recoil::ImportFormat;
using testing::HasSubstr;

/// 16-bit samples as the bytes of a WAV file.
std::string wav(const std::vector<double>& samples, unsigned rate, unsigned channels = 1) {
  const auto little = [](std::uint64_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>((value >> (8 * i)) & 0xFFU);
    return text;
  };
  const std::uint64_t size = 2 * channels * samples.size();
  std::string file = "RIFF" + little(36 + size, 4) + "WAVEfmt " + little(16, 4) + little(1, 2) +
                     little(channels, 2) + little(rate, 4) + little(2ULL * channels * rate, 4) +
                     little(2ULL * channels, 2) + little(16, 2) + "data" + little(size, 4);
  for (const double sample : samples) {
    const auto value = std::lround(32767.0 * std::clamp(sample, -1.0, 1.0));
    for (unsigned c = 0; c < channels; ++c) {
      file += little(static_cast<std::uint64_t>(value) & 0xFFFFU, 2);
    }
  }
  return file;
}

struct Made {
  std::vector<double> samples;
  unsigned rate = 48000;
  double e = 0.0;
  std::size_t impacts = 0;
};

/// A ball in vacuum that falls from 0.3 to 1.2 m, e from 0.6 to 0.93, up to eight impacts.
Made made_recording(unsigned seed, bool tone) {
  std::mt19937_64 random(seed);
  const auto uniform = [&](double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
  };
  std::normal_distribution<double> normal;
  constexpr unsigned rates[] = {8000, 16000, 22050, 44100, 48000};
  Made made;
  made.rate = rates[seed % 5];
  made.e = uniform(0.6, 0.93);
  const double rate = made.rate;
  std::vector<double> times = {uniform(0.3, 0.4)};
  double speed = made.e * std::sqrt(2.0 * 9.80665 * uniform(0.3, 1.2));
  while (times.size() < 8 && 2.0 * speed / 9.80665 > 0.12) {
    times.push_back(times.back() + 2.0 * speed / 9.80665);
    speed *= made.e;
  }
  made.impacts = times.size();
  made.samples.resize(static_cast<std::size_t>((times.back() + 0.4) * rate));
  const double pitch = uniform(600.0, std::min(3500.0, 0.4 * rate));
  const double decay = uniform(0.003, 0.02);
  const double rise = uniform(2e-4, 1.5e-3);
  const double echo = uniform(0.005, 0.03);
  const double echoed = seed % 2 == 0 ? uniform(0.1, 0.4) : 0.0;
  double loud = 1.0;
  for (const double time : times) {
    const double phase = uniform(0.0, 6.2831853);
    for (const auto& [late, share] : {std::pair(0.0, 1.0), std::pair(echo, echoed)}) {
      if (share == 0.0) continue;
      for (auto i = static_cast<std::size_t>(std::ceil((time + late) * rate));
           i < made.samples.size() && static_cast<double>(i) / rate - time < 0.2; ++i) {
        const double s = static_cast<double>(i) / rate - time - late;
        const double carrier = tone ? std::sin(6.2831853 * pitch * s + phase) : normal(random);
        made.samples[i] +=
            loud * share * (1.0 - std::exp(-s / rise)) * std::exp(-s / decay) * carrier;
      }
    }
    loud *= made.e;
  }
  const double noise = std::pow(10.0, -uniform(25.0, 50.0) / 20.0);
  double largest = 0.0;
  for (double& sample : made.samples) {
    sample += noise * normal(random);
    largest = std::max(largest, std::abs(sample));
  }
  const double gain = (seed % 3 == 0 ? 2.5 : 0.9) / largest;  // one in three is clipped
  for (double& sample : made.samples) sample *= gain;
  return made;
}

/// How many restitutions are within 1.96 standard deviations of e in `count` recordings.
struct Score {
  int inside = 0, all = 0, lost = 0;

  double share() const { return static_cast<double>(inside) / all; }
};

Score score(unsigned count, bool tone) {
  Score score;
  const Place place;
  for (unsigned seed = 1; seed <= count; ++seed) {
    const Made made = made_recording(seed, tone);
    auto request = place.request(wav(made.samples, made.rate), ImportFormat::recording);
    request.replace = true;
    const auto points = recoil::import_points(request).dataset.points;
    if (points.size() > made.impacts - 2) ++score.lost;
    for (const auto& point : points) {
      score.inside += std::abs(point.restitution - made.e) < 1.96 * *point.restitution_sd ? 1 : 0;
      ++score.all;
    }
  }
  return score;
}

TEST(Recording, TheStatedErrorsHoldTheTruth) {
  for (const bool tone : {false, true}) {
    const Score found = score(12, tone);
    EXPECT_EQ(found.lost, 0) << "sounds taken for impacts";
    EXPECT_GT(found.all, 40);
    // At least 95 % less three standard deviations of a binomial count of 60.
    EXPECT_GE(found.share(), 0.86) << tone;
  }
}

TEST(Recording, WhatIsRefused) {
  const Made made = made_recording(4, true);
  const std::string whole = wav(made.samples, made.rate);
  const std::string silence = wav(std::vector<double>(20000, 0.0), 8000);
  const Place place;
  const auto problem = [&](const std::string& bytes) {
    return complaint(place.request(bytes, ImportFormat::recording));
  };
  EXPECT_THAT(problem(silence), HasSubstr("0 impacts"));
  EXPECT_THAT(problem("RIFF1234WAVEnothing"), HasSubstr("cannot be read"));
  EXPECT_THAT(problem("t,y\n1,2\n"), HasSubstr("cannot be read"));
  EXPECT_THAT(problem(wav({0.0, 0.1}, 4000)), HasSubstr("at 4000 Hz"));
  EXPECT_THAT(problem(wav(made.samples, made.rate, 9)), HasSubstr("9 channels"));
  EXPECT_THAT(complaint(place.request(whole, ImportFormat::intervals)),
              HasSubstr("--format recording"));
  // Cut anywhere, or with a damaged header: an answer or one line, never a crash.
  for (std::size_t i = 0; i < 60; ++i) {
    std::string damaged = whole.substr(0, i < 20 ? 5 * i : whole.size());
    if (i >= 20) damaged[i - 16] = static_cast<char>(37 * i);
    EXPECT_FALSE(problem(damaged).empty()) << i;
  }
}

}  // namespace
