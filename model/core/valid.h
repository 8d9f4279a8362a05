#pragma once

#include <utility>

namespace choreo {

/// A request that has been checked against its model; code that takes one does not check again.
template <class Asked>
class Valid {
 public:
  /// Throws what Asked::Validate throws.
  Valid(Asked asked, const auto& model) : asked_(std::move(asked)) { asked_.Validate(model); }

  /// Applies a change that keeps it valid, such as of the frame of its poses.
  void Change(const auto& change) { change(asked_); }

  const Asked& operator*() const& { return asked_; }
  Asked&& operator*() && { return std::move(asked_); }
  const Asked* operator->() const { return &asked_; }

 private:
  Asked asked_;
};

}  // namespace choreo
