// The plugins available to Python.
#pragma once

#include "binding.h"

#include "errors.h"

import candela.plugins;

namespace candela::python {

/// A registry, and its reports of plugins used instead of others. Any thread; releases Python's lock, which
/// another thread may need while it uses the registry.
class SharedRegistry {
  public:
    explicit SharedRegistry(const std::vector<std::filesystem::path>& folders);

    Registry& registry() noexcept { return registry_; }
    /// All reports so far.
    std::vector<Problem> replaced() const;

  private:
    mutable std::mutex mutex_;  // guards what follows
    std::vector<Problem> replaced_;
    Registry registry_;
};

using RegistryPointer = std::shared_ptr<SharedRegistry>;

}  // namespace candela::python
