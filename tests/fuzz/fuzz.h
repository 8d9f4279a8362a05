#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "model/core/error.h"

/// What every target of this folder needs. A target is one function over bytes that somebody else
/// made up, `data` and `size`: FUZZ_TARGET(npy) { ... return 0; }. libFuzzer calls it (preset
/// `fuzz`, a program each), or replay.cpp does, in `make test`, all in one program.
#ifdef CHOREO_FUZZ
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);
#define FUZZ_TARGET(name) int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
#else
#define FUZZ_TARGET(name)                                           \
  static int name##_target(const uint8_t* data, size_t size);       \
  [[maybe_unused]] static const bool name##_is_known =              \
      choreo::fuzz::Targets().emplace(#name, name##_target).second; \
  static int name##_target(const uint8_t* data, size_t size)
#endif

namespace choreo::fuzz {

using Target = int (*)(const uint8_t* data, size_t size);

/// This program's targets by name.
inline std::map<std::string, Target>& Targets() {
  static std::map<std::string, Target> targets;
  return targets;
}

inline std::string_view Text(const uint8_t* data, size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Ends the program, as a crash does.
[[noreturn]] inline void Fail(const char* why) {
  std::fprintf(stderr, "fuzz: %s\n", why);
  std::abort();
}

/// Reads something bad. A refusal that blames the input is what should come of it; another one, or
/// another exception, ends the program.
template <typename Read>
void MayRefuse(Read&& read) {
  try {
    read();
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kInternal) Fail(error.what());
  }
}

/// Bytes taken for decisions, one after the other; zeros where they have run out. Not thread-safe.
class Decisions {
 public:
  Decisions(const uint8_t* data, size_t size) : left_(data, size) {}

  bool over() const { return left_.empty(); }
  uint8_t Byte() { return over() ? uint8_t{0} : Take(1)[0]; }
  int Below(int limit) { return (Byte() | Byte() << 8) % limit; }
  std::span<const uint8_t> Take(size_t size) {
    const auto taken = left_.first(size < left_.size() ? size : left_.size());
    left_ = left_.subspan(taken.size());
    return taken;
  }

 private:
  std::span<const uint8_t> left_;
};

}  // namespace choreo::fuzz
