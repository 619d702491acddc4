// Intel's Embree, loaded when a model first asks for rays.
module;

#include "embree_headers.h"

#include <boost/dll/shared_library.hpp>

module candela.geometry:embree;

namespace candela {

/// Embree's functions, and a device that they work with. One for the process, which lives until its end.
struct Embree {
    boost::dll::shared_library library;

#define CANDELA_EMBREE_FUNCTION(name) decltype(&::name) name = &library.get<decltype(::name)>(#name)
    CANDELA_EMBREE_FUNCTION(rtcNewDevice);
    CANDELA_EMBREE_FUNCTION(rtcGetDeviceError);
    CANDELA_EMBREE_FUNCTION(rtcNewScene);
    CANDELA_EMBREE_FUNCTION(rtcReleaseScene);
    CANDELA_EMBREE_FUNCTION(rtcSetSceneFlags);
    CANDELA_EMBREE_FUNCTION(rtcCommitScene);
    CANDELA_EMBREE_FUNCTION(rtcNewGeometry);
    CANDELA_EMBREE_FUNCTION(rtcReleaseGeometry);
    CANDELA_EMBREE_FUNCTION(rtcSetNewGeometryBuffer);
    CANDELA_EMBREE_FUNCTION(rtcSetGeometryIntersectFilterFunction);
    CANDELA_EMBREE_FUNCTION(rtcCommitGeometry);
    CANDELA_EMBREE_FUNCTION(rtcAttachGeometry);
    CANDELA_EMBREE_FUNCTION(rtcIntersect1);
#undef CANDELA_EMBREE_FUNCTION

    RTCDevice device;

    /// Throws an Error that names the library where it cannot be loaded, and std::bad_alloc.
    static const Embree& instance();

  private:
    Embree();
};

}  // namespace candela
