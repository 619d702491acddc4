# candela_find_library(<target> <header> <library>...): a library as a target, found by its header and its file. Debian's package
# file of OpenImageIO names tools and libraries that its -dev package does not contain, and tinygltf's names a library that Candela does
# not link.
function(candela_find_library target header)
    if(TARGET ${target})
        return()
    endif()
    find_path(${target}_INCLUDE_DIR ${header} REQUIRED)
    add_library(${target} INTERFACE)
    target_include_directories(${target} SYSTEM INTERFACE ${${target}_INCLUDE_DIR})
    foreach(library IN LISTS ARGN)
        find_library(${library}_FILE ${library} REQUIRED)
        target_link_libraries(${target} INTERFACE ${${library}_FILE})
    endforeach()
endfunction()
