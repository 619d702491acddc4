// candela-manifest PLUGIN.so OUTPUT.json: writes a plugin's manifest from its own descriptor. Run by
// candela_add_plugin().
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>

import candela.diagnostics;
import candela.library;
import candela.registry;

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fputs("usage: candela-manifest PLUGIN.so OUTPUT.json\n", stderr);
        return 2;
    }
    try {
        const candela::PluginDescriptor& descriptor = candela::load_plugin(argv[1], nullptr);
        const std::string json = candela::to_json(candela::manifest_of(descriptor, candela::host_abi()));
        const std::filesystem::path beside = std::string(argv[2]) + ".new";
        {
            std::ofstream out(beside, std::ios::binary);
            if (!(out << json) || !out.flush()) throw std::runtime_error("cannot write " + beside.string());
        }
        std::filesystem::rename(beside, argv[2]);
        return 0;
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "candela-manifest: %s\n", problem.what());
        return 1;
    }
}
