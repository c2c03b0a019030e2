#include "core/random.hpp"

#ifdef __EMSCRIPTEN__
#define __aarch64__ 1  // Random123 refuses processors that it does not know
#endif
#include <Random123/philox.h>
#include <Random123/u01fixedpt.h>
#ifdef __EMSCRIPTEN__
#undef __aarch64__
#endif
#include <gsl/gsl_cdf.h>

#include <cassert>

namespace recoil {

RandomStream::RandomStream(std::uint64_t seed, RandomPurpose purpose, std::uint64_t replicate)
    : seed_(seed), purpose_(static_cast<std::uint64_t>(purpose)), replicate_(replicate) {}

std::uint64_t RandomStream::next() {
  if (used_ == 4) {
    const r123::Philox4x64::ctr_type counter = {{block_, replicate_, 0, 0}};
    const r123::Philox4x64::key_type key = {{seed_, purpose_}};
    const r123::Philox4x64::ctr_type numbers = r123::Philox4x64{}(counter, key);
    for (int i = 0; i < 4; ++i) buffer_[i] = numbers[static_cast<std::size_t>(i)];
    ++block_;
    used_ = 0;
  }
  return buffer_[used_++];
}

double RandomStream::uniform() { return u01fixedpt_open_open_64_double(next()); }

double RandomStream::normal() { return gsl_cdf_ugaussian_Pinv(uniform()); }

std::uint64_t RandomStream::below(std::uint64_t n) {
  assert(n > 0);
  // Rejecting the incomplete last cycle keeps every remainder equally likely.
  const std::uint64_t limit = UINT64_MAX - UINT64_MAX % n;
  std::uint64_t draw = next();
  while (draw >= limit) draw = next();
  return draw % n;
}

}  // namespace recoil
