#include "libpng.h"

#include <stdexcept>
#include <string>
#include <system_error>

namespace {

boost::dll::shared_library loaded() {
    // libpng 1.6 is libpng16.so.16.
    const std::string number = std::to_string(PNG_LIBPNG_VER_MAJOR) + std::to_string(PNG_LIBPNG_VER_MINOR);
    const std::string name = "libpng" + number + ".so." + std::to_string(PNG_LIBPNG_VER_SONUM);
    std::error_code problem;
    boost::dll::shared_library library(
        name, problem, boost::dll::load_mode::search_system_folders | boost::dll::load_mode::rtld_local);
    if (problem) {
        throw std::runtime_error("reading PNG files needs " + name +
                                 ", which cannot be loaded (it is in Debian's package libpng" + number + "-" +
                                 number + "): " + problem.message());
    }
    return library;
}

}  // namespace

LibPng::LibPng() : library(loaded()) {}

const LibPng& LibPng::instance() {
    // Never destroyed: threads may still be reading.
    static const LibPng* const k_libpng = new LibPng;
    return *k_libpng;
}
