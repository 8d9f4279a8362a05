#pragma once

#include <string>
#include <utility>

#include "model/core/error.h"

namespace choreo {

/// An error about one key.
class KeyError : public Error {
 public:
  KeyError(const Error& error, std::string key_id) : Error(error), key_id_(std::move(key_id)) {}
  const std::string& key_id() const { return key_id_; }

 private:
  std::string key_id_;
};

}  // namespace choreo
