# candela_add_plugin(<kind>/<name> [KERNEL <file>] [SOURCES <file>...] [EMBED <file>...] [LIBRARIES <target>...]
#                    [DATA <dir>] [VERSION <x.y.z>] [AUTHOR <name>] [LICENSE <spdx>]
#                    [CONFORMANCE_VALUES <parameter>=<value>...])
#
# Adds a plugin: <kind>-<name>.so and <kind>-<name>.json, which is generated from it. Kind is light, reflection, shading, shape,
# image or target.
# The target is named candela_<kind>_<name>. If tests are enabled (enable_testing() before the call), and
# CANDELA_CONFORMANCE_TESTS is not set to OFF, "<kind>/<name> conforms" is a test.
#   KERNEL     the model, <name>.kernel, in the kernel language: its formulas, and comments that declare its parameters. Without
#              SOURCES it is the whole plugin; its text is embedded for the program generator
#   SOURCES    C++ to compile; one of the files ends with CANDELA_PLUGIN or CANDELA_KERNEL_PLUGIN (candela/<kind>_plugin.h)
#   EMBED      files that the sources embed, with CANDELA_EMBED(variable, CANDELA_SOURCE_DIR "/...") (candela/embed.h)
#   LIBRARIES  other libraries; the project's own shared libraries are found next to the plugin, wherever both are moved to
#   DATA       a folder of the plugin's own files, copied next to the library as the folder <kind>-<name>, which
#              candela::sdk::data_folder() finds (candela/plugin_files.h)
#   VERSION    the plugin's version; the project's by default
#   AUTHOR     the author, for `candela describe` and `candela list --json`
#   LICENSE    the SPDX identifier: MIT, Apache-2.0, GPL-3.0-or-later …
#   CONFORMANCE_VALUES  parameters' values for "conforms", such as a file that the plugin needs: file=/full/path
#
# If the loop over the points that a kernel's function is called for is not vectorised (with clang, and optimisation), a warning
# names the line of the kernel; with COMPILE_WARNING_AS_ERROR or -Werror in CMAKE_CXX_FLAGS it is an error.
#
# With -DCANDELA_SANITIZE=thread a second test, "<kind>/<name> has no data races", runs the plugin under ThreadSanitizer while
# it is called from several threads at once. (Targets have no such test.) Apart from LIBRARIES, linked libraries are not part of it.

# Once per folder, not once per build: variables set here are not visible in a sibling folder that finds Candela itself.
include_guard()

set(CANDELA_PLUGIN_CMAKE_DIR ${CMAKE_CURRENT_LIST_DIR})
include(${CMAKE_CURRENT_LIST_DIR}/CandelaThreads.cmake)

# Options for batch loops, in plugins and in the core: wide vectors if the function's own target has them. (That
# square roots do not set errno must be equal for all importers of a module, so candela::api specifies it.)
if(NOT TARGET candela_batch_flags)
    add_library(candela_batch_flags INTERFACE)
    target_compile_options(candela_batch_flags INTERFACE
        $<$<NOT:$<CONFIG:Debug>>:-O3>
        # Without optimisation nothing is vectorised, which clang would report for every loop.
        $<$<AND:$<CXX_COMPILER_ID:Clang>,$<CONFIG:Debug>>:-Wno-pass-failed>
        # The default of clang: otherwise g++ does not turn conditions within loops into blends.
        $<$<CXX_COMPILER_ID:GNU>:-fno-trapping-math>
        $<$<STREQUAL:${CMAKE_SYSTEM_PROCESSOR},x86_64>:-mprefer-vector-width=512>)
endif()

# Hardening, which limits the harm of memory errors, for Candela's own code and for plugins, which share its process.
set(CANDELA_HARDENING_COMPILE_OPTIONS
    -fstack-protector-strong -fstack-clash-protection
    $<$<STREQUAL:${CMAKE_SYSTEM_PROCESSOR},x86_64>:-fcf-protection>)
set(CANDELA_HARDENING_LINK_OPTIONS -Wl,-z,relro -Wl,-z,now)

