module;

#include <string>

// Calls plugins, and turns their exceptions into errors that name them.
module candela.shading:guarded;

import candela.api;
import candela.plugins;

namespace candela {

template <class Call>
void guarded(PluginKind kind, const std::string& plugin, Call call) {
    try {
        call();
    } catch (...) {
        rethrow_as_plugin_error(kind, plugin);
    }
}

}  // namespace candela
