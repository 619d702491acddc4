// Visibility of what libcandela_core.so exports. A macro, because macros do not cross modules.
#pragma once

#define CANDELA_API __attribute__((visibility("default")))
