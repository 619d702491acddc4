module;

#include "internal/embree_headers.h"

#include <fmt/format.h>

#include <boost/dll/shared_library.hpp>
#include <new>
#include <system_error>

module candela.geometry;

import :embree;
import candela.diagnostics;

namespace candela {

namespace {

// What it is called is a matter of its version, as are its functions' arguments.
#if RTC_VERSION_MAJOR >= 4
constexpr const char* k_library = "libembree4.so.4";
#else
constexpr const char* k_library = "libembree3.so.3";
#endif

boost::dll::shared_library loaded() {
    std::error_code problem;
    boost::dll::shared_library library(
        k_library, problem, boost::dll::load_mode::search_system_folders | boost::dll::load_mode::rtld_local);
    if (problem)
        throw Error(ErrorCategory::failure,
                    fmt::format("rays within transparent objects are followed by Embree, but {0} cannot be "
                                "loaded (Debian's package libembree{1}-{1} has it): {2}",
                                k_library, RTC_VERSION_MAJOR, problem.message()));
    return library;
}

}  // namespace

// Trees are built by one thread, so that they are the same ones however many there are.
Embree::Embree() : library(loaded()), device(new_device("threads=1,set_affinity=0")) {
    if (device == nullptr) throw std::bad_alloc();
}

const Embree& Embree::instance() {
    // Not destroyed: threads may still follow rays.
    static const Embree* const k_embree = new Embree;
    return *k_embree;
}

}  // namespace candela
