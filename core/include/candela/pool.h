#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace candela {

/// Objects that each range of a parallel loop needs for itself, and that cost more to create than to reuse.
template <class Thing>
class Pool {
  public:
    /// Calls `use(thing)` with an object that no other thread is using; if all are in use, `make()` creates
    /// another as a std::unique_ptr. An object whose use ended in an exception is not reused. Any thread.
    template <class Make, class Use>
    void with(Make make, Use use) {
        std::unique_ptr<Thing> thing = take();
        if (thing == nullptr) thing = make();
        use(*thing);
        const std::scoped_lock lock(mutex_);
        free_.push_back(std::move(thing));
    }

    /// Calls `visit(thing)` for each object. None may be in use.
    template <class Visit>
    void each(Visit visit) {
        for (const std::unique_ptr<Thing>& thing : free_) visit(*thing);
    }

  private:
    std::unique_ptr<Thing> take() {
        const std::scoped_lock lock(mutex_);
        if (free_.empty()) return nullptr;
        std::unique_ptr<Thing> thing = std::move(free_.back());
        free_.pop_back();
        return thing;
    }

    std::mutex mutex_;
    std::vector<std::unique_ptr<Thing>> free_;
};

}  // namespace candela
