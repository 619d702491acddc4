// Arbitrary bytes as the material library of an OBJ file.
#include "imported.h"
#include "robustness/fuzz/fuzz.h"

namespace {

constexpr const char* k_model = R"(mtllib model.mtl
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
vt 0 0
vt 1 0
vt 0 1
usemtl a
f 1/1 3/3 2/2
usemtl b
f 1/1 2/2 4/3
usemtl c
f 1/1 4/2 3/3
f 2/1 3/2 4/3
)";
constexpr const char* k_image = "P6 2 2 255\nabcdefghijkl";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const bool is_there = !fuzz::written("a.ppm", k_image).empty();
    static const std::filesystem::path model = fuzz::written("model.obj", k_model);
    fuzz::written("model.mtl", fuzz::text_of(data, size));
    if (is_there) fuzz::check_import(model);
    return 0;
}
