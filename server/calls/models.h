#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "model/engine/sample_queue.h"

namespace choreo {

/// A server's models: the served ones, the default first, and withdrawn ones that calls still use.
/// Thread-safe.
class Models {
 public:
  /// A model in use, kept alive by its holders. Only Models ends a queue; its last holder may run
  /// on the queue's own thread.
  using Use = std::shared_ptr<SampleQueue>;

  /// Current and total figures of all models with one name.
  struct Figures {
    SampleQueue::Stats stats;
    SampleQueue::Histograms histograms;
  };

  /// Throws Error(kInvalidArgument) without models, and for two models of the same name.
  explicit Models(std::vector<std::unique_ptr<SampleQueue>> models);

  /// Serves the models with these names from now on, in this order. Each is one of `fresh` or,
  /// failing that, one already served. Users of other models keep them. Throws
  /// Error(kInvalidArgument), and changes nothing, without names, for a duplicate name, and for a
  /// name without a model.
  void Set(const std::vector<std::string>& names, std::vector<std::unique_ptr<SampleQueue>> fresh);
  /// Ends queues that are neither served nor used. Must not be called on a queue's thread.
  void FreeUnused();

  /// Finds a model by name. An empty name, and "controllers" if no model has that name, means the
  /// first model. Throws Error(kNotFound) that lists the models.
  Use Find(const std::string& name, const std::string& field) const;
  std::vector<Use> served() const;
  /// The figures by model name. Includes withdrawn models while calls use them.
  std::map<std::string, Figures> figures() const;
  /// Transitions running or waiting.
  int transitions() const;

 private:
  struct Entry {
    explicit Entry(std::unique_ptr<SampleQueue> one);
    const std::string& name() const { return queue->model().name; }

    std::unique_ptr<SampleQueue> queue;
    std::shared_ptr<std::atomic<bool>> unused = std::make_shared<std::atomic<bool>>(false);
    Use use;  // null once withdrawn; when the last one is released, `unused` becomes true
  };

  mutable std::mutex mutex_;             // guards the members below
  std::map<std::string, Figures> past_;  // figures of ended queues, without their models
  std::vector<Entry> served_;
  std::vector<Entry> former_;
};

}  // namespace choreo