function(candela_add_plugin id)
    cmake_parse_arguments(PARSE_ARGV 1 PLUGIN "" "KERNEL;VERSION;DATA;AUTHOR;LICENSE" "SOURCES;EMBED;LIBRARIES;CONFORMANCE_VALUES")
    if(PLUGIN_UNPARSED_ARGUMENTS)
        message(FATAL_ERROR "candela_add_plugin(${id}): unknown arguments ${PLUGIN_UNPARSED_ARGUMENTS}")
    endif()
    if(NOT id MATCHES "^(light|reflection|shading|shape|image|target)/([a-z][a-z0-9]*(-[a-z0-9]+)*)$")
        message(FATAL_ERROR "candela_add_plugin(${id}): the first argument is <kind>/<name>; kind is light, reflection, "
            "shading, shape, image or target, and name consists of lower-case letters, digits and single hyphens")
    endif()
    set(kind ${CMAKE_MATCH_1})
    set(name ${CMAKE_MATCH_2})
    if(NOT PLUGIN_VERSION)
        set(PLUGIN_VERSION ${PROJECT_VERSION})
    endif()
    if(NOT PLUGIN_VERSION)
        set(PLUGIN_VERSION 0.0.0)
    endif()
    set(target candela_${kind}_${name})
    set(file ${kind}-${name})

    if(PLUGIN_KERNEL)
        cmake_path(ABSOLUTE_PATH PLUGIN_KERNEL OUTPUT_VARIABLE kernel)
    endif()
    if(PLUGIN_KERNEL AND NOT PLUGIN_SOURCES)
        cmake_path(GET kernel STEM stem)
        if(NOT stem STREQUAL name OR NOT kind MATCHES "^(light|reflection|shading)$")
            message(FATAL_ERROR "candela_add_plugin(${id}): without SOURCES, KERNEL is a light, a reflection or a shading model in "
                "${name}.kernel")
        endif()
        set(PLUGIN_SOURCES ${CMAKE_CURRENT_BINARY_DIR}/${file}.cpp)
        add_custom_command(OUTPUT ${PLUGIN_SOURCES} DEPENDS ${kernel} candela::model
            COMMAND candela::model ${kernel} ${PLUGIN_SOURCES} COMMENT "Reading ${kind}/${stem}.kernel" VERBATIM)
    endif()

    add_library(${target} MODULE ${PLUGIN_SOURCES})
    target_compile_features(${target} PRIVATE cxx_std_20)
    set_target_properties(${target} PROPERTIES
        PREFIX "" OUTPUT_NAME ${file} SUFFIX .so
        CXX_STANDARD_REQUIRED ON CXX_SCAN_FOR_MODULES OFF
        CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON POSITION_INDEPENDENT_CODE ON
        LINK_DEPENDS "${CANDELA_PLUGIN_CMAKE_DIR}/plugin.map;$<TARGET_FILE:candela::manifest>")
    if(NOT TARGET candela_core)
        # Its own shared libraries are next to it, even if both are copied from the build folder; others are where they
        # were linked. Linked as installed: otherwise CMake pads the path with a colon for the other one, after which the loader
        # looks for every library in the current folder.
        set_target_properties(${target} PROPERTIES
            BUILD_WITH_INSTALL_RPATH ON INSTALL_RPATH "$ORIGIN/../..;$ORIGIN" INSTALL_RPATH_USE_LINK_PATH ON)
    endif()
    if(DEFINED CANDELA_PLUGIN_OUTPUT_DIRECTORY)
        set_target_properties(${target} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${CANDELA_PLUGIN_OUTPUT_DIRECTORY})
    endif()
    target_compile_definitions(${target} PRIVATE
        CANDELA_PLUGIN_NAME="${name}" CANDELA_PLUGIN_VERSION="${PLUGIN_VERSION}")
    if(PLUGIN_KERNEL)
        target_compile_definitions(${target} PRIVATE CANDELA_KERNEL_FILE="${kernel}")
        set_property(SOURCE ${PLUGIN_SOURCES} APPEND PROPERTY OBJECT_DEPENDS ${kernel})
        # Reports now, once, and at the kernel's line, what would not compile in programs generated from it. A variable that
        # is not read yet is only a warning, while the formula is being written.
        target_compile_options(${target} PRIVATE
            -Wunused-variable -Werror=uninitialized
            $<$<CXX_COMPILER_ID:Clang>:-Werror=sometimes-uninitialized>)
    endif()
    if(PLUGIN_EMBED)
        list(TRANSFORM PLUGIN_EMBED PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ REGEX "^[^/]")
        target_compile_definitions(${target} PRIVATE CANDELA_SOURCE_DIR="${CMAKE_CURRENT_SOURCE_DIR}")
        set_property(SOURCE ${PLUGIN_SOURCES} APPEND PROPERTY OBJECT_DEPENDS "${PLUGIN_EMBED}")
    endif()
    target_link_libraries(${target} PRIVATE candela::sdk candela_batch_flags ${PLUGIN_LIBRARIES})
    # With "thread", the plugin itself is unchanged, and a second library of it is instrumented.
    set(is_instrumented ${CANDELA_IS_SANITIZED})
    if(CANDELA_SANITIZE AND NOT CANDELA_SANITIZE STREQUAL "thread")
        set(is_instrumented ON)
    endif()
    if(NOT is_instrumented)
        if(NOT CANDELA_IS_HARDENED)
            target_compile_options(${target} PRIVATE ${CANDELA_HARDENING_COMPILE_OPTIONS})
            target_link_options(${target} PRIVATE ${CANDELA_HARDENING_LINK_OPTIONS})
        endif()
        # Not for units that import modules: clang 19 loses the C library's inline functions there ("undefined symbol:
        # memcpy.inline"). Without optimisation, it checks nothing and prints a warning.
        target_compile_options(${target} PRIVATE
            $<$<NOT:$<CONFIG:Debug>>:-U_FORTIFY_SOURCE> $<$<NOT:$<CONFIG:Debug>>:-D_FORTIFY_SOURCE=2>)
    endif()
    # The library exports only candela_*: symbols that two plugins both define could otherwise clash.
    target_link_options(${target} PRIVATE -Wl,--version-script=${CANDELA_PLUGIN_CMAKE_DIR}/plugin.map)
    if(NOT is_instrumented)
        # A missing symbol fails here, not when somebody loads the plugin. (Sanitizer runtimes live in the host.)
        target_link_options(${target} PRIVATE -Wl,-z,defs)
    endif()

    # clang knows which line of the kernel makes a loop scalar, but its warning names the SDK's header. So it must record its
    # remarks, which the manifest writer reads.
    set(loops)
    if(PLUGIN_KERNEL AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND NOT is_instrumented)
        target_compile_options(${target} PRIVATE
            "$<$<NOT:$<CONFIG:Debug>>:-Wno-pass-failed;-fsave-optimization-record;-foptimization-record-passes=loop-vectorize>")
        set(verdict warning)
        if(CANDELA_WERROR OR CMAKE_COMPILE_WARNING_AS_ERROR OR CMAKE_CXX_FLAGS MATCHES "-Werror( |$)")
            set(verdict error)
        endif()
        set(loops $<$<NOT:$<CONFIG:Debug>>:--scalar-loops=${verdict};--kernel=${kernel};$<TARGET_OBJECTS:${target}>>)
    endif()

    # The manifest, from the plugin's own descriptor.
    add_custom_command(TARGET ${target} POST_BUILD
        COMMAND candela::manifest $<TARGET_FILE:${target}> $<TARGET_FILE_DIR:${target}>/${file}.json
            "--author=${PLUGIN_AUTHOR}" "--license=${PLUGIN_LICENSE}" "${loops}"
        VERBATIM COMMAND_EXPAND_LISTS)
    set_target_properties(${target} PROPERTIES CANDELA_MANIFEST ${file}.json)

    set(data)
    if(PLUGIN_DATA)
        cmake_path(ABSOLUTE_PATH PLUGIN_DATA NORMALIZE OUTPUT_VARIABLE data)
        file(GLOB_RECURSE files CONFIGURE_DEPENDS "${data}/*")
        if(NOT files)
            message(FATAL_ERROR "candela_add_plugin(${id}): there are no files in ${data}, the folder of DATA")
        endif()
        # Has its own stamp: changed files cause no linking, and files removed there are removed here.
        set(mark ${CMAKE_CURRENT_BINARY_DIR}/${file}.data)
        add_custom_command(OUTPUT ${mark} DEPENDS ${files}
            COMMAND ${CMAKE_COMMAND} -E rm -rf $<TARGET_FILE_DIR:${target}>/${file}
            COMMAND ${CMAKE_COMMAND} -E copy_directory ${data} $<TARGET_FILE_DIR:${target}>/${file}
            COMMAND ${CMAKE_COMMAND} -E touch ${mark}
            VERBATIM)
        add_custom_target(${target}_data ALL DEPENDS ${mark})
        add_dependencies(${target} ${target}_data)
        set_target_properties(${target} PROPERTIES CANDELA_DATA ${file})
    endif()

    set(is_sanitized_too OFF)
    if(CANDELA_SANITIZE STREQUAL "thread" AND NOT is_instrumented AND NOT kind STREQUAL "target")
        if(data)
            list(PREPEND data DATA)
        endif()
        candela_add_thread_sanitized(${target} SOURCES ${PLUGIN_SOURCES} LIBRARIES ${PLUGIN_LIBRARIES} ${data})
        if(TARGET ${target}_threads)
            set(is_sanitized_too ON)
        endif()
    endif()

    # Tests everything that a host relies on.
    if(TARGET candela::conformance AND (CANDELA_CONFORMANCE_TESTS OR NOT DEFINED CANDELA_CONFORMANCE_TESTS))
        list(TRANSFORM PLUGIN_CONFORMANCE_VALUES PREPEND --set=)
        if(is_sanitized_too)
            candela_check_threads(check $<TARGET_FILE:${target}_threads>)
            add_test(NAME "${id} has no data races" COMMAND ${check} ${PLUGIN_CONFORMANCE_VALUES})
            set_tests_properties("${id} has no data races" PROPERTIES LABELS conformance TIMEOUT 900)
        endif()
        if(NOT CANDELA_SANITIZE STREQUAL "thread" OR NOT is_instrumented)
            add_test(NAME "${id} conforms"
                COMMAND candela::conformance $<TARGET_FILE:${target}> ${PLUGIN_CONFORMANCE_VALUES})
            set_tests_properties("${id} conforms" PROPERTIES LABELS conformance TIMEOUT 900)
        elseif(NOT kind STREQUAL "target")
            # The kit is instrumented as well, and runs only the checks that start threads. (Targets have none.)
            candela_find_symbolizer(symbolizer)
            add_test(NAME "${id} has no data races" COMMAND candela::conformance $<TARGET_FILE:${target}>
                ${PLUGIN_CONFORMANCE_VALUES} "--check=threads at once")
            set_tests_properties("${id} has no data races" PROPERTIES
                LABELS conformance TIMEOUT 900 ENVIRONMENT "${symbolizer}")
        endif()
    endif()
