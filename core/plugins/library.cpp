module;

#include <elf.h>
#include <fmt/format.h>
#include <link.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <boost/dll/runtime_symbol_info.hpp>
#include <boost/dll/shared_library.hpp>
#include <cstdint>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <ios>
#include <latch>
#include <limits>
#include <map>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

module candela.plugins;

import candela.util;

namespace candela {

namespace {

namespace fs = std::filesystem;

struct Loaded {
    boost::dll::shared_library library;
    const PluginDescriptor* descriptor = nullptr;
};

/// Never destroyed, because unloading would leave dangling vtables and exceptions behind.
std::map<fs::path, Loaded>& loaded_libraries() {
    static auto* const libraries = new std::map<fs::path, Loaded>;
    return *libraries;
}

[[noreturn]] void refuse(const fs::path& library, const std::string& reason) {
    throw Error(ErrorCategory::failure, fmt::format("plugin '{}' is refused: {}", library.string(), reason));
}

/// The dynamic linker's message, which Boost.DLL wraps in its own and that of an unrelated system error,
/// without the path, which the caller's message names already: "undefined symbol: f", "libfoo.so.1: cannot
/// open shared object file: No such file or directory".
std::string loader_message(const boost::dll::fs::system_error& problem, const fs::path& library) {
    std::string text = problem.what();
    constexpr std::string_view k_begin = "(dlerror system message: ";
    if (const auto at = text.find(k_begin); at != std::string::npos) {
        text.erase(0, at + k_begin.size());
        if (const auto end = text.rfind("): "); end != std::string::npos) text.erase(end);
    }
    const std::string path = library.string() + ": ";
    if (text.starts_with(path)) text.erase(0, path.size());
    return text;
}

/// "libfoo.so.1", if the dynamic linker does not find that library; otherwise empty.
std::string missing_dependency(const std::string& message) {
    const auto at = message.find(": cannot open shared object file: No such file");
    return at == std::string::npos ? std::string() : message.substr(0, at);
}

bool is_address_space_limited() {
    rlimit limit{};
    return ::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
}

/// The dynamic linker has several messages for it, or passes on the system's.
bool is_for_want_of_memory(std::string_view message) {
    static constexpr std::array<std::string_view, 5> k_signs{
        "failed to map", "cannot map", "annot allocate", "Resource temporarily unavailable", "out of memory"};
    return std::ranges::any_of(
        k_signs, [&](std::string_view sign) { return message.find(sign) != std::string_view::npos; });
}

constexpr std::string_view k_no_address_space =
    "not enough memory to load it; ulimit -v limits the address space";
constexpr std::string_view k_no_threads =
    "too few threads can be started; raise the limit on processes (ulimit -u)";

/// Some third-party libraries start threads while they are loaded, and wait forever if they cannot.
constexpr unsigned k_needed_threads = 8;

/// Whether a limit on threads, of the user or of a container, may leave fewer than needed; takes next to no
/// time.
bool is_thread_limit_near() {
    rlimit limit{};
    if (::getrlimit(RLIMIT_NPROC, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
        std::ifstream load("/proc/loadavg");  // "0.2 0.1 0.1 3/412 …": 412 tasks exist, of all users together
        std::uint64_t tasks = 0;
        load.ignore(std::numeric_limits<std::streamsize>::max(), '/') >> tasks;
        if (limit.rlim_cur < tasks + k_needed_threads) return true;
    }
    std::uint64_t most = 0, current = 0;
    return std::ifstream("/sys/fs/cgroup/pids.max") >> most &&
           std::ifstream("/sys/fs/cgroup/pids.current") >> current && most < current + k_needed_threads;
}

bool can_start_threads() {
    if (!is_thread_limit_near()) return true;
    std::latch end(1);
    std::vector<std::jthread> threads;
    try {
        while (threads.size() < k_needed_threads) threads.emplace_back([&] { end.wait(); });
    } catch (const std::system_error&) {  // NOLINT(bugprone-empty-catch): the number of threads says it
    }
    end.count_down();
    return threads.size() == k_needed_threads;
}

boost::dll::shared_library open_library(const fs::path& library) {
    if (!can_start_threads()) refuse(library, std::string(k_no_threads));
    try {
        return boost::dll::shared_library(
            library, boost::dll::load_mode::rtld_now | boost::dll::load_mode::rtld_local);
    } catch (const boost::dll::fs::system_error& problem) {
        const std::string message = loader_message(problem, library);
        if (const std::string missing = missing_dependency(message); !missing.empty())
            refuse(library, fmt::format("it needs {}, which is not installed here; install it, or put it "
                                        "where the plugin's RPATH looks for it",
                                        missing));
        if (is_address_space_limited() && is_for_want_of_memory(message))
            refuse(library, fmt::format("{} ({})", k_no_address_space, message));
        refuse(library, fmt::format("it cannot be loaded ({}); build it again, or remove it", message));
    }
}

/// Reads an object at this offset; returns false if the file ends before. Throws Error if reading fails.
template <class Object>
bool read_at(RegularFile& file, std::uint64_t offset, Object& object, const fs::path& name) {
    if (offset > file.size() || file.size() - offset < sizeof object) return false;
    const std::span<char> bytes(reinterpret_cast<char*>(&object), sizeof object);
    if (!file.seek(offset) || file.read(bytes) != bytes.size())
        throw Error(ErrorCategory::failure, fmt::format("'{}' cannot be read", name.string()));
    return true;
}

/// The parts of the manifest that contradict the library.
std::string differences(const Manifest& written, const Manifest& actual) {
    std::string parts;
    const auto compare = [&](std::string_view what, bool same) {
        if (same) return;
        if (!parts.empty()) parts += ", ";
        parts += what;
    };
    compare("kind", written.kind == actual.kind);
    compare("name", written.name == actual.name);
    compare("version", written.version == actual.version);
    compare("title", written.title == actual.title);
    compare("summary", written.summary == actual.summary);
    compare("formula", written.formula == actual.formula);
    compare("reference", written.reference == actual.reference);
    compare("parameters", written.parameters == actual.parameters);
    compare("relations", written.relations == actual.relations);
    compare("properties", written.properties == actual.properties);
    compare("presets", written.presets == actual.presets);
    compare("formats", written.formats == actual.formats);
    compare("ambient part", written.has_ambient == actual.has_ambient);
    compare("needs",
            written.surface_needs == actual.surface_needs && written.shading_needs == actual.shading_needs);
    compare("kernel", written.has_kernel == actual.has_kernel &&
                          written.kernel_prefix == actual.kernel_prefix &&
                          written.kernel_parameters == actual.kernel_parameters);
    return parts;
}

}  // namespace

std::string library_damage(const fs::path& library) {
    constexpr unsigned char k_class = sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32;
    RegularFile file(library);
    // An error that may be temporary says nothing about the library.
    if (!file.is_open())
        throw Error(ErrorCategory::failure, fmt::format("'{}' cannot be read", library.string()));
    ElfW(Ehdr) header{};
    if (!read_at(file, 0, header, library) || std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0 ||
        header.e_ident[EI_CLASS] != k_class)
        return "it is not an ELF shared library for this machine";
    const auto holds = [&](std::uint64_t offset, std::uint64_t count) {
        return offset <= file.size() && count <= file.size() - offset;
    };
    // The section table is at the end of the file; stripped libraries may lack it.
    bool is_complete = header.e_shnum == 0 || holds(header.e_shoff, header.e_shnum * sizeof(ElfW(Shdr)));
    for (std::uint64_t i = 0; is_complete && i < header.e_phnum; ++i) {
        ElfW(Phdr) segment{};
        is_complete = read_at(file, header.e_phoff + i * sizeof segment, segment, library) &&
                      holds(segment.p_offset, segment.p_filesz);
    }
    return is_complete ? std::string() : fmt::format("it is truncated after {} bytes", file.size());
}

const PluginDescriptor& load_plugin(const fs::path& path, const Manifest* manifest) {
    static std::mutex mutex;
    const std::lock_guard lock(mutex);
    const fs::path library = fs::absolute(path).lexically_normal();

    if (manifest != nullptr && manifest->abi != host_abi()) {
        refuse(library,
               fmt::format("it was built for '{}', but this is '{}'; build it again with this Candela's SDK",
                           manifest->abi, host_abi()));
    }
    Loaded& entry = loaded_libraries()[library];
    if (!entry.library.is_loaded()) {
        if (const std::string damage = library_damage(library); !damage.empty())
            refuse(library, fmt::format("it cannot be loaded ({}); build it again, or remove it", damage));
        entry.library = open_library(library);
    }
    if (entry.descriptor == nullptr) {
        for (const char* symbol : {"candela_plugin_abi", "candela_plugin_descriptor"}) {
            if (!entry.library.has(symbol)) {
                refuse(library, fmt::format("it does not export {}, so it is not a Candela plugin", symbol));
            }
        }
        const std::string_view abi = entry.library.get<const char*()>("candela_plugin_abi")();
        if (abi != host_abi()) {
            refuse(
                library,
                fmt::format("it was built for '{}', but this is '{}'; build it again with this Candela's SDK",
                            abi, host_abi()));
        }
        const PluginDescriptor* descriptor =
            entry.library.get<const PluginDescriptor*()>("candela_plugin_descriptor")();
        if (descriptor == nullptr || descriptor->create == nullptr)
            refuse(library, "its descriptor is empty");
        entry.descriptor = descriptor;
    }
    if (manifest != nullptr) {
        const Manifest actual = manifest_of(*entry.descriptor, host_abi());
        if (const std::string parts = differences(*manifest, actual); !parts.empty()) {
            refuse(library, fmt::format("its manifest disagrees with it about its {}; build the plugin "
                                        "again, so that both come from the same build",
                                        parts));
        }
    }
    return *entry.descriptor;
}

void rethrow_as_plugin_error(PluginKind kind, std::string_view name) {
    try {
        throw;
    } catch (const Error&) {
        throw;
    } catch (const std::exception& problem) {
        throw Error(ErrorCategory::failure,
                    fmt::format("plugin {}: {}", plugin_id(kind, name), problem.what()));
    } catch (...) {
        throw Error(
            ErrorCategory::failure,
            fmt::format("plugin {} threw an object that is not a std::exception", plugin_id(kind, name)));
    }
}

}  // namespace candela
