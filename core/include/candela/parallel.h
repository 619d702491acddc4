// Parallel loops behind two functions, so that only one file includes oneTBB's headers.
#pragma once

#include <cstddef>
#include <limits>
#include <type_traits>

#include "candela/plugin/export.h"

namespace candela {

/// The number of processors this process may use.
CANDELA_EXPORT int available_threads() noexcept;

/// Refers to a callable without copying it; valid only during the call it is passed to.
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

/// Runs `work` with `threads` threads available to every parallel_for() within it. 0 means all available
/// threads; but if the other threads have not been started yet, and `milliseconds`, the estimated
/// single-threaded time of the work, does not justify starting them, only this one.
CANDELA_EXPORT void with_threads(int threads, FunctionRef<> work,
                                 double milliseconds = std::numeric_limits<double>::infinity());

/// The number of threads that a parallel_for() may use here.
CANDELA_EXPORT int current_threads() noexcept;

/// Calls `body(begin, end)` for ranges that partition [0, count), each of at least `grain` elements except
/// the last. An exception ends the work and is rethrown here. If the work fits into one grain, or only one
/// thread is available, no other thread is started.
CANDELA_EXPORT void parallel_for(std::size_t count, std::size_t grain,
                                 FunctionRef<std::size_t, std::size_t> body);

}  // namespace candela
