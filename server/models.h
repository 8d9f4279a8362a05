#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "model/engine/sample_queue.h"

namespace choreo {

/// The models of a server: those that it serves, the first one as the default, and those that it
/// has ceased to serve while calls still dance them. Thread-safe.
class Models {
 public:
  /// A model in somebody's hands: it is there for as long as one has it. Only Models ends
  /// queues, never the last holder: that may be one of their own threads.
  using Use = std::shared_ptr<SampleQueue>;

  /// What the models of one name do now, and have done since the start.
  struct Figures {
    SampleQueue::Stats stats;
    SampleQueue::Histograms histograms;
  };

  /// Throws Error(kInvalidArgument) for none, and for two of one name.
  explicit Models(std::vector<std::unique_ptr<SampleQueue>> models);

  /// Served from now on, in this order: those of `fresh`, and those of today's whose names are not
  /// among them. Who has another one keeps it. Throws Error(kInvalidArgument), and changes nothing,
  /// for no names, a name twice, and one that no model has.
  void Set(const std::vector<std::string>& names, std::vector<std::unique_ptr<SampleQueue>> fresh);
  /// Ends the queues that are not served and that nobody has. From none of their threads.
  void FreeUnused();

  /// The first model for an empty name, and for "controllers" where none is called so. Throws
  /// Error(kNotFound) that lists the models.
  Use Find(const std::string& name, const std::string& field) const;
  std::vector<Use> served() const;
  /// By name. One that has gone is in it until nobody dances it any more.
  std::map<std::string, Figures> figures() const;
  /// Transitions that are being made, or wait.
  int transitions() const;

 private:
  struct Entry {
    explicit Entry(std::unique_ptr<SampleQueue> one);
    const std::string& name() const { return queue->model().name; }

    std::unique_ptr<SampleQueue> queue;
    std::shared_ptr<std::atomic<bool>> unused = std::make_shared<std::atomic<bool>>(false);
    Use use;  // null once it is not served; when the last one goes, `unused` turns true
  };

  mutable std::mutex mutex_;             // guards all below
  std::map<std::string, Figures> past_;  // of queues that have ended, but not their models
  std::vector<Entry> served_;
  std::vector<Entry> former_;
};

}  // namespace choreo
