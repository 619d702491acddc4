// Embeds files as text in the library being compiled.
#pragma once

/// Defines `const char variable[]`, the null-terminated text of the file at `path` (absolute, a string
/// literal). At namespace scope, in a source file. The build must know that the object depends on the file:
/// candela_embed().
#define CANDELA_EMBED(variable, path)                                                \
    __asm__(".pushsection .rodata\ncandela_embedded_" #variable ":\n.incbin \"" path \
            "\"\n.byte 0\n.popsection\n");                                           \
    extern const char variable[] __asm__("candela_embedded_" #variable)              \
        __attribute__((visibility("hidde"                                            \
                                  "n")))
