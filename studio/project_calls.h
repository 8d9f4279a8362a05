#pragma once

#include <atomic>
#include <boost/asio/thread_pool.hpp>
#include <functional>
#include <string>

#include "studio/studio_context.h"

namespace choreo::studio {

/// Calls of other programs over plain HTTP, in JSON (docs/programs.md): GET /model returns the
/// model; POST /dance takes a project (client/authoring/project/project_file.h) and returns its
/// dance; /dance?as=bvh returns a BVH file. Metres, axis-angle. A project contains its song,
/// `song_data` in base64; without one the dance is silent, `seconds` long. Failures are {"error":
/// "..."}, naming field, value and limit.
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
  /// Returns at once; calls `answer` once from another thread. Answers 503 while a few others are
  /// in progress.
  void Dance(std::string project, bool as_bvh, Answer answer);

  static Reply Refuse(unsigned status, const std::string& message);

 private:
  Reply Danced(const std::string& project, bool as_bvh) const;

  const StudioContext& context_;
  std::atomic<int> requests_ = 0;
  std::atomic<bool> ends_ = false;
  boost::asio::thread_pool threads_;
};

}  // namespace choreo::studio
