// Intel's Embree, loaded when a model first needs rays.
module;

#include "embree_headers.h"

#include <array>
#include <boost/dll/shared_library.hpp>
#include <cstddef>

module candela.geometry:embree;

namespace candela {

/// Embree's functions, and the device that they use. One per process, which lives until its end.
struct Embree {
    boost::dll::shared_library library;

#define CANDELA_EMBREE_FUNCTION(name, symbol) \
    decltype(&::symbol) name = &library.get<decltype(::symbol)>(#symbol)
    CANDELA_EMBREE_FUNCTION(new_device, rtcNewDevice);
    CANDELA_EMBREE_FUNCTION(get_device_error, rtcGetDeviceError);
    CANDELA_EMBREE_FUNCTION(new_scene, rtcNewScene);
    CANDELA_EMBREE_FUNCTION(release_scene, rtcReleaseScene);
    CANDELA_EMBREE_FUNCTION(set_scene_flags, rtcSetSceneFlags);
    CANDELA_EMBREE_FUNCTION(commit_scene, rtcCommitScene);
    CANDELA_EMBREE_FUNCTION(new_geometry, rtcNewGeometry);
    CANDELA_EMBREE_FUNCTION(release_geometry, rtcReleaseGeometry);
    CANDELA_EMBREE_FUNCTION(set_new_geometry_buffer, rtcSetNewGeometryBuffer);
    CANDELA_EMBREE_FUNCTION(set_shared_geometry_buffer, rtcSetSharedGeometryBuffer);
    CANDELA_EMBREE_FUNCTION(set_geometry_user_data, rtcSetGeometryUserData);
    CANDELA_EMBREE_FUNCTION(commit_geometry, rtcCommitGeometry);
    CANDELA_EMBREE_FUNCTION(attach_geometry, rtcAttachGeometry);
    CANDELA_EMBREE_FUNCTION(attach_geometry_by_id, rtcAttachGeometryByID);
    CANDELA_EMBREE_FUNCTION(intersect16, rtcIntersect16);
    CANDELA_EMBREE_FUNCTION(occluded16, rtcOccluded16);
#undef CANDELA_EMBREE_FUNCTION

    RTCDevice device;

    /// The number of rays that are traced together.
    static constexpr std::size_t k_packet_size = 16;

    /// Builds the scene's tree: on this thread alone, so that it does not depend on the number of threads, or
    /// with as many as a parallel_for() would use.
    void commit(RTCScene scene, bool in_parallel = false) const;

    /// The scene flag that lets trace() use a filter.
#if RTC_VERSION_MAJOR >= 4
    static constexpr RTCSceneFlags k_filters_by_call = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;
#else
    static constexpr RTCSceneFlags k_filters_by_call = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
#endif

    /// Passed to filters; a caller's own data may follow it.
#if RTC_VERSION_MAJOR >= 4
    using RayContext = RTCRayQueryContext;
#else
    using RayContext = RTCIntersectContext;
#endif

    /// Finds the nearest hits of rays that are close to each other, except those that `filter` rejects, if
    /// there is one.
    void trace(RTCScene scene, const std::array<int, k_packet_size>& is_valid, RTCFilterFunctionN filter,
               RayContext& context, RTCRayHit16& rays) const;

    /// Finds which of the rays hit anything that `filter` does not reject: their `tfar` becomes negative.
    void occluded(RTCScene scene, const std::array<int, k_packet_size>& is_valid, RTCFilterFunctionN filter,
                  RayContext& context, RTCRay16& rays) const;

    /// Throws an Error that names the library if it cannot be loaded, and std::bad_alloc.
    static const Embree& instance();

  private:
    Embree();
};

}  // namespace candela
