// candela-manifest PLUGIN.so OUTPUT.json [--author=NAME] [--license=SPDX]: writes a plugin's manifest from
// its own descriptor. Run by candela_add_plugin().
#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

import candela.diagnostics;
import candela.library;
import candela.registry;

int main(int argc, char** argv) {
    std::string author, license;
    const std::array<std::pair<std::string_view, std::string*>, 2> options{
        {{"--author=", &author}, {"--license=", &license}}};
    bool is_understood = argc >= 3;
    for (int i = 3; i < argc; ++i) {
        const std::string_view word = argv[i];
        const auto option =
            std::ranges::find_if(options, [&](const auto& o) { return word.starts_with(o.first); });
        if (option == options.end())
            is_understood = false;
        else
            *option->second = word.substr(option->first.size());
    }
    if (!is_understood) {
        std::fputs("usage: candela-manifest PLUGIN.so OUTPUT.json [--author=NAME] [--license=SPDX]\n",
                   stderr);
        return 2;
    }
    try {
        const candela::PluginDescriptor& descriptor = candela::load_plugin(argv[1], nullptr);
        candela::Manifest manifest = candela::manifest_of(descriptor, candela::host_abi());
        candela::require_name(author, "author");
        candela::require_name(license, "license");
        manifest.author = author;
        manifest.license = license;
        const std::string json = candela::to_json(manifest);
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
