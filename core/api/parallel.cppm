// Work on several threads (oneTBB), behind two functions, so that nobody else pays for its headers.
module;

#include "candela/api.h"

#include <cstddef>
#include <limits>
#include <type_traits>

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

}  // namespace candela
