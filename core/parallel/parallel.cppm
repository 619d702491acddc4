// Work on several threads (oneTBB), behind two functions, so that nobody else pays for its headers.
module;

#include "candela/api.h"

#include <cstddef>
#include <limits>
#include <memory>
#include <mutex>
#include <type_traits>
#include <utility>
#include <vector>

export module candela.parallel;

export namespace candela {

/// Processors that this process may use.
CANDELA_API int available_threads() noexcept;

/// A callable passed on without being copied; valid only during the call that it is passed to.
template <class... Arguments>
class FunctionRef {
  public:
    template <class Function>
        requires(!std::is_same_v<std::remove_cvref_t<Function>, FunctionRef>)
    FunctionRef(Function&& function)
        : object_(const_cast<void*>(static_cast<const void*>(&function))),
          call_([](void* object, Arguments... arguments) {
              (*static_cast<std::remove_reference_t<Function>*>(object))(arguments...);
          }) {}
    void operator()(Arguments... arguments) const { call_(object_, arguments...); }

  private:
    void* object_;
    void (*call_)(void*, Arguments...);
};

/// Runs `work` with `threads` threads at the disposal of every parallel_for() within. 0: all that are
/// available; or this one alone, where the others have not been started yet and `milliseconds`, what one
/// thread roughly takes for the work, is not worth starting them.
CANDELA_API void with_threads(int threads, FunctionRef<> work,
                              double milliseconds = std::numeric_limits<double>::infinity());

/// Calls `body(begin, end)` for ranges that together are [0, count), each of at least `grain` unless it is
/// the last. Exceptions end the work and come out here. Work of one grain, or with one thread, starts no
/// other thread.
CANDELA_API void parallel_for(std::size_t count, std::size_t grain,
                              FunctionRef<std::size_t, std::size_t> body);

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
