#include "server/serving.h"

#include <random>

namespace choreo {

uint64_t Serving::FreshSeed() {
  std::random_device device;
  // 53 bits: exact in JSON and in JavaScript.
  return (uint64_t{device()} << 21) ^ device() >> 11;
}

}  // namespace choreo
