#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <list>
#include <utility>

namespace gnomon {

/// What a cache holds, from the most to the least recently used entry. Finding one looks at each before it. An entry
/// stays where it is in memory until it is dropped. For one thread at a time.
template <class Entry>
class LruList {
 public:
  /// The first entry that satisfies `is`, from now on the most recently used; nullptr = there is none.
  template <class Is>
  Entry* findIf(const Is& is) {
    const auto found = std::ranges::find_if(entries_, is);
    if (found == entries_.end()) return nullptr;
    entries_.splice(entries_.begin(), entries_, found);
    return &entries_.front();
  }

  /// The same by a key. `keyOf`: a member of the entry, or a function of it.
  template <class Key, class KeyOf>
  Entry* find(const Key& key, const KeyOf& keyOf) {
    return findIf([&](const Entry& entry) { return std::invoke(keyOf, entry) == key; });
  }

  /// As the most recently used, whether or not there is one like it.
  Entry& add(Entry entry) {
    entries_.push_front(std::move(entry));
    return entries_.front();
  }

  /// Drops the least recently used until there are no more than `most`.
  void keepNewest(std::size_t most) {
    if (entries_.size() > most) {
      entries_.erase(std::next(entries_.begin(), static_cast<std::ptrdiff_t>(most)), entries_.end());
    }
  }

  /// Drops the least recently used until all together cost no more than `budget`; the newest stays, whatever it costs.
  /// `costOf` is asked once an entry from the newest on, so that what several share may be counted once.
  template <class CostOf>
  void keepWithin(std::uint64_t budget, CostOf costOf) {
    std::uint64_t cost = 0;
    const auto dropped = std::ranges::find_if(entries_, [&](const Entry& entry) {
      cost += costOf(entry);
      return cost > budget && &entry != &entries_.front();
    });
    entries_.erase(dropped, entries_.end());
  }

  /// Drops all that satisfy `is`, and says how many.
  template <class Is>
  std::size_t eraseIf(const Is& is) {
    return entries_.remove_if(is);
  }

  // From the most recently used on; what is only looked at does not count as used.
  auto begin() { return entries_.begin(); }
  auto begin() const { return entries_.begin(); }
  auto end() { return entries_.end(); }
  auto end() const { return entries_.end(); }
  std::size_t size() const { return entries_.size(); }

 private:
  std::list<Entry> entries_;
};

} // namespace gnomon
