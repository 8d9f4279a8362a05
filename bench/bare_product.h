#pragma once

#include <memory>
#include <string_view>
#include <vector>

namespace choreo {

/// The speed limit of an engine: only oneDNN's matrix products with weights of the same shapes,
/// which oneDNN packs itself, on one thread.
class BareProducts {
 public:
  struct Shape {
    int depth, columns;
    int rows = 0;  ///< 0: the default
  };
  /// `bf16`: bfloat16 weights and inputs, float32 sums.
  BareProducts(const std::vector<Shape>& shapes, int rows, bool bf16);
  ~BareProducts();
  /// Runs all products once, one after another.
  void Run();
  /// Bytes of weights read by one Run.
  double bytes() const { return bytes_; }
  /// Floating-point operations of one Run.
  double operations() const { return operations_; }

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  double bytes_ = 0, operations_ = 0;
};

/// Limits later products to the instructions of the packed engine's float32 kernels of this name
/// (PackedKernels::name). Call before the first one.
void LimitBareProducts(std::string_view kernels);

}  // namespace choreo
