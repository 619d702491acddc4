# Writes OUTPUT, a source file that defines candela::sdk::k_kernel_text as the text of KERNEL, or null where it is empty.
if(KERNEL)
    file(READ "${KERNEL}" text)
    string(FIND "${text}" ")candela_kernel\"" clash)
    if(NOT clash EQUAL -1)
        message(FATAL_ERROR "${KERNEL}: the text )candela_kernel\" cannot be embedded")
    endif()
    set(value "R\"candela_kernel(${text})candela_kernel\"")
else()
    set(value "nullptr")
endif()
file(WRITE "${OUTPUT}"
    "namespace candela::sdk {\n"
    "extern const char* const k_kernel_text;\n"
    "const char* const k_kernel_text = ${value};\n"
    "}  // namespace candela::sdk\n")
