#include "registry.h"

#include "candela/kernel_language/model_compiler.h"
#include "module.h"

import candela.api;
import candela.plugins;

namespace candela::python {

namespace {

PluginKind kind_named(const std::string& name) {
    if (const auto kind = plugin_kind_named(name)) return *kind;
    std::string all;
    for (const PluginKind kind : k_plugin_kinds)
        all += fmt::format("{}'{}'", all.empty() ? "" : ", ", name_of(kind));
    throw Error(ErrorCategory::bad_request,
                fmt::format("unknown kind of plugin '{}'; the kinds are {}", name, all));
}

std::string manifests(SharedRegistry& registry, const std::string& kind) {
    std::vector<Manifest> all;
    for (const PluginFile* const file :
         kind.empty() ? registry.registry().list() : registry.registry().list(kind_named(kind)))
        all.push_back(file->manifest);
    return to_json(all);
}

/// Without a kind, `name` is that of a kernel file.
const PluginFile& required(SharedRegistry& registry, const std::string& kind, const std::string& name) {
    return kind.empty() ? registry.registry().require_kernel(name)
                        : registry.registry().require(kind_named(kind), name);
}

std::string manifest(SharedRegistry& registry, const std::string& kind, const std::string& name) {
    return to_json(required(registry, kind, name).manifest);
}

std::filesystem::path library(SharedRegistry& registry, const std::string& kind, const std::string& name) {
    return required(registry, kind, name).library;
}

std::vector<std::filesystem::path> search_path(SharedRegistry& registry) {
    return registry.registry().search_path();
}

}  // namespace

SharedRegistry::SharedRegistry(const std::vector<std::filesystem::path>& folders)
    : registry_(
          plugin_search_path(folders), PluginTrust::own_and_system, folders.size(),
          [this](const Refusal& refusal) {
              const std::lock_guard lock(mutex_);
              replaced_.push_back(
                  {.severity = "warning",
                   .file = refusal.file.string(),
                   .message = refusal.reason,
                   .suggestion = fmt::format("using '{}' instead", refusal.used_instead.string()),
                   .text = {}});
          },
          kernel_language::compile_kernel_file) {}

std::vector<Problem> SharedRegistry::replaced() const {
    const std::lock_guard lock(mutex_);
    return replaced_;
}

void add_registry(py::module_& module) {
    using Unlocked = py::call_guard<py::gil_scoped_release>;
    py::class_<SharedRegistry, RegistryPointer>(module, "Registry", "The plugins of a search path.")
        .def(py::init<const std::vector<std::filesystem::path>&>(), py::arg("folders"), Unlocked())
        .def_property_readonly("search_path", &search_path)
        .def_property_readonly("replaced", &SharedRegistry::replaced)
        .def("manifests", &manifests, py::arg("kind"), Unlocked(),
             "The manifests of a kind, or all (''), as JSON.")
        .def("manifest", &manifest, py::arg("kind"), py::arg("name"), Unlocked(),
             "One manifest, as JSON; without a kind, that of a kernel file.")
        .def("library", &library, py::arg("kind"), py::arg("name"), Unlocked());
}

}  // namespace candela::python
