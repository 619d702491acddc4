# Warnings and sanitizers of Candela's own build. CandelaPlugin.cmake has what third-party plugins need.
add_library(candela_flags INTERFACE)
target_compile_options(candela_flags INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
    # Catch2's macros count.
    $<$<AND:$<CXX_COMPILER_ID:Clang>,$<VERSION_GREATER_EQUAL:$<CXX_COMPILER_VERSION>,22>>:-Wno-c2y-extensions>
    $<$<BOOL:${CANDELA_WERROR}>:-Werror>)

if(NOT CANDELA_SANITIZE)
    add_compile_options(${CANDELA_HARDENING_COMPILE_OPTIONS})
    add_link_options(${CANDELA_HARDENING_LINK_OPTIONS})
    set(CANDELA_IS_HARDENED ON)
endif()

if(CANDELA_SANITIZE)
    set(CANDELA_IS_SANITIZED ON)
    add_compile_options(-fsanitize=${CANDELA_SANITIZE} -fno-omit-frame-pointer)
    add_link_options(-fsanitize=${CANDELA_SANITIZE})
    if(CANDELA_SANITIZE MATCHES undefined)
        add_compile_options(-fno-sanitize-recover=all -fsanitize-ignorelist=${CMAKE_CURRENT_LIST_DIR}/undefined.ignorelist)
    endif()
    if(CANDELA_SANITIZE MATCHES address)
        # AddressSanitizer detects out-of-bounds accesses anyway, and this takes a fifth of a unit's compile time.
        add_compile_options(-fno-sanitize=object-size)
    endif()
endif()

# For code that is not run for each fragment, vertex or byte. Optimising the sanitizers' code takes longer than running it unoptimised.
# Inlining is most of the time that such units take to optimise.
set(CANDELA_COLD_CODE_OPTIONS $<$<CONFIG:Release>:-O1>)
if(CMAKE_BUILD_TYPE STREQUAL Release AND CMAKE_CXX_COMPILER_ID STREQUAL Clang)
    list(APPEND CANDELA_COLD_CODE_OPTIONS -mllvm -inline-threshold=30)
endif()
if(CANDELA_SANITIZE AND NOT CANDELA_SANITIZE MATCHES fuzzer)
    set(CANDELA_COLD_CODE_OPTIONS -O0)
endif()

# candela_unite(<target>): compiles the target's sources as one, which takes half the time, where nobody edits them: in builds without
# tests, and with sanitizers.
function(candela_unite target)
    if(NOT CANDELA_TESTS OR CANDELA_SANITIZE)
        set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
    endif()
endfunction()

# {fmt} 10 has internal format strings that clang 20 and newer do not consider constants.
find_package(fmt REQUIRED)
if(fmt_VERSION VERSION_GREATER_EQUAL 10 AND fmt_VERSION VERSION_LESS 11)
    add_compile_definitions(FMT_CONSTEVAL=)
endif()

# lld links the plugins and the test programs in a fraction of the time.
find_program(CANDELA_LLD NAMES ld.lld-22 ld.lld-21 ld.lld-20 ld.lld-19 ld.lld)
if(CANDELA_LLD)
    add_link_options(--ld-path=${CANDELA_LLD})
endif()

# The compiler's remarks on each loop, next to object files with batch loops; tests/packaging/vectorization reads them. They take a tenth of a
# unit's compile time, so a target with CANDELA_FEW_BATCH_LOOPS adds the options to the sources that have such loops.
set(CANDELA_VECTORIZATION_RECORDS OFF)
if(CMAKE_BUILD_TYPE STREQUAL Release AND CMAKE_CXX_COMPILER_ID STREQUAL Clang AND NOT CANDELA_SANITIZE)
    set(CANDELA_VECTORIZATION_RECORDS ON)
    set(CANDELA_VECTORIZATION_RECORD_OPTIONS -fsave-optimization-record -foptimization-record-passes=loop-vectorize)
    target_compile_options(candela_batch_flags INTERFACE
        "$<$<NOT:$<BOOL:$<TARGET_PROPERTY:CANDELA_FEW_BATCH_LOOPS>>>:${CANDELA_VECTORIZATION_RECORD_OPTIONS}>")
endif()

# candela_add_headers(<name> HEADERS <header>... LIBRARIES <target>... [OPTIONS <option>...]): headers that are parsed once, and
# compiled with their instantiations, for all targets that candela_use_headers() gives them to.
function(candela_add_headers name)
    cmake_parse_arguments(PARSE_ARGV 1 ARG "" "" "HEADERS;LIBRARIES;OPTIONS")
    set(empty ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
    file(CONFIGURE OUTPUT ${empty} CONTENT "")
    add_library(${name} OBJECT ${empty})
    set_target_properties(${name} PROPERTIES CXX_SCAN_FOR_MODULES OFF)
    target_link_libraries(${name} PRIVATE candela_flags ${ARG_LIBRARIES})
    # The core's options, which it passes on to all importers of its modules.
    target_compile_options(${name} PRIVATE -fno-math-errno ${ARG_OPTIONS})
    # <cstdint> first, as in the core: what libstdc++ 14's <memory> means by uintptr_t depends on what was included before, and clang
    # compares its functions with those that come with modules.
    target_precompile_headers(${name} PRIVATE <cstdint> ${ARG_HEADERS})
    set_target_properties(${name} PROPERTIES CANDELA_HEADER_OPTIONS "${ARG_OPTIONS}")
endfunction()

# candela_use_headers(<name> <target>...)
function(candela_use_headers name)
    get_target_property(options ${name} CANDELA_HEADER_OPTIONS)
    foreach(target IN LISTS ARGN)
        target_compile_options(${target} PRIVATE ${options})
        target_precompile_headers(${target} REUSE_FROM ${name})
        get_target_property(type ${target} TYPE)
        if(type STREQUAL EXECUTABLE)
            # A precompiled header fits only one kind of position-independent code: that of libraries.
            set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
            target_compile_options(${target} PRIVATE -fPIC)
        endif()
    endforeach()
endfunction()
