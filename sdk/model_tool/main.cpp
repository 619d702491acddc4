// candela-model NAME.kernel OUTPUT.cpp
//
// Writes the C++ of a plugin from the kernel file of its model. Run by candela_add_plugin().
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "candela/kernel_language/language.h"
#include "candela/kernel_language/model.h"

namespace fs = std::filesystem;
namespace kl = candela::kernel_language;

namespace {

std::string text_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    if (!in) throw std::runtime_error("cannot read '" + file.string() + "'");
    return text;
}

/// Leaves a file that has this text already, so that it is not compiled again.
void write(const fs::path& file, const std::string& text) {
    if (fs::exists(file) && text_of(file) == text) return;
    const fs::path temporary = file.string() + ".new";
    {
        std::ofstream out(temporary, std::ios::binary);
        if (!(out << text) || !out.flush())
            throw std::runtime_error("cannot write '" + temporary.string() + "'");
    }
    fs::rename(temporary, file);
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
