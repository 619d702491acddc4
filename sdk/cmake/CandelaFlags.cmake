# Warnings and sanitizers of Candela's own build. What plugins of others need stands in CandelaPlugin.cmake.
add_library(candela_flags INTERFACE)
target_compile_options(candela_flags INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
    $<$<BOOL:${CANDELA_WERROR}>:-Werror>)

if(CANDELA_SANITIZE)
    add_compile_options(-fsanitize=${CANDELA_SANITIZE} -fno-omit-frame-pointer)
    add_link_options(-fsanitize=${CANDELA_SANITIZE})
    if(CANDELA_SANITIZE MATCHES undefined)
        add_compile_options(-fno-sanitize-recover=all)
    endif()
endif()

# lld links the plugins and the test programs in a fraction of the time.
find_program(CANDELA_LLD NAMES ld.lld-19 ld.lld-20 ld.lld-21 ld.lld)
if(CANDELA_LLD)
    add_link_options(--ld-path=${CANDELA_LLD})
endif()

# What the compiler did with each loop, beside the object files; tests/vectorization reads it.
set(CANDELA_VECTORIZATION_RECORDS OFF)
if(CMAKE_BUILD_TYPE STREQUAL Release AND CMAKE_CXX_COMPILER_ID STREQUAL Clang AND NOT CANDELA_SANITIZE)
    set(CANDELA_VECTORIZATION_RECORDS ON)
    target_compile_options(candela_flags INTERFACE
        -fsave-optimization-record -foptimization-record-passes=loop-vectorize)
endif()
