#include "model/audio/signal/resampler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <deque>
#include <map>
#include <mutex>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>

#include "model/audio/signal/format.h"
#include "model/core/error.h"

namespace choreo {
namespace {

/// Zero crossings of the sinc on either side, and the window's shape: 100 dB of attenuation. With
/// this cutoff the stop band begins at the Nyquist frequency (Kaiser's formulas: transition = (100
/// - 8) / (2.285 * length) rad).
constexpr int kZeroCrossings = 64;
constexpr double kKaiserBeta = 10.06;
constexpr double kCutoff = 0.95;  ///< of the lower Nyquist frequency

/// Table steps per zero crossing; linear interpolation between them errs by less than 3e-8.
constexpr int kTableSteps = 4096;

/// Coefficients cached for all phases of a ratio, at most (2 MiB). Ratios with more phases compute
/// each phase when needed.
constexpr int64_t kMaxKeptCoefficients = int64_t{1} << 18;

/// Input samples consumed at a time, so that long pushes need no more memory than short ones.
constexpr size_t kBlock = 512;

double BesselI0(double x) {
  double term = 1, sum = 1;
  for (int k = 1; term > 1e-17 * sum; ++k) {
    term *= (x / (2 * k)) * (x / (2 * k));
    sum += term;
  }
  return sum;
}

/// sinc times window by distance from the centre, in steps of 1 / kTableSteps of a zero crossing; 0
/// at the end. Shared by all resamplers.
const std::vector<double>& PrototypeTable() {
  static const std::vector<double> table = [] {
    std::vector<double> values(kZeroCrossings * kTableSteps + 2, 0.0);
    const double peak = BesselI0(kKaiserBeta);
    for (int i = 0; i <= kZeroCrossings * kTableSteps; ++i) {
      const double t = static_cast<double>(i) / kTableSteps;
      const double u = t / kZeroCrossings;
      const double window = BesselI0(kKaiserBeta * std::sqrt(1 - u * u)) / peak;
      const double angle = std::numbers::pi * t;
      values[static_cast<size_t>(i)] = window * (i == 0 ? 1.0 : std::sin(angle) / angle);
    }
    return values;
  }();
  return table;
}

constexpr size_t kLanes = 16;
constexpr size_t kTogether = 4;  // sums that do not wait for each other

/// The operands of sums of products; all sums have the same first operand if `same`.
struct Products {
  std::array<const double*, kTogether> a, b;
  bool same;
};

/// Sums in a fixed order: same bits at any sample address and vector width.
template <size_t kSums, bool kSame>
[[gnu::always_inline]] inline void SumProducts(const double* const* a, const double* const* b,
                                               size_t size, double* sums) {
  // One register, or several narrower ones.
  typedef double Vector __attribute__((vector_size(64), aligned(8), may_alias));
  constexpr size_t kWide = sizeof(Vector) / sizeof(double);
  static_assert(kLanes == 2 * kWide);
  Vector low[kSums] = {}, high[kSums] = {};
  size_t i = 0;
  for (; i + kLanes <= size; i += kLanes) {
#pragma GCC unroll 4
    for (size_t s = 0; s < kSums; ++s) {
      const double* with = a[kSame ? 0 : s] + i;
      low[s] += *reinterpret_cast<const Vector*>(with) * *reinterpret_cast<const Vector*>(b[s] + i);
      high[s] += *reinterpret_cast<const Vector*>(with + kWide) *
                 *reinterpret_cast<const Vector*>(b[s] + i + kWide);
    }
  }
  if (i < size) {
    for (size_t s = 0; s < kSums; ++s) {
      double lanes[kLanes];
      __builtin_memcpy(lanes, &low[s], sizeof low[s]);
      __builtin_memcpy(lanes + kWide, &high[s], sizeof high[s]);
      for (size_t lane = 0; i + lane < size; ++lane)
        lanes[lane] += a[kSame ? 0 : s][i + lane] * b[s][i + lane];
      __builtin_memcpy(&low[s], lanes, sizeof low[s]);
      __builtin_memcpy(&high[s], lanes + kWide, sizeof high[s]);
    }
  }
#pragma GCC unroll 4
  for (size_t s = 0; s < kSums; ++s) {
    const Vector sum = low[s] + high[s];
    const double at[] = {sum[0] + sum[4], sum[1] + sum[5], sum[2] + sum[6], sum[3] + sum[7]};
    sums[s] = (at[0] + at[2]) + (at[1] + at[3]);
  }
}

/// The first `count` sums.
[[gnu::always_inline]] inline void SumSome(const Products& of, size_t size, size_t count,
                                           double* sums) {
  if (count < kTogether) {
    for (size_t s = 0; s < count; ++s) SumProducts<1, true>(&of.a[s], &of.b[s], size, sums + s);
  } else if (of.same) {
    SumProducts<kTogether, true>(of.a.data(), of.b.data(), size, sums);
  } else {
    SumProducts<kTogether, false>(of.a.data(), of.b.data(), size, sums);
  }
}

void SumBaseline(const Products& of, size_t size, size_t count, double* sums) {
  SumSome(of, size, count, sums);
}
#if defined(__x86_64__)
// Uses no fused multiply-add, which rounds differently (CMakeLists.txt: AVX-512 includes it).
[[gnu::target("avx2")]] void SumAvx2(const Products& of, size_t size, size_t count, double* sums) {
  SumSome(of, size, count, sums);
}
#if defined(__clang__)  // Clang has no preferred width
[[gnu::target("avx512f")]]
#else
[[gnu::target("avx512f,prefer-vector-width=512")]]
#endif
void
SumAvx512(const Products& of, size_t size, size_t count, double* sums) {
  SumSome(of, size, count, sums);
}
#endif

using Sums = void (*)(const Products& of, size_t size, size_t count, double* sums);

Sums FastestSums() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) return SumAvx512;
  if (__builtin_cpu_supports("avx2")) return SumAvx2;
#endif
  return SumBaseline;
}

