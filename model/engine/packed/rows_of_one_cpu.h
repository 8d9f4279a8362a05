// Row by row work, the second half of kernels_of_one_cpu.cpp, which includes it inside its
// namespace: no #pragma once.

// Scalar code follows that compilers vectorise. Selections have the form of minima and maxima, a <
// b ? a : b.

inline float Clamp(float x, float least, float most) {
  const float above = x < least ? least : x;
  return above > most ? most : above;
}

// exp(x) to 2 ulp; x is kept within [-87, 87].
inline float Exp(float x) {
  const float bounded = Clamp(x, -87.0F, 87.0F);
  constexpr float kRounder = 12582912.0F;  // 1.5 * 2^23: adding it rounds to a whole number
  const float rounded = bounded * 1.44269504F + kRounder;
  const float n = rounded - kRounder;
  const float r = (bounded - n * 0.693359375F) + n * 2.12194440e-4F;
  const float series =
      1.0F +
      r * (1.0F +
           r * (0.5F + r * (1.6666665e-1F +
                            r * (4.1665796e-2F +
                                 r * (8.3334519e-3F + r * (1.3981999e-3F + r * 1.9875691e-4F))))));
  return series * __builtin_bit_cast(float, (__builtin_bit_cast(int, rounded) << 23) + (127 << 23));
}

inline float Sigmoid(float x) { return 1.0F / (1.0F + Exp(-x)); }
inline float Tanh(float x) { return 1.0F - 2.0F / (1.0F + Exp(2.0F * x)); }

void Silu(float* __restrict x, long count) {
  for (long i = 0; i < count; ++i) x[i] *= Sigmoid(x[i]);
}

void Lstm(const float* __restrict gates, float* __restrict hidden, float* __restrict cell,
          long width) {
  for (long i = 0; i < width; ++i) {
    const float next =
        Sigmoid(gates[width + i]) * cell[i] + Sigmoid(gates[i]) * Tanh(gates[2 * width + i]);
    cell[i] = next;
    hidden[i] = Sigmoid(gates[3 * width + i]) * Tanh(next);
  }
}

double Coupling(const PackedCoupling& coupling) {
  const float* __restrict ab = coupling.ab;
  float* __restrict high = coupling.high;
  double product = 1;
  for (long i = 0; i < coupling.width; ++i) {
    const float delta =
        coupling.delta_floor +
        (1.0F - coupling.delta_floor) * Sigmoid(ab[coupling.width + i] + coupling.delta_bias);
    high[i] = (high[i] - (1.0F - delta) * ab[i]) / delta;
    product *= delta;
  }
  return product;
}

void Standardise(const float* __restrict x, const float* __restrict mean,
                 const float* __restrict scale, long width, long repeats, float bound,
                 float* __restrict out) {
  for (long repeat = 0; repeat < repeats; ++repeat, x += width, out += width) {
    for (long i = 0; i < width; ++i) out[i] = Clamp((x[i] - mean[i]) * scale[i], -bound, bound);
  }
}

void Bend(const float* __restrict x, const float* __restrict mean, const float* __restrict scale,
          long width, float bound, float* __restrict out) {
  for (long i = 0; i < width; ++i) {
    const float inside = Clamp(x[i], -bound, bound);
    out[i] = (inside + Tanh(x[i] - inside)) * scale[i] + mean[i];
  }
}

// Sums and maxima of a row are computed lane by lane, and at the end over lanes by halves.
inline float SumOfLanes(const Vector& lanes) {
  float part[kLanes];
  __builtin_memcpy(part, &lanes, sizeof part);
#pragma GCC unroll 4
  for (long half = kLanes / 2; half > 0; half /= 2) {
#pragma GCC unroll 8
    for (long i = 0; i < half; ++i) part[i] += part[i + half];
  }
  return part[0];
}

float Sum(const float* x, long count) {
  Vector lanes = {};
  long i = 0;
  for (; i + kLanes <= count; i += kLanes) lanes += *reinterpret_cast<const Vector*>(x + i);
  float sum = SumOfLanes(lanes);
  for (; i < count; ++i) sum += x[i];
  return sum;
}

float SumOfSquares(const float* x, long count) {
  Vector lanes = {};
  long i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    const Vector value = *reinterpret_cast<const Vector*>(x + i);
    lanes += value * value;
  }
  float sum = SumOfLanes(lanes);
  for (; i < count; ++i) sum += x[i] * x[i];
  return sum;
}

float Largest(const float* x, long count) {
  float most[kLanes];
  for (long lane = 0; lane < kLanes; ++lane) most[lane] = x[lane < count ? lane : 0];
  long i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    for (long lane = 0; lane < kLanes; ++lane) {
      most[lane] = most[lane] > x[i + lane] ? most[lane] : x[i + lane];
    }
  }
#pragma GCC unroll 4
  for (long half = kLanes / 2; half > 0; half /= 2) {
#pragma GCC unroll 8
    for (long lane = 0; lane < half; ++lane) {
      most[lane] = most[lane] > most[lane + half] ? most[lane] : most[lane + half];
    }
  }
  float largest = most[0];
  for (; i < count; ++i) largest = largest > x[i] ? largest : x[i];
  return largest;
}

// x = exp(x - by), one register.
inline void ExpLanes(float* x, float by) {
  for (long lane = 0; lane < kLanes; ++lane) x[lane] = Exp(x[lane] - by);
}

void Softmax(float* x, long count) {
  const float largest = Largest(x, count);
  long i = 0;
  for (; i + kLanes <= count; i += kLanes) ExpLanes(x + i, largest);
  if (i < count) {  // one by one, the rest would take as long as everything before it
    float rest[kLanes];
    for (long lane = 0; lane < kLanes; ++lane)
      rest[lane] = i + lane < count ? x[i + lane] : largest;
    ExpLanes(rest, largest);
    for (long lane = 0; i + lane < count; ++lane) x[i + lane] = rest[lane];
  }
  const float scale = 1.0F / Sum(x, count);
  for (long at = 0; at < count; ++at) x[at] *= scale;
}

void LayerNorm(const float* __restrict x, const float* __restrict gain,
               const float* __restrict bias, long width, float* __restrict out) {
  const float mean = Sum(x, width) / static_cast<float>(width);
  for (long i = 0; i < width; ++i) out[i] = x[i] - mean;
  const float variance = SumOfSquares(out, width) / static_cast<float>(width);
  const float scale = 1.0F / __builtin_sqrtf(variance + 1e-5F);
  for (long i = 0; i < width; ++i) out[i] = out[i] * scale * gain[i] + bias[i];
}

// Abramowitz and Stegun 7.1.26: the error function to 1.5e-7.
inline float Erf(float x) {
  const float size = x < 0 ? -x : x;
  const float t = 1.0F / (1.0F + 0.3275911F * size);
  const float series =
      t * (0.254829592F +
           t * (-0.284496736F + t * (1.421413741F + t * (-1.453152027F + t * 1.061405429F))));
  const float erf = 1.0F - series * Exp(-size * size);
  return x < 0 ? -erf : erf;
}

void Gelu(float* __restrict x, long count) {
  for (long i = 0; i < count; ++i) x[i] = 0.5F * x[i] * (1.0F + Erf(0.70710678F * x[i]));
}