endfunction()

# candela_install_plugin(<kind>/<name> [DESTINATION <dir>] [COMPONENT <name>]): the library, its manifest and its folder of
# files, into lib/candela/plugins. Install its own shared libraries there as well.
function(candela_install_plugin id)
    cmake_parse_arguments(PARSE_ARGV 1 PLUGIN "" "DESTINATION;COMPONENT" "")
    string(REPLACE "/" "_" suffix ${id})
    set(target candela_${suffix})
    if(NOT PLUGIN_DESTINATION)
        set(PLUGIN_DESTINATION lib/candela/plugins)
    endif()
    if(TARGET candela_core)
        set_target_properties(${target} PROPERTIES INSTALL_RPATH "$ORIGIN/../..")
    endif()
    get_target_property(manifest ${target} CANDELA_MANIFEST)
    set(component)
    if(PLUGIN_COMPONENT)
        set(component COMPONENT ${PLUGIN_COMPONENT})
    endif()
    install(TARGETS ${target} LIBRARY DESTINATION ${PLUGIN_DESTINATION} ${component})
    install(FILES $<TARGET_FILE_DIR:${target}>/${manifest} DESTINATION ${PLUGIN_DESTINATION} ${component})
    get_target_property(data ${target} CANDELA_DATA)
    if(data)
        install(DIRECTORY $<TARGET_FILE_DIR:${target}>/${data} DESTINATION ${PLUGIN_DESTINATION} ${component})
    endif()
