// What `make test` has in place of libFuzzer: the seeds, and what a fixed generator makes of them.
//   fuzz_replay FOLDER MUTATIONS
// The folder has the seeds, and its target's name.
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "tests/fuzz/fuzz.h"
#include "tests/support/sanitizers.h"

namespace choreo::fuzz {
namespace {

constexpr unsigned kHangs = 60;  // seconds for one input: more is a hang
constexpr size_t kMaxBytes = 16'384;
constexpr rlim_t kMemory = 1U << 30U;

using Bytes = std::vector<uint8_t>;

std::vector<Bytes> ReadSeeds(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    paths.push_back(entry.path());
  std::ranges::sort(paths);
  std::vector<Bytes> seeds;
  for (const auto& path : paths) {
    std::ifstream file(path, std::ios::binary);
    seeds.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return seeds;
}

class Mutator {
 public:
  explicit Mutator(const std::vector<Bytes>& seeds) : seeds_(seeds) {}

  Bytes Next() {
    Bytes bytes = Any(seeds_);
    for (size_t changes = 1 + Below(4); changes > 0; --changes) Change(&bytes);
    if (bytes.size() > kMaxBytes) bytes.resize(kMaxBytes);
    return bytes;
  }

 private:
  size_t Below(size_t limit) {
    return std::uniform_int_distribution<size_t>(0, limit - 1)(random_);
  }
  template <typename T>
  const T& Any(const std::vector<T>& list) {
    return list[Below(list.size())];
  }

  void Change(Bytes* bytes) {
    const size_t at = Below(bytes->size() + 1);
    const size_t size = std::min(Below(32) + 1, bytes->size() - at);
    const auto from = bytes->begin() + static_cast<std::ptrdiff_t>(at);
    const auto to = from + static_cast<std::ptrdiff_t>(size);
    switch (Below(6)) {
      case 0:  // a bit
        if (size > 0) *from ^= static_cast<uint8_t>(1U << Below(8));
        break;
      case 1:  // a byte
        if (size > 0) *from = static_cast<uint8_t>(Below(256));
        break;
      case 2:  // a piece is gone
        bytes->erase(from, to);
        break;
      case 3: {  // a piece is there twice
        const Bytes piece(from, to);
        bytes->insert(from, piece.begin(), piece.end());
        break;
      }
      case 4: {  // a piece of another seed
        const Bytes& other = Any(seeds_);
        const size_t start = Below(other.size() + 1);
        const size_t end = std::min(other.size(), start + 1 + Below(256));
        bytes->insert(from, other.begin() + static_cast<std::ptrdiff_t>(start),
                      other.begin() + static_cast<std::ptrdiff_t>(end));
        break;
      }
      default: {  // a number that means trouble, as a text or as bytes
        static const std::vector<std::string> kNumbers = {"-1",
                                                          "0",
                                                          "1e999",
                                                          "4294967295",
                                                          "9223372036854775807",
                                                          "nan",
                                                          "\xff\xff\xff\xff",
                                                          "\x7f",
                                                          "\x80",
                                                          "-0.0",
                                                          "1e-320",
                                                          "{",
                                                          "[",
                                                          "\xc3\x28"};
        const std::string& number = Any(kNumbers);
        bytes->insert(bytes->erase(from, to), number.begin(), number.end());
      }
    }
  }

  const std::vector<Bytes>& seeds_;
  std::mt19937_64 random_{1};
};

void Run(Target target, const Bytes& bytes) {
  alarm(kHangs);  // its signal ends the program
  target(bytes.data(), bytes.size());
}

}  // namespace
}  // namespace choreo::fuzz

int main(int argc, char** argv) {
  using namespace choreo::fuzz;
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s FOLDER MUTATIONS\n", argv[0]);
    return 2;
  }
  // No small input may take much; sanitizers do.
  const rlimit memory{kMemory, kMemory};
  if (!kSanitized) setrlimit(RLIMIT_DATA, &memory);
  const std::filesystem::path folder = argv[1];
  const auto target = Targets().find(folder.filename());
  if (target == Targets().end()) Fail("there is no such target");
  const std::vector<Bytes> seeds = ReadSeeds(folder);
  if (seeds.empty()) Fail("there are no seeds");
  const int mutations = std::stoi(argv[2]);
  for (const Bytes& seed : seeds) Run(target->second, seed);
  Mutator mutator(seeds);
  for (int i = 0; i < mutations; ++i) Run(target->second, mutator.Next());
  std::printf("%zu seeds and %d mutations of them\n", seeds.size(), mutations);
}
