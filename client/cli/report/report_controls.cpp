#include "client/cli/report/report_controls.h"

namespace choreo::cli {

CutAtZero::CutAtZero(std::vector<int64_t>* frames) : rows_(frames->size()) {
  gone_ = static_cast<size_t>(std::ranges::lower_bound(*frames, 0) - frames->begin());
  if (gone_ == 0) return;
  const bool between = gone_ < rows_;
  if (!between || (*frames)[gone_] != 0) --gone_;
  const int64_t first = (*frames)[gone_];
  if (between && first < 0)
    share_ = static_cast<double>(-first) / static_cast<double>((*frames)[gone_ + 1] - first);
  frames->erase(frames->begin(), frames->begin() + static_cast<std::ptrdiff_t>(gone_));
  frames->front() = 0;
}

}  // namespace choreo::cli
