// Arbitrary bytes as a mesh file; the first byte selects the format.
#include <array>
#include <exception>

#include "robustness/fuzz/fuzz.h"
#include "support/plugins.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::array k_names = {"mesh.obj", "mesh.ply", "mesh.stl", "mesh.gltf", "mesh.glb"};
    if (size == 0) return 0;
    const auto file = fuzz::written(k_names[data[0] % k_names.size()], fuzz::text_of(data + 1, size - 1));
    try {
        const auto mesh = candela::build_mesh(*instance<candela::Shape>("mesh", {{"file", file.string()}}),
                                              {}, {}, *instance<candela::ShadingModel>("gouraud"));
        fuzz::require(mesh.triangle_count() > 0, "a mesh without triangles");
    } catch (const std::exception& problem) {
        fuzz::require(*problem.what() != '\0', "a refusal is empty");
    }
    return 0;
}
