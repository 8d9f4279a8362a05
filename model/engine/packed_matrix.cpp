#include "model/engine/packed_matrix.h"

#include <sys/mman.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>

namespace choreo {

LargePages::LargePages(size_t count) {
  constexpr size_t kLarge = size_t{2} << 20, kLine = 64;
  const size_t bytes = std::max(count * sizeof(float), size_t{1});
  const size_t unit = bytes >= kLarge ? kLarge : kLine;
  const size_t rounded = (bytes + unit - 1) / unit * unit;
  data_.reset(static_cast<float*>(std::aligned_alloc(unit, rounded)));
  if (!data_) throw std::bad_alloc();
  // Before the first touch, and whether it is heeded or not.
  if (unit == kLarge) madvise(data_.get(), rounded, MADV_HUGEPAGE);
  std::memset(data_.get(), 0, rounded);
}

void LargePages::Free::operator()(float* data) const noexcept { std::free(data); }

PackedLinear::PackedLinear(const PackedKernels& kernels, const RowMajorMatrix& weight,
                           const Eigen::VectorXf& bias)
    : kernels_(&kernels),
      depth_(weight.rows()),
      columns_(weight.cols()),
      panels_((columns_ + kernels.panel - 1) / kernels.panel),
      weight_(static_cast<size_t>(depth_ * padded())),
      bias_(static_cast<size_t>(padded())) {
  std::ranges::copy(bias, bias_.data());
  for (long panel = 0; panel < panels_; ++panel) {
    const long first = panel * kernels.panel, count = std::min(kernels.panel, columns_ - first);
    for (long k = 0; k < depth_; ++k) {
      std::copy_n(weight.data() + k * columns_ + first, count,
                  weight_.data() + (panel * depth_ + k) * kernels.panel);
    }
  }
}

void PackedLinear::Accumulate(const float* x, long x_stride, float* y, long y_stride,
                              long rows) const {
  const Eigen::Map<const Eigen::RowVectorXf> bias(bias_.data(), padded());
  for (long row = 0; row < rows; ++row) {
    Eigen::Map<Eigen::RowVectorXf>(y + row * y_stride, padded()) += bias;
  }
  Add(x, x_stride, y, y_stride, rows);
}

void PackedLinear::Multiply(const float* x, long x_stride, const float* init, long init_stride,
                            float* y, long y_stride, long rows) const {
  kernels_->multiply({.a = x,
                      .a_stride = x_stride,
                      .b = weight_.data(),
                      .depth = depth_,
                      .panels = panels_,
                      .init = init,
                      .init_stride = init_stride,
                      .c = y,
                      .c_stride = y_stride,
                      .rows = rows});
}

}  // namespace choreo
