// A plugin that needs a function that does not exist.
extern "C" int candela_test_nobody_has_this();
extern "C" __attribute__((visibility("default"))) int candela_plugin_abi() {
    return candela_test_nobody_has_this();
}
