module;

#include "candela/plugin/descriptor.h"

export module candela.descriptor;

export import candela.color;
export import candela.params;

export namespace candela {
using candela::FileFormat;
using candela::Instance;
using candela::k_plugin_kinds;
using candela::KernelFunction;
using candela::KernelText;
using candela::name_of;
using candela::plugin_kind_named;
using candela::PluginDescriptor;
using candela::PluginKind;
using candela::Property;
}  // namespace candela
