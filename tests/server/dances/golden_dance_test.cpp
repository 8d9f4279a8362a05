#include <gnu/libc-version.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <iomanip>
#include <map>
#include <sstream>
#include <string>

#include "model/engine/loading.h"
#include "model/engine/packed/kernels.h"
#include "model/samplers/samplers.h"
#include "tests/server/fixture.h"

/// The bits of one short dance of `default`, as clients get it, for every set of kernels that this
/// CPU has. A change that means to change dances, or another checkpoint, replaces the hashes: the
/// failure prints them. Compiler, flags and C library change bits, too (the fingerprint names
/// them), so other builds than that of kBuild are skipped.
namespace choreo::golden_dance_test {

constexpr const char* kBuild = "GNU 12.2.0 Release ";
constexpr const char* kLibrary = "2.36";

const std::map<std::string, std::string> kGolden = {
    {"portable", "17851ddb58b088ae"},
    {"avx2", "b6add94e632712e0"},
    {"avx512", "298cd7efe55ffc75"},
    {"avx512_bf16", "a5f238d03242b323"},
};

/// FNV-1a of the numbers' bytes.
class Hash {
 public:
  void Add(const std::vector<float>& numbers) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(numbers.data());
    for (size_t i = 0; i < numbers.size() * sizeof(float); ++i)
      hash_ = (hash_ ^ bytes[i]) * 0x100000001b3;
  }
  std::string text() const {
    std::ostringstream out;
    out << std::hex << std::setw(16) << std::setfill('0') << hash_;
    return out.str();
  }

 private:
  uint64_t hash_ = 0xcbf29ce484222325;
};

class GoldenDanceTest : public ServerTest {
 protected:
  void Serve(const std::string& kernels) {
    std::vector<Server::Samplers> models(1);
    const Device cpu;
    models[0] = MakeSamplers(SHIPPED_CHECKPOINT, {&cpu, 1}, EngineKind::kAuto, kernels);
    ServerConfig config;
    config.listen = "127.0.0.1:0";
    Connect(std::make_unique<Server>(config, std::move(models)));
  }

  // To a beat every half second, through a key, then on without one.
  std::string Dance() {
    v1::DanceConfig config = Config(7);
    config.set_frames(75);
    for (double beat = 0.5; beat < 2.5; beat += 0.5) config.add_music_beats(beat);
    DanceClient client(stub());
    client.Send(config);
    client.SendKeyframe(Key("a", 40));
    client.SendKeyframesComplete();
    const Answer& answer = client.Finish();
    EXPECT_TRUE(answer.status.ok()) << answer.status.error_message();
    const Answer::Joined dance = answer.Join();
    EXPECT_EQ(dance.count, 75);
    Hash hash;
    for (const auto* numbers : {&dance.root_positions, &dance.rotations, &dance.contacts})
      hash.Add(*numbers);
    return hash.text();
  }
};

TEST_F(GoldenDanceTest, HasTheSameBitsOnAllKernelsOfThisCpu) {
  if (!std::string(BuildIdentity()).starts_with(kBuild) ||
      std::string(gnu_get_libc_version()) != kLibrary)
    GTEST_SKIP() << "the bits are those of " << kBuild << "with glibc " << kLibrary;
  SetTorchThreads(1);
  std::string unknown;
  for (const auto kernels_here : {PackedKernelsHere(), Bf16KernelsHere()}) {
    for (const PackedKernels* kernels : kernels_here) {
      const std::string name = kernels->name;
      Serve(name);
      const std::string hash = Dance();
      const auto golden = kGolden.find(name);
      if (golden == kGolden.end()) {
        unknown += " {\"" + name + "\", \"" + hash + "\"}";
      } else {
        EXPECT_EQ(hash, golden->second) << name;
      }
    }
  }
  if (!unknown.empty()) GTEST_SKIP() << "no golden dance is known of these kernels:" << unknown;
}

}  // namespace choreo::golden_dance_test
