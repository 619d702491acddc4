// Arbitrary bytes as a glTF file, text or binary, with everything in addition to its triangles: materials,
// cameras, lights, nodes.
#include "imported.h"
#include "robustness/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text = fuzz::text_of(data, size);
    fuzz::check_import(fuzz::written(text.starts_with("glTF") ? "model.glb" : "model.gltf", text));
    return 0;
}
