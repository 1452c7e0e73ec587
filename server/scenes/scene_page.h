#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon {

/// A part of the list of scenes.
struct ScenePage {
  std::vector<std::string> ids; ///< ascending
  bool hasMore = false;         ///< others follow the last
};

/// Finds a page among ids that come in any order, and never holds more than one page of them.
class PageFinder {
 public:
  /// The first `limit` >= 1 ids behind `after`; empty = from the beginning.
  PageFinder(std::string_view after, std::size_t limit) : after_(after), limit_(limit) {}

  void see(std::string_view id) {
    if (id <= after_ || (found_.size() > limit_ && id >= *found_.rbegin())) return;
    found_.emplace(id);
    if (found_.size() > limit_ + 1) found_.erase(std::prev(found_.end()));
  }

  ScenePage page() && {
    ScenePage page{{}, found_.size() > limit_};
    if (page.hasMore) found_.erase(std::prev(found_.end()));
    page.ids.assign(found_.begin(), found_.end());
    return page;
  }

 private:
  std::string after_;
  std::size_t limit_;
  std::set<std::string, std::less<>> found_; ///< one more than the page has, which shows that there are others
};

} // namespace gnomon
