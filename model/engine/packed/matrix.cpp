#include "model/engine/packed/matrix.h"

#include <sys/mman.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>
#include <vector>

#include "model/core/numbers/random.h"

namespace choreo {

LargePages::LargePages(size_t count) {
  constexpr size_t kLarge = size_t{2} << 20, kLine = 64;
  const size_t bytes = std::max(count * sizeof(float), size_t{1});
  const size_t unit = bytes >= kLarge ? kLarge : kLine;
  const size_t rounded = (bytes + unit - 1) / unit * unit;
  data_.reset(static_cast<float*>(std::aligned_alloc(unit, rounded)));
  if (!data_) throw std::bad_alloc();
  // Before the first touch; the kernel may ignore it.
  if (unit == kLarge) madvise(data_.get(), rounded, MADV_HUGEPAGE);
  std::memset(data_.get(), 0, rounded);
}

PackedLinear::PackedLinear(const PackedKernels& kernels, const RowMajorMatrix& weight,
                           const Eigen::VectorXf& bias)
    : kernels_(&kernels),
      depth_(weight.rows()),
      columns_(weight.cols()),
      panels_((columns_ + kernels.panel - 1) / kernels.panel),
      weight_(static_cast<size_t>(elements() * padded())),
      bias_(static_cast<size_t>(padded())) {
  std::ranges::copy(bias, bias_.data());
  const bool pairs = kernels.pair != nullptr;
  std::vector<float> both(static_cast<size_t>(2 * kernels.panel));
  for (long panel = 0; panel < panels_; ++panel) {
    const long first = panel * kernels.panel, count = std::min(kernels.panel, columns_ - first);
    for (long k = 0; k < elements(); ++k) {
      float* out = weight_.data() + (panel * elements() + k) * kernels.panel;
      if (!pairs) {
        std::copy_n(weight.data() + k * columns_ + first, count, out);
        continue;
      }
      for (long i = 0; i < count; ++i) {
        both[static_cast<size_t>(2 * i)] = weight(2 * k, first + i);
        both[static_cast<size_t>(2 * i + 1)] =
            2 * k + 1 < depth_ ? weight(2 * k + 1, first + i) : 0;
      }
      kernels.pair(both.data(), 2 * count, out);
    }
  }
}

void PackedLinear::Multiply(const float* x, long x_stride, const float* init, long init_stride,
                            float* y, long y_stride, long rows) const {
  if (kernels_->pair != nullptr) {
    thread_local RowBuffer pairs;  // keeps its memory
    pairs.Resize(rows, elements());
    for (long row = 0; row < rows; ++row)
      kernels_->pair(x + row * x_stride, depth_, pairs.Row(row));
    x = pairs.Row(0);
    x_stride = pairs.stride();
  }
  kernels_->multiply({.a = x,
                      .a_stride = x_stride,
                      .b = weight_.data(),
                      .depth = elements(),
                      .panels = panels_,
                      .init = init,
                      .init_stride = init_stride,
                      .c = y,
                      .c_stride = y_stride,
                      .rows = rows});
}

bool RowsAreIndependent(const PackedKernels& kernels) {
  constexpr long kRows = 40, kDepth = 67, kPanels = 7;
  const long columns = kPanels * kernels.panel;
  Random random(1);
  const auto draw = [&](auto&& values) {
    for (float& value : values.reshaped()) value = static_cast<float>(random.Normal());
  };
  RowMajorMatrix x(kRows, kDepth), weight(kDepth, columns);
  Eigen::VectorXf bias(columns);
  draw(x);
  draw(weight);
  draw(bias);
  const PackedLinear linear(kernels, weight, bias);
  RowMajorMatrix alone(kRows, columns), together(kRows, columns);
  const auto run = [&](long first, long rows, RowMajorMatrix* y) {
    linear.Run(x.row(first).data(), kDepth, y->row(first).data(), columns, rows);
  };
  for (long row = 0; row < kRows; ++row) run(row, 1, &alone);
  for (long rows = 2; rows <= kRows; ++rows) {
    for (const long first : {0L, kRows - rows}) {
      together.setZero();
      run(first, rows, &together);
      if (together.middleRows(first, rows) != alone.middleRows(first, rows)) return false;
    }
  }
  return true;
}

}  // namespace choreo
