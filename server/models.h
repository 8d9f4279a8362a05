#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "model/engine/sample_queue.h"

namespace choreo {

/// A server's models: those that it serves, the first one as the default, and withdrawn ones that
/// calls still dance. Thread-safe.
class Models {
 public:
  /// A model in use, which exists as long as anybody holds one. Only Models ends queues, never the
  /// last holder: that may be one of their own threads.
  using Use = std::shared_ptr<SampleQueue>;

  /// Present and total figures of the models with one name.
  struct Figures {
    SampleQueue::Stats stats;
    SampleQueue::Histograms histograms;
  };

  /// Throws Error(kInvalidArgument) for no models, and for two of one name.
  explicit Models(std::vector<std::unique_ptr<SampleQueue>> models);

  /// Serves these from now on, in this order: those of `fresh`, and present ones whose names are
  /// not among them. Users of other models keep them. Throws Error(kInvalidArgument), and changes
  /// nothing, for no names, a duplicate, and one without a model.
  void Set(const std::vector<std::string>& names, std::vector<std::unique_ptr<SampleQueue>> fresh);
  /// Ends queues that are neither served nor used. Must not run on their threads.
  void FreeUnused();

  /// The first model for an empty name, and for "controllers" if none has that name. Throws
  /// Error(kNotFound) that lists the models.
  Use Find(const std::string& name, const std::string& field) const;
  std::vector<Use> served() const;
  /// The figures by name. Withdrawn models stay until nobody dances them any more.
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
