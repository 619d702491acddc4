// Models with values, made from Python.
#pragma once

#include "binding.h"
#include "registry.h"

import candela.plugins;

namespace candela::python {

/// A model's values: `given`, by parameter, and its defaults. Throws InvalidInput with all errors, as a scene
/// does.
ParamSet values_from(SharedRegistry& registry, PluginKind kind, const std::string& name,
                     const py::dict& given);

/// A dictionary by parameter.
py::dict dictionary_of(const ParamSet& values);

/// "srgb", "none". Throws Error (bad_request).
ColorEncoding encoding_named(const std::string& name);

/// One instance of a model, and its origin. Immutable; any thread.
template <class Interface>
class ModelInstance {
  public:
    ModelInstance(RegistryPointer registry, std::string name, const py::dict& given,
                  const std::string& color_management)
        : registry_(std::move(registry)),
          name_(std::move(name)),
          values_(values_from(*registry_, k_kind_of<Interface>, name_, given)) {
        const ColorEncoding encoding = encoding_named(color_management);
        const py::gil_scoped_release unlocked;
        instance_ = registry_->registry().create<Interface>(name_, values_, encoding);
        descriptor_ = &registry_->registry().descriptor(k_kind_of<Interface>, name_);
    }

    const std::string& name() const noexcept { return name_; }
    py::dict values() const { return dictionary_of(values_); }
    const Interface& instance() const noexcept { return *instance_; }
    const PluginDescriptor& descriptor() const noexcept { return *descriptor_; }

    /// Calls it; exceptions of a plugin become an Error with its name.
    template <class Call>
    void guarded(const Call& call) const {
        try {
            call(*instance_);
        } catch (...) {
            rethrow_as_plugin_error(k_kind_of<Interface>, name_);
        }
    }

  private:
    RegistryPointer registry_;  // outlives the objects made by its plugins
    std::string name_;
    ParamSet values_;
    const PluginDescriptor* descriptor_ = nullptr;
    std::unique_ptr<Interface> instance_;
};

}  // namespace candela::python
