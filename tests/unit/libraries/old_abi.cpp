// An outdated plugin: its fingerprint is not this Candela's, and its descriptor must never be read.
#include <cstdlib>

extern "C" __attribute__((visibility("default"))) const char* candela_plugin_abi() {
    return "candela interface 0; c++ abi 1002; libstdc++ cxx11";
}
extern "C" __attribute__((visibility("default"))) const void* candela_plugin_descriptor() { std::abort(); }
