// A program that imports the core, also includes a header of the plugin API, and uses a plugin that another
// project built.
#include <cstdio>
#include <exception>
#include <memory>

#include "candela/reflection_model.h"

import candela.core;

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    try {
        candela::Registry registry({argv[1]});
        const std::unique_ptr<candela::ReflectionModel> model = registry.create<candela::ReflectionModel>(
            "cel", registry.parameters(candela::PluginKind::reflection, "cel"), candela::ColorEncoding::none);
        if (candela::extension_of<candela::AllLightsReflection>(*model) == nullptr) return 1;
        const candela::SurfaceNeeds needs =
            registry.descriptor(candela::PluginKind::reflection, "cel").surface_needs;
        std::puts(needs.tangent ? "it needs tangents" : "it needs no tangents");
        return 0;
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "%s\n", problem.what());
        return 1;
    }
}
