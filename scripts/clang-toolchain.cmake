# The compiler Candela is built with: C++20 modules need clang 19 or newer and its own dependency scanner. With 22 the
# core takes less than half the time (docs/internals/adr/0016).
foreach(candela_clang_version 22 23 21 20 19)
    find_program(CANDELA_CLANGXX clang++-${candela_clang_version})
    if(CANDELA_CLANGXX)
        set(CMAKE_CXX_COMPILER "${CANDELA_CLANGXX}")
        break()
    endif()
endforeach()

# ccache alone returns stale objects when module interfaces have changed.
find_program(CANDELA_CCACHE ccache)
if(CANDELA_CCACHE AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_CURRENT_LIST_DIR}/ccache.sh)
endif()
