#pragma once

#include <utility>

namespace choreo {

/// A request that its model can serve. Constructors of derived types check it; code that takes one
/// need not.
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
