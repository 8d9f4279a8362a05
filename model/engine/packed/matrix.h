#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>

#include "model/core/files/safetensors.h"
#include "model/engine/packed/kernels.h"

namespace choreo {

using RowMajorMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Zeroed memory in the largest pages that the system provides. Small pages slow a large matrix's
/// products by a third.
class LargePages {
 public:
  LargePages() = default;
  explicit LargePages(size_t count);
  float* data() { return data_.get(); }
  const float* data() const { return data_.get(); }

 private:
  struct Free {
    void operator()(float* data) const noexcept { std::free(data); }
  };
  std::unique_ptr<float, Free> data_;
};

/// Rows of floats that reuse their memory and allocate only to grow.
class RowBuffer {
 public:
  /// Resizes. The contents are undefined afterwards.
  void Resize(long rows, long width) {
    stride_ = width;
    if (rows * width <= size_) return;
    size_ = rows * width;
    pages_ = LargePages(static_cast<size_t>(size_));
  }
  long stride() const { return stride_; }
  float* Row(long row) { return pages_.data() + row * stride_; }
  const float* Row(long row) const { return pages_.data() + row * stride_; }
  /// The first `count` floats of a row.
  Eigen::Map<Eigen::RowVectorXf> Head(long row, long count) { return {Row(row), count}; }

 private:
  LargePages pages_;
  long size_ = 0, stride_ = 0;
};

/// A linear map x W + bias in the precision of its kernels, laid out for PackedKernels::multiply.
/// Read-only: engines share it.
class PackedLinear {
 public:
  PackedLinear() = default;
  /// weight [depth, columns], bias [columns].
  PackedLinear(const PackedKernels& kernels, const RowMajorMatrix& weight,
               const Eigen::VectorXf& bias);

  long columns() const { return columns_; }
  /// Columns written: `columns()`, rounded up to whole panels.
  long padded() const { return panels_ == 0 ? 0 : panels_ * kernels_->panel; }
  /// y [rows, >= padded()] = bias + x W
  void Run(const float* x, long x_stride, float* y, long y_stride, long rows) const {
    Multiply(x, x_stride, bias_.data(), 0, y, y_stride, rows);
  }
  void Run(const RowBuffer& x, RowBuffer* y, long rows) const { Run(x, y, 0, rows); }
  /// Rows from `first` to before `end`.
  void Run(const RowBuffer& x, RowBuffer* y, long first, long end) const {
    Run(x.Row(first), x.stride(), y->Row(first), y->stride(), end - first);
  }
  /// y += x W, without the bias
  void Add(const float* x, long x_stride, float* y, long y_stride, long rows) const {
    Multiply(x, x_stride, y, y_stride, y, y_stride, rows);
  }

 private:
  void Multiply(const float* x, long x_stride, const float* init, long init_stride, float* y,
                long y_stride, long rows) const;

  /// The depth in elements of the products: floats or pairs.
  long elements() const { return kernels_->pair != nullptr ? (depth_ + 1) / 2 : depth_; }

  const PackedKernels* kernels_ = nullptr;
  long depth_ = 0, columns_ = 0, panels_ = 0;
  LargePages weight_, bias_;
};

/// A checkpoint's tensors by name, for packing. Throws Error(kInvalidArgument) naming a tensor that
/// is missing or does not fit the configuration.
class PackedTensors {
 public:
  /// `content` must outlive this.
  explicit PackedTensors(const Safetensors& content) : content_(content) {}

  Eigen::Map<const RowMajorMatrix> Get(const std::string& name, long rows, long columns) const {
    return {content_.Get(name, {rows, columns}).data.data(), rows, columns};
  }
  Eigen::Map<const Eigen::VectorXf> Get(const std::string& name, long size) const {
    return {content_.Get(name, {size}).data.data(), size};
  }
  /// LibTorch's linear layer `name`.weight [out, in], `name`.bias.
  PackedLinear Linear(const PackedKernels& kernels, const std::string& name, long in,
                      long out) const {
    return {kernels, Get(name + ".weight", out, in).transpose(), Get(name + ".bias", out)};
  }

 private:
  const Safetensors& content_;
};

/// Whether a row's products have the same bits at every place in batches of several sizes. Tests
/// random rows, in about a millisecond.
bool RowsAreIndependent(const PackedKernels& kernels);

}  // namespace choreo
