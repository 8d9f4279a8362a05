#pragma once

#include <utility>

namespace choreo {

/// A request that has been checked against its model. Code that takes a Valid does not check it
/// again.
template <class Request>
class Valid {
 public:
  /// Throws what Request::Validate throws.
  Valid(Request request, const auto& model) : request_(std::move(request)) {
    request_.Validate(model);
  }

  /// Applies a change that keeps the request valid, such as moving its poses to another frame of
  /// reference.
  void Change(const auto& change) { change(request_); }

  const Request& operator*() const& { return request_; }
  Request&& operator*() && { return std::move(request_); }
  const Request* operator->() const { return &request_; }

 private:
  Request request_;
};

}  // namespace choreo