const Sums kSum = FastestSums();

}  // namespace

/// The filter for one ratio of rates, by phase.
class PolyphaseKernel {
 public:
  PolyphaseKernel(int64_t in_per_period, int64_t phases) : phases_(phases) {
    const double ratio = static_cast<double>(phases) / static_cast<double>(in_per_period);
    cutoff_ = kCutoff * std::min(1.0, ratio);
    half_length_ = 2 * static_cast<int64_t>(std::ceil(kZeroCrossings / cutoff_ / 2));
    if (phases * taps() <= kMaxKeptCoefficients) {
      kept_.resize(static_cast<size_t>(phases * taps()));
      for (int64_t phase = 0; phase < phases; ++phase) {
        Compute(phase, kept_.data() + phase * taps());
      }
    }
  }

  /// Streams with the same ratio share a filter, which may take a third of a MiB. The filters of
  /// the last few ratios are kept for the next stream.
  static std::shared_ptr<const PolyphaseKernel> Shared(int64_t in_per_period, int64_t phases) {
    static std::mutex mutex;
    static std::map<std::pair<int64_t, int64_t>, std::weak_ptr<const PolyphaseKernel>> filters;
    constexpr size_t kKept = 4;
    static std::deque<std::shared_ptr<const PolyphaseKernel>> kept;  // latest first
    const std::lock_guard lock(mutex);
    std::erase_if(filters, [](const auto& filter) { return filter.second.expired(); });
    std::weak_ptr<const PolyphaseKernel>& known = filters[{in_per_period, phases}];
    std::shared_ptr<const PolyphaseKernel> filter = known.lock();
    if (!filter) known = filter = std::make_shared<PolyphaseKernel>(in_per_period, phases);
    std::erase(kept, filter);
    kept.push_front(filter);
    if (kept.size() > kKept) kept.pop_back();
    return filter;
  }

  int64_t half_length() const { return half_length_; }
  int64_t taps() const { return 2 * half_length_; }
  bool keeps_phases() const { return !kept_.empty(); }

  /// The taps of one phase; `scratch` holds them if they are not cached.
  const double* Phase(int64_t phase, std::vector<double>& scratch) const {
    if (!kept_.empty()) return kept_.data() + phase * taps();
    scratch.resize(static_cast<size_t>(taps()));
    Compute(phase, scratch.data());
    return scratch.data();
  }

 private:
  /// Scaled to sum 1, so that every phase passes a constant unchanged.
  void Compute(int64_t phase, double* out) const {
    const double* table = PrototypeTable().data();
    const double step = cutoff_ * kTableSteps;
    const double offset = static_cast<double>(phase) / static_cast<double>(phases_);
    double sum = 0;
    for (int64_t k = 0; k < taps(); ++k) {
      const double distance = std::abs(offset + static_cast<double>(half_length_ - 1 - k));
      const double at = std::min(step * distance, kZeroCrossings * double{kTableSteps});
      const int index = static_cast<int>(at);
      out[k] = table[index] + (at - index) * (table[index + 1] - table[index]);
      sum += out[k];
    }
    const double scale = 1 / sum;
    for (int64_t k = 0; k < taps(); ++k) out[k] *= scale;
  }

