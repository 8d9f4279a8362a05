#include "model/audio/decode/decode.h"
#include "tests/fuzz/fuzz.h"

FUZZ_TARGET(audio) {
  using namespace choreo;
  struct Enough {};
  int pieces = 0;
  try {
    fuzz::MayRefuse([&] {
      DecodeMono(std::as_bytes(std::span(data, size)), [&] {
        if (++pieces > 2) throw Enough();
      });
    });
  } catch (const Enough&) {
  }
  return 0;
}
