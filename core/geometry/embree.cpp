module;

#include "internal/embree_headers.h"

#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>

#include <array>
#include <boost/dll/shared_library.hpp>
#include <memory>
#include <new>
#include <system_error>

module candela.geometry;

import :embree;
import candela.api;
import candela.util;

namespace candela {

namespace {

// The library's name depends on its version, as do its functions' arguments.
#if RTC_VERSION_MAJOR >= 4
constexpr const char* k_library = "libembree4.so.4";
#else
constexpr const char* k_library = "libembree3.so.3";
#endif

boost::dll::shared_library loaded() {
    std::error_code problem;
    boost::dll::shared_library library(
        k_library, problem, boost::dll::load_mode::search_system_folders | boost::dll::load_mode::rtld_local);
    if (problem)
        throw Error(
            ErrorCategory::failure,
            fmt::format(
                "Embree follows rays to lights and within transparent objects, but {0} cannot be loaded "
                "(Debian's package libembree{1}-{1} has it): {2}",
                k_library, RTC_VERSION_MAJOR, problem.message()));
    return library;
}

}  // namespace

// Does not set a number of threads: Embree would impose it on the whole process, since both use oneTBB
// (https://github.com/RenderKit/embree/issues/507).
Embree::Embree() : library(loaded()), device(new_device("set_affinity=0")) {
    if (device == nullptr) throw std::bad_alloc();
}

void Embree::commit(RTCScene scene, bool in_parallel) const {
    // Embree's tasks run in the arena of the thread that calls it.
    if (in_parallel && current_threads() > 1) return commit_scene(scene);
    // If an arena for one thread had two, oneTBB would let one work for the other. Never destroyed: threads
    // may still be working while the process exits.
    static auto& arenas = *new Pool<tbb::task_arena>;
    arenas.with([] { return std::make_unique<tbb::task_arena>(1); },
                [&](tbb::task_arena& alone) { alone.execute([&] { commit_scene(scene); }); });
}

namespace {

#if RTC_VERSION_MAJOR >= 4
template <class Arguments>
void set(Arguments& arguments, RTCFilterFunctionN filter, RTCRayQueryFlags flags,
         Embree::RayContext& context) {
    rtcInitRayQueryContext(&context);
    arguments.context = &context;
    arguments.filter = filter;
    // NOLINTNEXTLINE(clang-analyzer-optin.core.EnumCastOutOfRange): they are bits
    arguments.flags = static_cast<RTCRayQueryFlags>(
        filter != nullptr ? unsigned{flags} | RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER : unsigned{flags});
}
#else
void set(Embree::RayContext& context, RTCFilterFunctionN filter, RTCIntersectContextFlags flags) {
    rtcInitIntersectContext(&context);
    context.flags = flags;
    context.filter = filter;
}
#endif

}  // namespace

void Embree::trace(RTCScene scene, const std::array<int, k_packet_size>& is_valid, RTCFilterFunctionN filter,
                   RayContext& context, RTCRayHit16& rays) const {
#if RTC_VERSION_MAJOR >= 4
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    set(arguments, filter, RTC_RAY_QUERY_FLAG_COHERENT, context);
    intersect16(is_valid.data(), scene, &rays, &arguments);
#else
    set(context, filter, RTC_INTERSECT_CONTEXT_FLAG_COHERENT);
    intersect16(is_valid.data(), scene, &context, &rays);
#endif
}

// Any hit ends a ray, so that the rays of a packet soon part: traversal for coherent rays is up to three
// times slower.
void Embree::occluded(RTCScene scene, const std::array<int, k_packet_size>& is_valid,
                      RTCFilterFunctionN filter, RayContext& context, RTCRay16& rays) const {
#if RTC_VERSION_MAJOR >= 4
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    set(arguments, filter, RTC_RAY_QUERY_FLAG_INCOHERENT, context);
    occluded16(is_valid.data(), scene, &rays, &arguments);
#else
    set(context, filter, RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
    occluded16(is_valid.data(), scene, &context, &rays);
#endif
}

const Embree& Embree::instance() {
    // Not destroyed: threads may still be following rays.
    static const Embree* const k_embree = new Embree;
    return *k_embree;
}

}  // namespace candela
