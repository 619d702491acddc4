# The compiler Candela is built with: C++20 modules need clang 19 (or newer), and its own dependency scanner beside it.
foreach(candela_clang_version 19 20 21)
    find_program(CANDELA_CLANGXX clang++-${candela_clang_version})
    if(CANDELA_CLANGXX)
        set(CMAKE_CXX_COMPILER "${CANDELA_CLANGXX}")
        break()
    endif()
endforeach()

# ccache on its own returns stale objects where module interfaces have changed.
find_program(CANDELA_CCACHE ccache)
if(CANDELA_CCACHE AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_CURRENT_LIST_DIR}/ccache.sh)
endif()
