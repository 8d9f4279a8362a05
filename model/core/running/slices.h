#pragma once

#include <coroutine>
#include <exception>
#include <optional>
#include <utility>

namespace choreo {

template <typename T>
class Slices;

/// `co_await Pause();` ends a slice.
using Pause = std::suspend_always;

namespace slices {

/// The part of a coroutine's promise that does not depend on its result. Coroutines that await each
/// other form a chain.
struct Promise {
  Promise* outermost = this;          ///< the head of the chain, whose Continue resumes the work
  std::coroutine_handle<> innermost;  ///< set in the outermost: where the work paused
  std::coroutine_handle<> caller;     ///< awaits this one; null for the outermost
  std::exception_ptr failure;

  /// Returns control to the caller.
  struct Return {
    bool await_ready() const noexcept { return false; }
    template <typename P>
    std::coroutine_handle<> await_suspend(std::coroutine_handle<P> done) const noexcept {
      const Promise& promise = done.promise();
      if (!promise.caller) return std::noop_coroutine();
      return promise.outermost->innermost = promise.caller;
    }
    void await_resume() const noexcept {}
  };
  std::suspend_always initial_suspend() const noexcept { return {}; }
  Return final_suspend() const noexcept { return {}; }
  void unhandled_exception() noexcept { failure = std::current_exception(); }
};

template <typename T>
struct ResultPromise : Promise {
  Slices<T> get_return_object();
  void return_value(T made) { result = std::move(made); }
  T Take() { return *std::move(result); }
  std::optional<T> result;
};

template <>
struct ResultPromise<void> : Promise {
  Slices<void> get_return_object();
  void return_void() const noexcept {}
  void Take() const noexcept {}
};

}  // namespace slices

/// Work that pauses between slices, so that its thread can do something more urgent first, or drop
/// the work. A coroutine with this return type pauses with `co_await Pause();`, runs other work to
/// its end with `co_await Other();`, and returns its result with co_return. Its reference arguments
/// must outlive it. Nothing runs before the first slice. Not thread-safe.
template <typename T = void>
class [[nodiscard]] Slices {
 public:
  using promise_type = slices::ResultPromise<T>;

  explicit Slices(std::coroutine_handle<promise_type> work) : work_(work) {
    work_.promise().innermost = work_;
  }
  Slices(Slices&& other) noexcept : work_(std::exchange(other.work_, {})) {}
  Slices& operator=(Slices&&) = delete;
  ~Slices() {
    if (work_) work_.destroy();
  }

  /// Runs the next slice. Returns whether more remain. Throws what the work throws, which ends the
  /// work.
  bool Continue() {
    work_.promise().innermost.resume();
    if (work_.promise().failure) std::rethrow_exception(work_.promise().failure);
    return !work_.done();
  }
  /// Runs all remaining slices and returns the result.
  T Finish() {
    while (Continue()) {
    }
    return Take();
  }
  /// Returns the result. Call once, when no slice remains.
  T Take() { return work_.promise().Take(); }

  /// For co_await: runs all slices and returns the result.
  struct Awaiter {
    std::coroutine_handle<promise_type> work;

    bool await_ready() const noexcept { return false; }
    template <typename P>
    std::coroutine_handle<> await_suspend(std::coroutine_handle<P> caller) const noexcept {
      slices::Promise& promise = work.promise();
      promise.caller = caller;
      promise.outermost = caller.promise().outermost;
      return promise.outermost->innermost = work;
    }
    T await_resume() const {
      if (work.promise().failure) std::rethrow_exception(work.promise().failure);
      return work.promise().Take();
    }
  };
  Awaiter operator co_await() && { return {work_}; }

 private:
  std::coroutine_handle<promise_type> work_;
};

template <typename T>
Slices<T> slices::ResultPromise<T>::get_return_object() {
  return Slices<T>(std::coroutine_handle<ResultPromise>::from_promise(*this));
}
inline Slices<void> slices::ResultPromise<void>::get_return_object() {
  return Slices<void>(std::coroutine_handle<ResultPromise>::from_promise(*this));
}

}  // namespace choreo
