module;

#include <cstddef>
#include <cstdint>
#include <vector>

module candela.shading:object_environment;

import :environment_map;
import :surface;
import candela.api;
import candela.geometry;
import candela.raster;
import candela.util;

namespace candela {

/// The normals from an object's shading model, on the side of each triangle that is its front.
void shading_normals(const SurfaceModels& surface, const SurfacePoints& points, const Vec3Span& normal);
/// Tilts them as the surface's picture of normals says, whose texels apply_textures() has put into the
/// points.
void tilt_normals(const SurfaceModels& surface, const SurfacePoints& points, const Vec3Span& normal);

/// The world around one object, as its models see it.
class ObjectEnvironment final : public Environment {
  public:
    explicit ObjectEnvironment(const EnvironmentMap& environment) : environment_(environment) {}

    /// Sets the object for the following calls.
    void set_object(const SurfaceModels& surface, const ShadedObject& object) {
        surface_ = &surface;
        object_ = object;
    }

    void look(std::size_t count, const ConstVec3Span& towards, const Vec3Span& intensity) override;
    float max_intensity() const noexcept override { return environment_.max_intensity(); }
    void trace_exit(std::size_t count, const ConstVec3Span& origin, const ConstVec3Span& direction,
                    const ExitBatch& exit) override;

  private:
    void leave_batch(std::size_t count, const ConstVec3Span& origin, const ConstVec3Span& direction,
                     const ExitBatch& exit);

    const EnvironmentMap& environment_;
    const SurfaceModels* surface_ = nullptr;
    ShadedObject object_;
    SurfacePoints points_;  // where rays left
    Vec3Arrays barycentric_, normal_;
    std::vector<std::uint32_t> triangles_;
};

}  // namespace candela
