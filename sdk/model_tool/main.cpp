// candela-model NAME.kernel OUTPUT.cpp
//
// Writes the C++ of a plugin from the kernel file of its model. Run by candela_add_plugin().
#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "candela/kernel_language/language.h"
#include "candela/kernel_language/model.h"

import candela.util;

namespace fs = std::filesystem;
namespace kl = candela::kernel_language;

namespace {

std::string text_of(const fs::path& file) {
    const auto text = candela::read_text_file(file);
    if (!text) throw std::runtime_error("cannot read '" + file.string() + "'");
    return *text;
}

/// Leaves a file that has this text already, so that it is not compiled again.
void write(const fs::path& file, const std::string& text) {
    if (candela::read_text_file(file) != text) candela::write_text_file(file, text);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fputs("usage: candela-model NAME.kernel OUTPUT.cpp\n", stderr);
        return 2;
    }
    try {
        const fs::path file = argv[1];
        const kl::Kernel kernel = kl::read_kernel({file.string(), text_of(file)});
        write(argv[2], kl::plugin_source(kl::read_model(kernel, kl::model_name(file)), file.string()));
        return 0;
    } catch (const kl::Problem& problem) {
        // Compilers write positions like this.
        std::fprintf(stderr, "%s:%zu:%zu: error: %s\n", problem.file().c_str(), problem.line(),
                     problem.column(), problem.what());
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "candela-model: %s\n", problem.what());
    }
    return 1;
}
