#pragma once

#include <utility>

namespace choreo {

/// A request that its model can serve. The constructor of a derived type checks it, so code that
/// takes one does not check it again.
template <class Request>
class Valid {
 public:
  const Request& operator*() const& { return request_; }
  Request&& operator*() && { return std::move(request_); }
  const Request* operator->() const { return &request_; }

 protected:
  explicit Valid(Request request) : request_(std::move(request)) {}

  Request request_;  // derived types change only what keeps it valid
};

}  // namespace choreo
