// Arbitrary bytes as an answer to an exercise: text accepted as a function's body cannot leave it.
#include "candela/kernel_language/language.h"
#include "kernel_text.h"
#include "robustness/fuzz/fuzz.h"

namespace kl = candela::kernel_language;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(fuzz::text_of(data, size));
    const kl::Source kernel{
        "x.kernel",
        "struct XMaterial { vec3 kd; float k; int n; Table ramp; mat3 m; };\n"
        "KERNEL Reflected x_reflect(XMaterial m, Surface s, vec3 to_light) {\n"
        "    return Reflected(vec3(0.0f), vec3(0.0f));\n}\n"
        "KERNEL vec3 x_after(XMaterial m, Surface s) { return x_reflect(m, s, s.normal).diffuse; }\n"};
    try {
        fuzz::check_accepted(kl::read_kernel(kernel, kl::Body{"x_reflect", {"answer", text}}));
    } catch (const kl::Problem& problem) {
        fuzz::check_problem(problem, problem.file() == "answer" ? text : kernel.text);
    }
    return 0;
}
