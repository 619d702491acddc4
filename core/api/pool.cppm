// Things that are made once and lent to one thread at a time.
module;

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

export module candela.pool;

export namespace candela {

/// Things that work in a range needs one of, and that take longer to make than to use again.
template <class Thing>
class Pool {
  public:
    /// Calls `use(thing)` with one that nobody else has; `make()` makes another, as a std::unique_ptr, where
    /// all are in use. One that an exception came out of is not used again. Any thread.
    template <class Make, class Use>
    void with(Make make, Use use) {
        std::unique_ptr<Thing> thing = take();
        if (thing == nullptr) thing = make();
        use(*thing);
        const std::scoped_lock lock(mutex_);
        free_.push_back(std::move(thing));
    }

    /// Calls `visit(thing)` for each, while none is in use.
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
