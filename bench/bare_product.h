#pragma once

#include <memory>
#include <vector>

namespace choreo {

/// The limit that an engine is measured against: oneDNN's matrix product over weights of the same
/// shapes, which it packed for itself, on one thread, and nothing else.
class BareProducts {
 public:
  struct Shape {
    int depth, columns;
    int rows = 0;  ///< 0: as many as the others
  };
  /// `bf16`: weights and inputs are of bfloat16, sums of float32.
  BareProducts(const std::vector<Shape>& shapes, int rows, bool bf16);
  ~BareProducts();
  /// All of them once, one after another.
  void Run();
  /// Bytes of the weights, which one Run reads.
  double bytes() const { return bytes_; }
  /// Floating-point operations of one Run.
  double operations() const { return operations_; }

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  double bytes_ = 0, operations_ = 0;
};

}  // namespace choreo
