// The shipped plugins, loaded from the build tree.
#pragma once

#include <initializer_list>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

import candela.core;

/// A registry of the build tree's plugins, one for the test program.
candela::Registry& test_registry();

/// The instruction sets that this machine has.
std::vector<candela::InstructionSet> machine_instruction_sets();

using Given = std::initializer_list<std::pair<std::string_view, candela::Value>>;

/// Creates an instance with the given parameters; colours are decoded only if `encoding` says so.
template <class Interface>
std::unique_ptr<Interface> instance(std::string_view name, Given given = {},
                                    candela::ColorEncoding encoding = candela::ColorEncoding::none) {
    candela::ParamSet values = test_registry().parameters(candela::k_kind_of<Interface>, name);
    for (const auto& [key, value] : given) values.set(key, value);
    return test_registry().create<Interface>(name, values, encoding);
}
