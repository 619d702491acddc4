// The plugins that Python uses.
#pragma once

#include "binding.h"

#include "errors.h"

import candela.registry;

namespace candela::python {

/// A registry, and what it had to say about plugins that it has used instead of others. Any thread, without
/// Python's lock, which may be needed for what another thread does with the registry.
class SharedRegistry {
  public:
    explicit SharedRegistry(const std::vector<std::filesystem::path>& folders);

    Registry& registry() noexcept { return registry_; }
    /// All so far.
    std::vector<Problem> replaced() const;

  private:
    mutable std::mutex mutex_;  // of what follows
    std::vector<Problem> replaced_;
    Registry registry_;
};

using RegistryPointer = std::shared_ptr<SharedRegistry>;

}  // namespace candela::python
