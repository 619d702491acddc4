#include <candela/reflection_plugin.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace candela::kernel {
#include "tabled.kernel"
}

using candela::kernel::TabledMaterial;
using namespace candela::sdk;

namespace {

/// Four numbers.
std::vector<float> read(const char* path) {
    std::ifstream file(path);
    std::vector<float> numbers{std::istream_iterator<float>(file), {}};
    if (numbers.size() != 4) throw std::runtime_error("the file does not contain four numbers");
    return numbers;
}

constexpr float k_ramp[] = {0.1f, 0.3f, 0.9f, 1.0f};

}  // namespace

constexpr auto k_fields = fields(
    real(&TabledMaterial::kd, "kd", 0.8f, "how much light is reflected diffusely").range(0, 1),
    numbers(&TabledMaterial::ramp, "ramp", k_ramp, "brightness by the cosine").range(0, 1),
    matrix(&TabledMaterial::mixing, "mixing", "what becomes of the channels", {1, 0, 0, 0, 1, 0, 0, 0, 1})
        .range(-1, 1),
    file_table(&TabledMaterial::file, "file", read, "what is added at the corners").optional(),
    integer(&TabledMaterial::squares, "squares", 8, "of the checker").range(1, 20));
constexpr candela::Property k_properties[] = {{"fixed-in-world"}};

CANDELA_KERNEL_PLUGIN(reflection,
                      (KernelReflection < TabledMaterial, &candela::kernel::tabled_reflect,
                       &candela::kernel::tabled_reflect_ambient, reads_position | reads_uv >),
                      tabled, TabledMaterial, k_fields,
                      {.title = "Tabled",
                       .summary = "A ramp, a matrix, a table from a file and a checker.",
                       .formula = "(see its kernel)",
                       .properties = k_properties})