endfunction()

# candela_add_plugin_test(<kind>/<name> SOURCES <file>... [LIBRARIES <target>...]): tests with Catch2, which find the folder of
# the built plugin in the macro CANDELA_PLUGIN_DIR. They are one test of CTest, "<kind>/<name>".
function(candela_add_plugin_test id)
    cmake_parse_arguments(PARSE_ARGV 1 TEST "" "" "SOURCES;LIBRARIES")
    find_package(Catch2 3 REQUIRED)
    string(REPLACE "/" "_" suffix ${id})
    set(target candela_${suffix})
    add_executable(${target}_test ${TEST_SOURCES})
    target_compile_features(${target}_test PRIVATE cxx_std_20)
    # Tests use the plugin through candela/plugin_test.h; only those that link candela::core import modules.
    set(imports OFF)
    if("candela::core" IN_LIST TEST_LIBRARIES)
        set(imports ON)
    endif()
    set_target_properties(${target}_test PROPERTIES CXX_STANDARD_REQUIRED ON CXX_SCAN_FOR_MODULES ${imports})
    target_compile_definitions(${target}_test PRIVATE CANDELA_PLUGIN_DIR="$<TARGET_FILE_DIR:${target}>")
    target_link_libraries(${target}_test PRIVATE candela::sdk Catch2::Catch2WithMain ${TEST_LIBRARIES})
    add_dependencies(${target}_test ${target})
    add_test(NAME "${id}" COMMAND ${target}_test)
endfunction()
