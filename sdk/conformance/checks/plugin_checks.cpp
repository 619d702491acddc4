// Requirements for every plugin.
#include <malloc.h>

#include <boost/dll/library_info.hpp>
#include <catch2/catch_test_macros.hpp>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

#include "subject.h"

namespace {

std::size_t threads_of_this_process() {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator("/proc/self/task"), {}));
}

/// The memory in use according to the allocator.
std::size_t bytes_in_use() {
    const struct mallinfo2 info = ::mallinfo2();
    return info.uordblks + info.hblkhd;
}

}  // namespace

TEST_CASE("handshake: it loads, its fingerprint is this Candela's, its manifest agrees with it", "[all]") {
    const auto begin = std::chrono::steady_clock::now();
    subject();
    const double ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    if (ms > 100)
        WARN("loading it took " << static_cast<int>(ms) << " ms: every render that uses it waits for that");
}

TEST_CASE("file name: <kind>-<name>.so, as the host expects it", "[all]") {
    const candela::Manifest& m = subject_manifest();
    const std::string expected = std::string(candela::name_of(m.kind)) + "-" + m.name + ".so";
    if (subject_library().filename() != expected)
        FAIL("the library is called '" << subject_library().filename().string() << "', so hosts do not find '"
                                       << expected << "'");
}

TEST_CASE("symbols: it exports candela_* and nothing else", "[all]") {
    for (const std::string& name : boost::dll::library_info(subject_library()).symbols()) {
        if (!name.starts_with("candela_"))
            FAIL_CHECK("it exports '"
                       << name << "', which may clash with another plugin's; candela_add_plugin() hides it");
    }
}

TEST_CASE("description: a title, a summary, and a meaning for each parameter", "[all]") {
    const candela::Manifest& m = subject_manifest();
    if (m.title.empty()) FAIL_CHECK("it has no title");
    if (m.summary.empty()) FAIL_CHECK("it has no summary");
    for (const candela::Parameter& p : m.parameters) {
        if (p.meaning.empty()) FAIL_CHECK("its parameter '" << p.name << "' has no meaning");
    }
    if (m.reference.empty() && m.kind == candela::PluginKind::reflection)
        WARN("it names no paper or book; readers want to know where a model comes from");
}

TEST_CASE(
    "parameters: each default is within its own range, and the defaults are consistent with one another",
    "[all]") {
    const candela::Manifest& m = subject_manifest();
    for (const candela::Parameter& p : m.parameters) {
        if (!p.default_value) continue;
        if (const auto wrong = candela::validation_error(p, *p.default_value))
            FAIL_CHECK("the default of '" << p.name << "': " << *wrong);
    }
    const candela::ParamSet defaults(m.parameters);
    for (const candela::Relation& relation : m.relations) {
        if (const auto wrong = candela::validation_error(relation, defaults))
            FAIL_CHECK("the defaults: " << *wrong);
    }
}

TEST_CASE(
    "instances: one can be created with every allowed set of values, and they clean up after themselves",
    "[all]") {
    if (needs_a_file()) SKIP("it needs a file that only a user has");
    const candela::PluginDescriptor& plugin = subject();
    const std::size_t before = threads_of_this_process();
    for (const Values& values : many_values()) {
        const auto runtime = values.set.runtime(candela::ColorEncoding::none);
        std::unique_ptr<candela::Instance> instance;
        try {
            instance.reset(plugin.create(runtime));
        } catch (const std::exception& problem) {
            FAIL("create() threw '" << problem.what() << "' with " << values.text);
        } catch (...) {
            FAIL("create() threw an object that is not a std::exception, with " << values.text);
        }
        if (instance == nullptr) FAIL("create() returned nothing with " << values.text);
    }
    // The first ones may have filled tables that all share.
    constexpr std::size_t k_instances = 64, k_negligible = 4096;
    const Values defaults = default_values();
    const auto runtime = defaults.set.runtime(candela::ColorEncoding::none);
    const std::size_t memory_before = bytes_in_use();
    for (std::size_t i = 0; i < k_instances; ++i) delete plugin.create(runtime);
    const std::size_t memory_after = bytes_in_use();
    if (memory_after > memory_before + k_instances * k_negligible)
        FAIL("each deleted instance leaks " << (memory_after - memory_before) / k_instances / 1024
                                            << " KiB of memory");
    const std::size_t after = threads_of_this_process();
    if (after > before)
        FAIL("it leaves " << after - before << " threads running after its instances are gone");
}
