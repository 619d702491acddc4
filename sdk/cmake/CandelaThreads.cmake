# Plugins under ThreadSanitizer: a second library of each, which the conformance kit calls from several threads at once.
include_guard()

set(CANDELA_THREADS_DIR ${CMAKE_CURRENT_LIST_DIR})

# candela_find_thread_sanitizer(<variable>): the sanitizer's library for programs that are not built with it; empty if the compiler
# cannot build with it or comes without this library.
function(candela_find_thread_sanitizer result)
    include(CheckCXXSourceCompiles)
    set(CMAKE_REQUIRED_FLAGS -fsanitize=thread)
    check_cxx_source_compiles("int main() { return 0; }" CANDELA_HAS_THREAD_SANITIZER)
    set(found)
    if(CANDELA_HAS_THREAD_SANITIZER)
        foreach(name libclang_rt.tsan.so libclang_rt.tsan-${CMAKE_SYSTEM_PROCESSOR}.so libtsan.so)
            execute_process(COMMAND ${CMAKE_CXX_COMPILER} -print-file-name=${name}
                OUTPUT_VARIABLE path OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
            if(NOT found AND IS_ABSOLUTE "${path}" AND EXISTS "${path}")
                set(found ${path})
            endif()
        endforeach()
    endif()
    set(${result} "${found}" PARENT_SCOPE)
endfunction()

# candela_find_symbolizer(<variable>): the environment variables that make reports name lines: a symbolizer for clang's runtime,
# or addr2line, which is installed with every linker. Debian's clang 19 looks for neither itself. g++'s runtime needs none.
function(candela_find_symbolizer result)
    string(REGEX MATCH "^[0-9]+" version "${CMAKE_CXX_COMPILER_VERSION}")
    cmake_path(GET CMAKE_CXX_COMPILER PARENT_PATH compiler_folder)
    find_program(CANDELA_SYMBOLIZER NAMES llvm-symbolizer llvm-symbolizer-${version} addr2line
        HINTS ${compiler_folder} /usr/lib/llvm-${version}/bin)
    mark_as_advanced(CANDELA_SYMBOLIZER)
    set(options TSAN_OPTIONS=allow_addr2line=1)
    if(CANDELA_SYMBOLIZER)
        set(options TSAN_OPTIONS=external_symbolizer_path=${CANDELA_SYMBOLIZER})
    endif()
    set(${result} ${options} PARENT_SCOPE)
endfunction()

# candela_add_thread_sanitized(<target> SOURCES <file>... LIBRARIES <target>... [DATA <dir>]): for a target of
# candela_add_plugin(), the same plugin as <target>_threads. candela_check_threads() tests it.
function(candela_add_thread_sanitized target)
    cmake_parse_arguments(PARSE_ARGV 1 ARG "" "DATA" "SOURCES;LIBRARIES")
    candela_find_thread_sanitizer(is_there)
    if(NOT is_there)
        message(WARNING "CANDELA_SANITIZE is thread, but ${CMAKE_CXX_COMPILER} cannot build with -fsanitize=thread: data races are "
            "not detected (for clang 22, Debian's package libclang-rt-22-dev is missing)")
        return()
    endif()

    set(sanitized ${target}_threads)
    add_library(${sanitized} MODULE ${ARG_SOURCES})
    target_compile_features(${sanitized} PRIVATE cxx_std_20)
    get_target_property(file ${target} OUTPUT_NAME)
    set_target_properties(${sanitized} PROPERTIES
        PREFIX "" OUTPUT_NAME ${file} SUFFIX .so LIBRARY_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/threads
        CXX_STANDARD_REQUIRED ON CXX_SCAN_FOR_MODULES OFF
        CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON POSITION_INDEPENDENT_CODE ON)
    target_compile_definitions(${sanitized} PRIVATE $<TARGET_PROPERTY:${target},COMPILE_DEFINITIONS>)
    target_include_directories(${sanitized} PRIVATE $<TARGET_PROPERTY:${target},INCLUDE_DIRECTORIES>)
    target_compile_options(${sanitized} PRIVATE -fsanitize=thread -g -O1
        # Instrumented loops are not vectorised, and clang would report each of them.
        $<$<CXX_COMPILER_ID:Clang>:-Wno-pass-failed>)
    target_link_options(${sanitized} PRIVATE -fsanitize=thread
        -Wl,--version-script=${CANDELA_THREADS_DIR}/plugin.map)
    target_link_libraries(${sanitized} PRIVATE candela::sdk ${ARG_LIBRARIES})
    add_dependencies(${sanitized} ${target})
    set(folder $<TARGET_FILE_DIR:${sanitized}>)
    set(data)
    if(ARG_DATA)
        set(data COMMAND ${CMAKE_COMMAND} -E copy_directory ${ARG_DATA} ${folder}/${file})
    endif()
    # It has the same manifest as the plugin.
    add_custom_command(TARGET ${sanitized} POST_BUILD
        COMMAND ${CMAKE_COMMAND} -E copy $<TARGET_FILE_DIR:${target}>/${file}.json ${folder} ${data}
        VERBATIM)
endfunction()

# candela_check_threads(<command> <library>): the command that runs the kit's checks with several threads on a library of
# candela_add_thread_sanitized(). The kit is not built with the sanitizer, whose library is therefore loaded first.
function(candela_check_threads result library)
    candela_find_thread_sanitizer(sanitizer)
    candela_find_symbolizer(symbolizer)
    set(${result} ${CMAKE_COMMAND} -E env ${symbolizer} LD_PRELOAD=${sanitizer} $<TARGET_FILE:candela::conformance> ${library}
        --in-process "--check=threads at once" PARENT_SCOPE)
endfunction()
