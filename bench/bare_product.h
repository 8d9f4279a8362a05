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
  };
  BareProducts(const std::vector<Shape>& shapes, int rows);
  ~BareProducts();
  /// All of them once, one after another.
  void Run();
  /// Bytes of the weights, which one Run reads.
  double bytes() const { return bytes_; }

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  double bytes_ = 0;
};

}  // namespace choreo