  int64_t phases_;
  double cutoff_ = 0;  // relative to the input's Nyquist frequency
  int64_t half_length_ = 0;
  std::vector<double> kept_;
};

Resampler::Resampler(double sample_rate, int channels, int64_t first_sample)
    : channels_(channels), input_start_(first_sample) {
  CheckAudioFormat(sample_rate, channels);
  const int64_t rate = static_cast<int64_t>(sample_rate);
  if (first_sample < 0 || first_sample > kMaxAudioSeconds * rate) {
    throw InvalidArgument("first_sample", std::to_string(first_sample) + " is not within 0 to " +
                                              std::to_string(kMaxAudioSeconds * rate) +
                                              ", which is " + std::to_string(kMaxAudioSeconds) +
                                              " s");
  }
  if (rate == kModelSampleRate) {
    first_output_ = first_sample;
  } else {
    const int64_t divisor = std::gcd(rate, int64_t{kModelSampleRate});
    in_per_period_ = rate / divisor;
    out_per_period_ = kModelSampleRate / divisor;
    kernel_ = PolyphaseKernel::Shared(in_per_period_, out_per_period_);
    const int64_t before =
        kernel_->half_length() - 1;  // samples that output 0 needs before sample 0
    input_.reserve(static_cast<size_t>(kernel_->taps()) + kBlock);
    if (first_sample == 0) {
      input_.assign(static_cast<size_t>(before), 0.0);
      input_start_ = -before;
    } else {
      // The least n with floor(n * in / out) - before >= first_sample.
      const int64_t position = (first_sample + before) * out_per_period_;
      first_output_ = (position + in_per_period_ - 1) / in_per_period_;
    }
  }
  next_output_ = first_output_;
}

int64_t Resampler::half_length() const { return kernel_ ? kernel_->half_length() : 0; }

int64_t Resampler::latency() const {
  return (half_length() * out_per_period_ + in_per_period_ - 1) / in_per_period_;
}

void Resampler::Push(std::span<const float> interleaved) {
  const size_t channels = static_cast<size_t>(channels_);
  while (!interleaved.empty()) {
    const size_t frames = std::min(kBlock, interleaved.size() / channels);
    for (size_t frame = 0; frame < frames; ++frame) {
      double sum = 0;
      for (size_t c = 0; c < channels; ++c) sum += interleaved[frame * channels + c];
      input_.push_back(sum / static_cast<double>(channels));
    }
    interleaved = interleaved.subspan(frames * channels);
    Produce();
  }
}

void Resampler::Finish() {
  const int64_t end = input_start_ + static_cast<int64_t>(input_.size());
  input_.insert(input_.end(), static_cast<size_t>(half_length()), 0.0);
  Produce();
  const int64_t outputs = (end * out_per_period_ + in_per_period_ - 1) / in_per_period_;
  const int64_t beyond = std::min(next_output_ - outputs, static_cast<int64_t>(ready_.size()));
  if (beyond > 0) ready_.resize(ready_.size() - static_cast<size_t>(beyond));
}

void Resampler::Produce() {
  if (!kernel_) {
    for (const double sample : input_) ready_.push_back(static_cast<float>(sample));
    input_start_ += static_cast<int64_t>(input_.size());
    next_output_ = input_start_;
    input_.clear();
    return;
  }
  const int64_t end = input_start_ + static_cast<int64_t>(input_.size());
  const int64_t taps = kernel_->taps();
  const auto first_input = [&](int64_t output) {
    return output * in_per_period_ / out_per_period_ - kernel_->half_length() + 1;
  };
  std::vector<double> scratch;
  const size_t most = kernel_->keeps_phases() ? kTogether : 1;
  int64_t first = 0;
  for (;;) {
    Products products;
    products.same = out_per_period_ == 1;
    size_t count = 0;
    for (; first = first_input(next_output_), count < most && first + taps <= end; ++count) {
      const int64_t phase = next_output_++ * in_per_period_ % out_per_period_;
      products.a[count] = kernel_->Phase(phase, scratch);
      products.b[count] = input_.data() + (first - input_start_);
    }
    if (count == 0) break;
    std::array<double, kTogether> sums;
    kSum(products, static_cast<size_t>(taps), count, sums.data());
    for (size_t i = 0; i < count; ++i) ready_.push_back(static_cast<float>(sums[i]));
  }
  const int64_t done = std::min(first, end) - input_start_;
  if (done > 0) {
    input_.erase(input_.begin(), input_.begin() + done);
    input_start_ += done;
  }
}

void Resampler::Pull(std::vector<float>& mono) {
  mono.insert(mono.end(), ready_.begin(), ready_.end());
  ready_.clear();
}

}  // namespace choreo
