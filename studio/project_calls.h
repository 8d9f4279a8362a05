#pragma once

#include <atomic>
#include <boost/asio/thread_pool.hpp>
#include <functional>
#include <string>

#include "studio/studio_context.h"

namespace choreo::studio {

/// What other programs ask over plain HTTP, in JSON (docs/programs.md): GET /model is the model,
/// POST /dance a project (client/cli/project_file.h) in and its dance out, /dance?as=bvh as a BVH
/// file. Metres, axis-angle. A project's song comes with it, `song_data` in base64; without one the
/// dance is silent, `seconds` long. What cannot be answered is {"error": "..."}, which names field,
/// value and limit.
class ProjectCalls {
 public:
  struct Reply {
    unsigned status = 200;
    std::string type = "application/json";
    std::string body = {};
  };
  using Answer = std::function<void(Reply)>;

  /// `context` must outlive it.
  explicit ProjectCalls(const StudioContext& context);
  /// Ends the dances in progress.
  ~ProjectCalls();
  ProjectCalls(const ProjectCalls&) = delete;
  ProjectCalls& operator=(const ProjectCalls&) = delete;

  Reply Model() const;
  /// Returns at once; `answer` is called from another thread, once. Those beyond a few are sent
  /// away with 503.
  void Dance(std::string project, bool as_bvh, Answer answer);

  static Reply Refuse(unsigned status, const std::string& message);

 private:
  Reply Danced(const std::string& project, bool as_bvh) const;

  const StudioContext& context_;
  std::atomic<int> asked_ = 0;
  std::atomic<bool> ends_ = false;
  boost::asio::thread_pool threads_;
};

}  // namespace choreo::studio
